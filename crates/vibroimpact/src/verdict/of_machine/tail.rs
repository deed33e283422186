//! The last part of a motion of a machine, from which its quantities are computed.

use super::returns::Step;
use crate::events::{MachineStart, Place};
use crate::lyapunov::MEASURED_IMPACTS;
use crate::machine::Machine;
use crate::math::general_eigenvalues;
use crate::orbit::{MachineFrame, Stability};
use crate::regime::Normal;
use core::f64::consts::TAU;
use std::sync::Arc;

/// The last steps of a motion, each to an event, over which the quantities of a chaotic motion are measured: at most
/// [`MEASURED_IMPACTS`](crate::quantities::MEASURED_IMPACTS). A motion without a further event has none, and its last
/// state is kept.
#[derive(Clone, Debug)]
pub struct MachineTail {
    /// The state before them.
    pub(crate) from: Place,
    /// Their number.
    pub(crate) steps: u64,
}

impl MachineTail {
    /// That of a motion without a further event.
    pub(crate) fn end(place: &Place) -> Self {
        Self { from: place.clone(), steps: 0 }
    }

    /// The last of the steps of a motion that has come to `end`.
    pub(crate) fn last(steps: &[(Arc<Step>, f64)], end: &Place) -> Self {
        let count = steps.len().min(usize::try_from(MEASURED_IMPACTS).unwrap_or(usize::MAX));
        match steps[steps.len() - count..].first() {
            Some((step, _)) => Self { from: step.begin.clone(), steps: count as u64 },
            None => Self::end(end),
        }
    }

    /// The stability of a motion without a further event; `None` if its regime has no structure.
    pub(crate) fn stability(&self, machine: &Machine) -> Option<Stability> {
        let frame = MachineFrame::new(machine);
        let structure = frame.structure(&self.from.states)?;
        // the derivative over a time in which the slowest decay shows
        let time = TAU / structure.fastest().max(f64::MIN_POSITIVE);
        let derivative = frame.shape.transition(&structure, &frame.normal, &self.from, time);
        let rounding = frame.rounding(&derivative, 1, (1.0, structure.fastest()));
        let multipliers = general_eigenvalues(&frame.without_translations(derivative))?;
        Some(Stability::of(&multipliers, rounding))
    }

    /// The state before them as a start.
    pub(crate) fn start(&self, machine: &Machine) -> MachineStart {
        self.from.start(machine, &Normal::new(machine))
    }
}
