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
pub(crate) struct ModalChange {
    pub(crate) y: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) push: Vec<f64>,
    pub(crate) set: Vec<f64>,
}

impl Structure {
    /// The number of stops, after which joints are counted.
    pub(crate) const fn stops(&self) -> usize {
        self.states.len() - self.joints
    }

    /// The change of the modes that belongs to a change of the state.
    pub(crate) fn modal_change(&self, normal: &Normal, x: &[f64], v: &[f64]) -> ModalChange {
        let stops = self.stops();
        let set: Vec<f64> = (0..self.joints)
            // where a joint holds moves with the state; of others the set point has no effect
            .map(|joint| match self.states[stops + joint] {
                ContactState::Holding => dot(&normal.directions[stops + joint], x),
                _ => 0.0,
            })
            .collect();
        let by_set = |signal: &Signal| dot(&signal.set, &set);
        let (mut y, mut rate) = (Vec::new(), Vec::new());
        self.modal(x, v, by_set, &mut RestBuffers::default(), (&mut y, &mut rate));
        let push = self.drive.iter().map(by_set).collect();
        ModalChange { y, v: rate, push, set }
    }

    /// The change of a linear function of the state.
    pub(crate) fn changed(&self, of: &Observable, change: &ModalChange) -> f64 {
        dot(&of.position, &change.y) + dot(&of.velocity, &change.v) + dot(&of.signal.set, &change.set)
    }

    /// The change of the modes that belongs to a unit of component `j` of the state.
    pub(crate) fn unit_change(&self, normal: &Normal, j: usize) -> ModalChange {
        let n = normal.n;
        let unit = |from: usize| (0..n).map(|i| if from + i == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
        self.modal_change(normal, &unit(0), &unit(n))
    }

    /// The gradient of a linear function of the state: by coordinates and, after them, by velocities.
    pub(crate) fn gradient(&self, normal: &Normal, of: &Observable) -> Vec<f64> {
        (0..2 * normal.n).map(|j| self.changed(of, &self.unit_change(normal, j))).collect()
    }
}
