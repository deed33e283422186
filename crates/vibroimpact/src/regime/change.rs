//! Small changes of the state of a structure, and the gradients of guards.
//!
//! A structure is linear, so a change obeys its equations without forcing. The state consists of the mass-normalised
//! coordinates and velocities, $`2n`$ numbers. Set points of joints that hold belong to it through
//! $`w\cdot x`$.

use super::contact_state::ContactState;
use super::normal::Normal;
use super::rest_force::RestBuffers;
use super::signal::{Observable, Signal};
use super::structure::Structure;
use crate::math::dot;

/// A change of the modes: displacements, velocities, and constant forces (from set points).
#[derive(Clone, Debug, Default)]
pub(crate) struct ModalChange {
    pub(crate) y: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) push: Vec<f64>,
    pub(crate) set: Vec<f64>,
}

impl ModalChange {
    /// Becomes a copy of another change, in its own memory.
    pub(crate) fn copy(&mut self, other: &Self) {
        self.y.clone_from(&other.y);
        self.v.clone_from(&other.v);
        self.push.clone_from(&other.push);
        self.set.clone_from(&other.set);
    }
}

impl Structure {
    /// The number of stops, after which joints are counted.
    pub(crate) const fn stops(&self) -> usize {
        self.states.len() - self.joints
    }

    /// The change of the modes that belongs to a change of the state.
    pub(crate) fn modal_change(&self, normal: &Normal, x: &[f64], v: &[f64]) -> ModalChange {
        let mut change = ModalChange::default();
        self.modal_change_into(normal, (x, v), &mut RestBuffers::default(), &mut change);
        change
    }

    /// The same, in the memory of another change.
    pub(crate) fn modal_change_into(
        &self,
        normal: &Normal,
        (x, v): (&[f64], &[f64]),
        buffers: &mut RestBuffers,
        change: &mut ModalChange,
    ) {
        let stops = self.stops();
        let ModalChange { y, v: rate, push, set } = change;
        set.clear();
        // where a joint holds moves with the state; of others the set point has no effect
        set.extend((0..self.joints).map(|joint| match self.states[stops + joint] {
            ContactState::Holding => dot(&normal.directions[stops + joint], x),
            _ => 0.0,
        }));
        let by_set = |signal: &Signal| dot(&signal.set, set);
        self.modal(x, v, by_set, buffers, (y, rate));
        push.clear();
        push.extend(self.drive.iter().map(by_set));
    }

    /// The change of a linear function of the state.
    pub(crate) fn changed(&self, of: &Observable, change: &ModalChange) -> f64 {
        dot(&of.position, &change.y) + dot(&of.velocity, &change.v) + dot(&of.signal.set, &change.set)
    }

    /// The changes of the modes that belong to a unit of each component of the state, computed once.
    pub(crate) fn unit_changes(&self, normal: &Normal) -> &[ModalChange] {
        self.units.get_or_init(|| {
            let n = normal.n;
            let unit = |j: usize| {
                let mut state = vec![0.0; 2 * n];
                state[j] = 1.0;
                self.modal_change(normal, &state[..n], &state[n..])
            };
            (0..2 * n).map(unit).collect()
        })
    }

    /// The gradient of a linear function of the state: by coordinates and, after them, by velocities.
    pub(crate) fn gradient(&self, normal: &Normal, of: &Observable) -> Vec<f64> {
        self.unit_changes(normal).iter().map(|unit| self.changed(of, unit)).collect()
    }
}
