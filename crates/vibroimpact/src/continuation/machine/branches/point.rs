//! A point of a branch of a machine.

use crate::continuation::event::BranchEvent;
use crate::machine::{Machine, StopLaw};
use crate::orbit::{Chatter, MachineRing, machine::Cycle};
use crate::regime::{GuardKind, Normal};

/// A point of a branch.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SolutionPoint {
    /// Value of the number that varies.
    pub value: f64,
    /// The cycle there.
    pub cycle: Cycle,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<BranchEvent>,
    /// At an event the solution there, to rounding: a curve begins with it. Following the motion of `cycle` instead can miss a stop
    /// that it only touches.
    pub(crate) ring: Option<MachineRing>,
}

/// A closing has no speed if it has less than this part of the largest velocity.
const WITHOUT_SPEED: f64 = 1e-6;

impl BranchEvent {
    /// The same on the solution at the event, with the other stop of which a closing has no speed where one disappears; `speed` is
    /// the largest velocity.
    pub(super) fn on(mut self, machine: &Machine, ring: &MachineRing, speed: f64) -> Self {
        let Self::Grazing { stop, also: also @ None, appears: false, .. } = &mut self else { return self };
        let stops = without_speed(machine, ring, speed)
            .into_iter()
            .map(|k| ring.events[k].guard.place(ring.events[k].back.len()));
        *also = stops.into_iter().find(|other| other != stop);
        self
    }
}

/// The closings of a ring that have no speed, where `speed` is the largest velocity.
pub(super) fn without_speed(machine: &Machine, ring: &MachineRing, speed: f64) -> Vec<usize> {
    let normal = Normal::new(machine);
    // the last impacts of a chatter are slow wherever the branch is
    let slows = |chatter: &Chatter| chatter.impacts(ring).into_iter().chain([chatter.rest]);
    let bounces: Vec<usize> = Chatter::all(ring).iter().flat_map(slows).collect();
    let slow = |k: &usize| {
        let GuardKind::Gap(stop) = ring.events[*k].guard else { return false };
        let share = match machine.stops()[stop].law {
            StopLaw::Rigid { restitution } => restitution,
            StopLaw::Compliant { .. } => 1.0,
        };
        let place = ring.place(*k);
        let after = place.gap(&normal, &place.turns(&normal), stop).1.abs();
        !bounces.contains(k) && share > 0.0 && after <= share * WITHOUT_SPEED * (normal.length(stop) * speed)
    };
    (0..ring.len()).filter(slow).collect()
}
