//! A machine together with what its motions need again and again: mass-normalised coordinates and the structures of its
//! regimes.

use crate::arc::Modes;
use crate::events::{MachineMotion, Place, StateShape, Structures};
use crate::machine::Machine;
use crate::math::add_scaled;
use crate::regime::{ContactState, Normal, Structure};
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

    /// The state a time `s` later in the regime of `structure`.
    pub(crate) fn moved(&self, place: &Place, structure: &Arc<Structure>, s: f64) -> Place {
        let flight = place.flight(&self.normal, structure.clone());
        let mut moved = place.clone();
        let mut modes = Modes::default();
        flight.at(s, &mut modes);
        moved.move_along(&flight, (&modes, s), self.machine.parts().frequency);
        moved
    }

    /// Moves a state onto the stops on which it rests, and gives joints that hold the velocity of their belt.
    pub(crate) fn constrain(&self, place: &mut Place) -> Option<()> {
        if !place.states.iter().any(|state| state.constrains()) {
            return Some(());
        }
        let structure = self.structure(&place.states)?;
        let turns = place.turns(&self.normal);
        let stops = self.machine.stops().len();
        let (mut x, mut v) = (place.x.clone(), place.v.clone());
        for (held, across) in structure.held.iter().zip(&structure.across) {
            if *held < stops {
                let (gap, rate, ..) = place.gap(&self.normal, &turns, *held);
                add_scaled(&mut x, gap, across);
                add_scaled(&mut v, rate, across);
            } else {
                add_scaled(&mut v, -place.sliding(self.machine, &self.normal, held - stops).0, across);
            }
        }
        (place.x, place.v) = (x, v);
        Some(())
    }

    /// The largest sizes of coordinates and velocities.
    pub(crate) fn sizes(place: &Place) -> (f64, f64) {
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        (largest(&place.x), largest(&place.v))
    }
}
