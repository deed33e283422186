//! Periodic motions of a machine with a label, stable or not, from many guesses.

use super::border::on_border;
use super::cycle::Cycle;
use super::frame::MachineFrame;
use super::near_returns::near_returns;
use super::reduced::orbits;
use crate::events::{Motion, Start};
use crate::machine::Machine;
use crate::math::sort_by;
use crate::orbit::Label;

/// The forcing periods after which a motion is a guess.
const AFTER: [f64; 4] = [1.0, 4.0, 16.0, 60.0];
/// Cycles that differ by less are the same.
const SAME: f64 = 1e-6;
/// The largest number of events of the motion from one start.
const EVENTS: usize = 20_000;

/// The largest number of stable orbits between which further guesses lie.
const BETWEEN: usize = 4;

/// The orbits of `machine` with the label `label` to which Newton's method leads from the motions from `starts`, the fastest
/// last; stopped when `go_on` returns false, and then `None`. A start that is not allowed is passed over.
///
/// Further guesses lie on the border between the motions that lead to two stable orbits of as many forcing periods, whatever
/// their number of impacts. Without forcing the guesses are motions that come close to an earlier state, also those
/// on the border. An orbit to which no guess leads is not found.
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
    let (frame, starts) = (MachineFrame::new(machine), &mut starts.into_iter());
    match machine.period() {
        Some(period) => forced(&frame, (label, period), starts, go_on),
        None => unforced(&frame, label, starts, go_on),
    }
}

/// The cycles of a machine whose forcing has this period.
fn forced(
    frame: &MachineFrame<'_>,
    (label, period): (Label, f64),
    starts: &mut dyn Iterator<Item = Start>,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<Cycle>> {
    // of all labels of as many periods
    let mut known: Vec<Cycle> = Vec::new();
    for start in starts {
        let Ok(mut motion) = Motion::new(frame.machine, &start, frame.limits()) else { continue };
        let mut seen = 0;
        for after in AFTER {
            while motion.time() < after * period && seen < EVENTS && motion.step().is_some() {
                // they would only take memory
                motion.take_events();
                seen += 1;
            }
            if !go_on() {
                return None;
            }
            learn(&mut known, Cycle::near(frame, motion.place(), label.periods));
        }
    }
    // pairs grow as the square of their number
    let stable: Vec<Cycle> = known.iter().filter(|cycle| cycle.stable()).take(BETWEEN).cloned().collect();
    for (i, j) in (0..stable.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        for guess in on_border(frame, (&stable[i], &stable[j]), go_on) {
            if !go_on() {
                return None;
            }
            learn(&mut known, Cycle::near(frame, &guess, label.periods));
        }
    }
    Some(of_label(known, label))
}

/// The same without forcing.
fn unforced(
    frame: &MachineFrame<'_>,
    label: Label,
    starts: &mut dyn Iterator<Item = Start>,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<Cycle>> {
    let mut known: Vec<Cycle> = Vec::new();
    let from = |known: &mut Vec<Cycle>, motion: Motion<'_>| {
        for (guess, time) in near_returns(frame, motion, label.impacts) {
            go_on().then_some(())?;
            learn(known, Cycle::returning(frame, &guess, time));
        }
        Some(())
    };
    for start in starts {
        let Ok(motion) = Motion::new(frame.machine, &start, frame.limits()) else { continue };
        from(&mut known, motion)?;
    }
    let stable: Vec<Cycle> = known.iter().filter(|cycle| cycle.stable()).take(BETWEEN).cloned().collect();
    for (i, j) in (0..stable.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        if let Some(place) = on_border(frame, (&stable[i], &stable[j]), go_on).into_iter().next() {
            from(&mut known, frame.resume(place).limited(frame.limits().time))?;
        }
    }
    Some(of_label(known, label))
}

/// The cycles with a label, the fastest last.
fn of_label(known: Vec<Cycle>, label: Label) -> Vec<Cycle> {
    let mut found: Vec<Cycle> = known.into_iter().filter(|cycle| cycle.label == label).collect();
    sort_by(&mut found, |a, b| a.fastest().total_cmp(&b.fastest()));
    found
}

/// Adds a cycle that is new.
fn learn(known: &mut Vec<Cycle>, cycle: Option<Cycle>) {
    if let Some(cycle) = cycle
        && !known.iter().any(|other| other.same_as(&cycle, SAME))
    {
        known.push(cycle);
    }
}
