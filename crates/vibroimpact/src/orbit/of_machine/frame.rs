//! A machine together with what its motions need again and again: mass-normalised coordinates and the structures of its
//! regimes.

use crate::arc::Modes;
use crate::events::{MachineMotion, Place, StateShape, Structures};
use crate::machine::Machine;
use crate::math::{Matrix, add_scaled};
use crate::regime::{ContactState, Normal, Structure, Translations};
use crate::system::phase;
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

/// The largest difference of two states but for a translation, relative to the sizes of coordinates and velocities; infinite
/// in different regimes.
pub(crate) fn distance(free: &Translations, (a, b): (&Place, &Place), (size, speed): (f64, f64)) -> f64 {
    if a.states != b.states {
        return f64::INFINITY;
    }
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let x = if free.is_empty() {
        apart(&a.x, &b.x)
    } else {
        let mut x: Vec<f64> = a.x.iter().zip(&b.x).map(|(a, b)| a - b).collect();
        free.remove(&mut x);
        x.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    let part = |apart: f64, size: f64| if apart == 0.0 { 0.0 } else { apart / size };
    let (x, v) = (part(x, size), part(apart(&a.v, &b.v), speed));
    x.max(v).max(phase::difference(a.phase, b.phase).abs())
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

    /// The largest sizes of coordinates and velocities. Of coordinates that can be translated the way counts that the
    /// velocity goes in a radian of the forcing, because their own size depends on how far they have come.
    pub(crate) fn sizes(&self, place: &Place) -> (f64, f64) {
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let free = &self.normal.translations;
        let speed = largest(&place.v);
        if free.is_empty() {
            return (largest(&place.x), speed);
        }
        let mut x = place.x.clone();
        free.remove(&mut x);
        (largest(&x).max(self.machine.parts().frequency.map_or(0.0, |frequency| speed / frequency)), speed)
    }

    /// The distance of two states, but for a translation.
    pub(crate) fn distance(&self, a: &Place, b: &Place, sizes: (f64, f64)) -> f64 {
        distance(&self.normal.translations, (a, b), sizes)
    }

    /// The components of a state less those of another, but for a translation.
    pub(crate) fn apart(&self, a: &Place, b: &Place) -> Vec<f64> {
        let mut apart: Vec<f64> = self.shape.values(a).iter().zip(self.shape.values(b)).map(|(a, b)| a - b).collect();
        self.normal.translations.remove(&mut apart);
        apart
    }

    /// Moves a state by a translation, so that it has no part along one.
    pub(crate) fn centre(&self, place: &mut Place) {
        self.normal.translations.remove(&mut place.x);
    }

    /// A derivative of states by states from which translations are removed before and after: it has as many rows less.
    pub(crate) fn without_translations(&self, derivative: Matrix) -> Matrix {
        let free = &self.normal.translations;
        if free.is_empty() {
            return derivative;
        }
        let others = free.others(self.shape.size());
        others.transposed().times(&derivative.times(&others))
    }

    /// The number of multipliers of a cycle: two for each coordinate, less one for each translation.
    pub(crate) const fn multipliers(&self) -> usize {
        2 * self.shape.n - self.normal.translations.count()
    }
}
