//! The constant force on the modes of a structure at a position. The difference between all forces there and those of the
//! modes' own stiffness is formed in the coordinates, where nothing cancels: a stiff stop at gap 0 pushes with exactly
//! nothing.

use super::signal::Signal;
use crate::math::{Matrix, add_scaled, dot};

/// The constant force on the modes at a position, from the force on the coordinates there.
#[derive(Clone, Debug)]
pub(super) struct RestForce {
    pub(super) stiffness: Matrix,
    /// Constant force on each coordinate, without contacts.
    pub(super) force: Vec<f64>,
    pub(super) free: Matrix,
    /// What the constraints carry along.
    pub(super) carried: Vec<Signal>,
    /// The closed stops.
    pub(super) contacts: Vec<RestContact>,
    /// $`B_2 + 2dA_2`$ and $`A_2`$.
    pub(super) push: Matrix,
    pub(super) drift: Matrix,
}

/// A closed stop: its place, stiffness, constant force at gap 0, direction, and direction in the free directions.
#[derive(Clone, Debug)]
pub(super) struct RestContact {
    pub(super) place: usize,
    pub(super) stiffness: f64,
    pub(super) force: f64,
    pub(super) direction: Vec<f64>,
    pub(super) share: Vec<f64>,
}

impl RestForce {
    /// The force on each mode at the position `x`, and the displacement of each mode that belongs to the velocities `v`
    /// alone. `gap` is the gap of a closed stop with its wall at its mean place. Harmonics of walls and of what they carry
    /// along are counted from their mean, as they are in what drives the modes; `turns` are their sines and cosines.
    pub(super) fn at(
        &self,
        x: &[f64],
        v: &[f64],
        turns: &[(f64, f64)],
        gap: impl Fn(usize) -> f64,
    ) -> (Vec<f64>, Vec<f64>) {
        let swung: Vec<f64> = self.carried.iter().map(|signal| signal.swing(turns)).collect();
        let mean: Vec<f64> = x.iter().zip(&swung).map(|(x, swung)| x - swung).collect();
        let pulled = self.stiffness.apply(&mean);
        let left: Vec<f64> = self.force.iter().zip(&pulled).map(|(force, pulled)| force - pulled).collect();
        let mut on_free = self.free.apply_transposed(&left);
        for contact in &self.contacts {
            let gap = gap(contact.place) + dot(&contact.direction, &swung);
            add_scaled(&mut on_free, contact.stiffness * gap + contact.force, &contact.share);
        }
        (self.push.apply(&on_free), self.drift.apply(&self.free.apply_transposed(v)))
    }
}
