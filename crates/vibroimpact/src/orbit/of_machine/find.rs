//! Periodic motions of a machine with a label, stable or not, from many guesses.

use super::cycle::MachineCycle;
use super::frame::MachineFrame;
use crate::events::{MachineLimits, MachineMotion, MachineStart};
use crate::machine::Machine;
use crate::orbit::Label;

/// The forcing periods after which a motion is a guess.
const AFTER: [f64; 4] = [1.0, 4.0, 16.0, 60.0];
/// Cycles that differ by less are the same.
const SAME: f64 = 1e-6;
/// The largest number of events of the motion from one start.
const EVENTS: usize = 20_000;

/// The orbits of `machine` with the label `label` to which Newton's method leads from the motions from `starts`, the fastest
/// last; stopped when `go_on` returns false, and then `None`. A start that is not allowed is passed over, and an orbit to
/// which no guess leads is not found.
#[must_use]
pub fn find_machine_while(
    machine: &Machine,
    label: Label,
    starts: impl IntoIterator<Item = MachineStart>,
    go_on: impl Fn() -> bool,
) -> Option<Vec<MachineCycle>> {
    let frame = MachineFrame::new(machine);
    let mut found: Vec<MachineCycle> = Vec::new();
    let Some(period) = machine.period() else { return Some(found) };
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
            if let Some(cycle) = MachineCycle::near(&frame, motion.place(), label.periods)
                && cycle.label == label
                && !found.iter().any(|known| known.same_as(&cycle, SAME))
            {
                found.push(cycle);
            }
        }
    }
    found.sort_by(|a, b| a.fastest().total_cmp(&b.fastest()));
    Some(found)
}
