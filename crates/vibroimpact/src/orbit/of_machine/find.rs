//! Periodic motions of a machine with a label, stable or not, from many guesses.

use super::cycle::MachineCycle;
use super::frame::MachineFrame;
use super::lap::MachineLap;
use crate::events::{MachineLimits, MachineMotion, MachineStart, Place};
use crate::machine::Machine;
use crate::orbit::Label;
use crate::system::phase;

/// The forcing periods after which a motion is a guess.
const AFTER: [f64; 4] = [1.0, 4.0, 16.0, 60.0];
/// Cycles that differ by less are the same.
const SAME: f64 = 1e-6;
/// The largest number of events of the motion from one start.
const EVENTS: usize = 20_000;

/// The largest number of orbits between which further guesses lie.
const BETWEEN: usize = 5;
/// The number of parts of the way from one orbit to another, whose ends are guesses.
const PARTS: u32 = 12;

/// The orbits of `machine` with the label `label` to which Newton's method leads from the motions from `starts`, the fastest
/// last; stopped when `go_on` returns false, and then `None`. A start that is not allowed is passed over.
///
/// Further guesses lie between the orbits of as many forcing periods, whatever their number of impacts, because an unstable
/// orbit is often on the border between the motions that lead to two stable ones. An orbit to which no guess leads is not
/// found.
#[must_use]
pub fn find_machine_while(
    machine: &Machine,
    label: Label,
    starts: impl IntoIterator<Item = MachineStart>,
    go_on: impl Fn() -> bool,
) -> Option<Vec<MachineCycle>> {
    let frame = MachineFrame::new(machine);
    // of all labels of as many periods
    let mut known: Vec<MachineCycle> = Vec::new();
    let Some(period) = machine.period() else { return Some(known) };
    for start in starts {
        let Ok(mut motion) = MachineMotion::new(machine, &start, MachineLimits::default()) else { continue };
        let mut seen = 0;
        for after in AFTER {
            while motion.time() < after * period && seen < EVENTS && motion.step().is_some() {
                motion.take_events();
                seen += 1;
            }
            if !go_on() {
                return None;
            }
            learn(&mut known, MachineCycle::near(&frame, motion.place(), label.periods));
        }
    }
    let first = known.len().min(BETWEEN);
    for (i, j) in (0..first).flat_map(|i| (0..i).map(move |j| (i, j))) {
        for part in 1..PARTS {
            if !go_on() {
                return None;
            }
            let guess = between(&frame, (&known[i], &known[j]), f64::from(part) / f64::from(PARTS));
            learn(&mut known, guess.and_then(|guess| MachineCycle::near(&frame, &guess, label.periods)));
        }
    }
    let mut found: Vec<MachineCycle> = known.into_iter().filter(|cycle| cycle.label == label).collect();
    found.sort_by(|a, b| a.fastest().total_cmp(&b.fastest()));
    Some(found)
}

/// Adds a cycle that is new.
fn learn(known: &mut Vec<MachineCycle>, cycle: Option<MachineCycle>) {
    if let Some(cycle) = cycle
        && !known.iter().any(|other| other.same_as(&cycle, SAME))
    {
        known.push(cycle);
    }
}

/// The state at this part of the way from one cycle to another, at the phase at which the first one begins; `None` where
/// they are in different regimes.
fn between(frame: &MachineFrame<'_>, (a, b): (&MachineCycle, &MachineCycle), part: f64) -> Option<Place> {
    let (from, to) = (a.strobes.first()?, b.strobes.first()?);
    let ahead = phase::wrap(from.phase - to.phase) / frame.machine.parts().frequency?;
    let to = MachineLap::fly(frame, to, ahead)?.end;
    if from.states != to.states {
        return None;
    }
    let (x, y) = (frame.shape.values(from), frame.shape.values(&to));
    let mixed: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x + part * (y - x)).collect();
    Some(frame.shape.with_values(from, &mixed))
}
