//! A machine together with what its motions need again and again: mass-normalised coordinates and the structures of its
//! regimes.

use crate::arc::{Modes, Recovery};
use crate::events::{MachineMotion, Place, StateShape, Structures};
use crate::machine::Machine;
use crate::regime::{ContactState, Normal, Structure, compliant};
use core::cell::RefCell;
use std::sync::Arc;

/// A machine and the structures of its regimes.
#[derive(Clone, Debug)]
pub(crate) struct MachineFrame<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) normal: Normal,
    pub(crate) shape: StateShape,
    structures: RefCell<Structures>,
}

impl<'a> MachineFrame<'a> {
    pub(crate) fn new(machine: &'a Machine) -> Self {
        let (normal, shape) = (Normal::new(machine), StateShape::of(machine));
        Self { machine, normal, shape, structures: RefCell::default() }
    }

    /// The motion from a state.
    pub(crate) fn resume(&self, place: Place) -> MachineMotion<'a> {
        MachineMotion::resumed(self.machine, self.normal.clone(), self.structures.borrow().clone(), place)
    }

    /// Keeps the structures that a motion has built.
    pub(crate) fn keep(&self, motion: &MachineMotion<'_>) {
        self.structures.borrow_mut().join(motion.structures());
    }

    /// Does something with the structures.
    pub(crate) fn with<T>(&self, of: impl FnOnce(&mut Structures) -> T) -> T {
        of(&mut self.structures.borrow_mut())
    }

    /// The structure with these states of stops and joints.
    pub(crate) fn structure(&self, states: &[ContactState]) -> Option<Arc<Structure>> {
        self.structures.borrow_mut().get(self.machine, &self.normal, states)
    }

    /// How the surface of a damped stop comes back, from a size of 0.
    pub(crate) fn recovery(&self, stop: usize) -> Option<Recovery> {
        let (stiffness, damping, preload) = compliant(&self.machine.stops()[stop].law)?;
        (damping > 0.0).then(|| Recovery { size: 0.0, rate: stiffness / damping, offset: preload / stiffness })
    }

    /// The state a time `s` later in the regime of `structure`.
    pub(crate) fn moved(&self, place: &Place, structure: &Arc<Structure>, s: f64) -> Place {
        let flight = place.flight(&self.normal, structure.clone());
        let mut moved = place.clone();
        moved.move_along(&flight, s, self.machine.parts().frequency, &mut Modes::default());
        moved
    }

    /// The largest sizes of coordinates and velocities.
    pub(crate) fn sizes(place: &Place) -> (f64, f64) {
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        (largest(&place.x), largest(&place.v))
    }
}
