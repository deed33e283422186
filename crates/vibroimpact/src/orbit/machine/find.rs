//! Periodic motions of a machine with a label, stable or not, from many guesses.

use super::border::on_border;
use super::cycle::Cycle;
use super::frame::MachineFrame;
use super::lap::MachineLap;
use super::near_returns::near_returns;
use super::reduced::orbits;
use crate::events::{Motion, Place, Start};
use crate::machine::Machine;
use crate::math::{add_scaled, eigenvector, sort_by};
use crate::orbit::{Label, Stability};

/// The forcing periods after which a motion is a guess.
const AFTER: [f64; 4] = [1.0, 4.0, 16.0, 60.0];
/// Cycles that differ by less are the same.
const SAME: f64 = 1e-6;
/// The largest number of events of the motion from one start.
const EVENTS: usize = 20_000;

/// The largest number of stable orbits between which further guesses lie.
const BETWEEN: usize = 4;
/// The largest number of unstable orbits that motions leave, and how far from the orbit these begin, in its size.
const LEFT: usize = 8;
const ASIDE: f64 = 1e-2;

/// The orbits of `machine` with the label `label` to which Newton's method leads from the motions from `starts`, the fastest
/// last; stopped when `go_on` returns false, and then `None`. A start that is not allowed is passed over.
///
/// Further guesses lie on the border between the motions that lead to two stable orbits of as many forcing periods, whatever
/// their number of impacts, and on the motions that leave an unstable orbit to either side. Without forcing the guesses are motions
/// that come close to an earlier state, also those on the border. An orbit to which no guess leads is not found.
///
/// The orbits of a machine that is an [oscillator](Machine::reduced) are those that [`find_while`](crate::orbit::find_while)
/// finds; `starts` are not used then.
#[must_use]
pub fn find_machine_while(
    machine: &Machine,
    label: Label,
    starts: impl IntoIterator<Item = Start>,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<Cycle>> {
    match orbits(&MachineFrame::new(machine), label, go_on)? {
        Some(cycles) => Some(cycles),
        None => find_unreduced(machine, label, starts, go_on),
    }
}

/// The same, with a machine that is an oscillator followed as any other.
#[must_use]
pub fn find_unreduced(
    machine: &Machine,
    label: Label,
    starts: impl IntoIterator<Item = Start>,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<Cycle>> {
    let frame = MachineFrame::new(machine);
    let mut search = Search { frame: &frame, label, known: Vec::new(), go_on };
    for start in starts {
        let Ok(motion) = Motion::new(machine, &start, frame.limits()) else { continue };
        search.follow(motion)?;
    }
    let stable = search.first(BETWEEN, Stability::Stable);
    for (i, j) in (0..stable.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        search.between((&stable[i], &stable[j]))?;
    }
    for cycle in search.first(LEFT, Stability::Unstable) {
        search.leave(&cycle)?;
    }
    let mut found = search.known;
    found.retain(|cycle| cycle.label == label);
    sort_by(&mut found, |a, b| a.fastest().total_cmp(&b.fastest()));
    Some(found)
}

/// A search for cycles from motions; each step is `None` once `go_on` has returned false.
struct Search<'a> {
    frame: &'a MachineFrame<'a>,
    label: Label,
    /// The cycles so far, of all labels of as many periods.
    known: Vec<Cycle>,
    go_on: &'a dyn Fn() -> bool,
}

impl Search<'_> {
    /// Adds the cycles to which states of a motion lead: after some forcing periods, or where it comes close to an earlier state.
    fn follow(&mut self, mut motion: Motion<'_>) -> Option<()> {
        let Some(period) = self.frame.machine.period() else {
            for (guess, time) in near_returns(self.frame, motion, self.label.impacts) {
                (self.go_on)().then_some(())?;
                self.learn(Cycle::returning(self.frame, &guess, time));
            }
            return Some(());
        };
        let mut seen = 0;
        for after in AFTER {
            while motion.time() < after * period && seen < EVENTS && motion.step().is_some() {
                // they would only take memory
                motion.take_events();
                seen += 1;
            }
            self.learn_near(motion.place())?;
        }
        Some(())
    }

    /// So many of the known cycles with this stability at most.
    fn first(&self, most: usize, stability: Stability) -> Vec<Cycle> {
        self.known.iter().filter(|cycle| cycle.stability() == stability).take(most).cloned().collect()
    }

    /// Adds the cycles to which states on the border between two stable ones lead.
    fn between(&mut self, stable: (&Cycle, &Cycle)) -> Option<()> {
        let guesses = on_border(self.frame, stable, self.go_on);
        if self.frame.unforced() {
            let resumed = |place| self.frame.resume(place).limited(self.frame.limits().time);
            return guesses.into_iter().next().map(resumed).map_or(Some(()), |motion| self.follow(motion));
        }
        guesses.iter().try_for_each(|guess| self.learn_near(guess))
    }

    /// Adds the cycles to which the motions lead that leave an unstable one to either side: near a fold this is often the stable one,
    /// whose basin is small.
    fn leave(&mut self, cycle: &Cycle) -> Option<()> {
        let begin = cycle.strobes.first();
        let outwards = cycle.multipliers.iter().find(|multiplier| multiplier.im == 0.0 && multiplier.modulus() > 1.0);
        let Some((begin, outwards)) = begin.zip(outwards) else { return Some(()) };
        let time = self.frame.time(cycle.label.periods, cycle.period);
        let turn = MachineLap::fly(self.frame, begin, time).and_then(|lap| lap.derivative);
        let Some(direction) = turn.and_then(|turn| eigenvector(&turn, outwards.re)) else { return Some(()) };
        let size = cycle.sizes.0.max(cycle.sizes.1);
        for side in [ASIDE, -ASIDE] {
            let mut values = self.frame.shape.values(begin);
            add_scaled(&mut values, side * size, &direction);
            self.follow(self.frame.resume(self.frame.shape.with_values(begin, &values)))?;
        }
        Some(())
    }

    fn learn_near(&mut self, guess: &Place) -> Option<()> {
        (self.go_on)().then_some(())?;
        self.learn(Cycle::near(self.frame, guess, self.label.periods));
        Some(())
    }

    /// Adds a cycle that is new.
    fn learn(&mut self, cycle: Option<Cycle>) {
        if let Some(cycle) = cycle
            && !self.known.iter().any(|other| other.same_as(&cycle, SAME))
        {
            self.known.push(cycle);
        }
    }
}
