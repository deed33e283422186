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
    /// Whether any of that moves.
    pub(super) carries: bool,
    /// The closed stops.
    pub(super) contacts: Vec<RestContact>,
    /// The force on each mode per unit of force on each coordinate, and $`A_2`$.
    pub(super) push_of_force: Matrix,
    pub(super) drift: Matrix,
    /// Whether the last is not zero.
    pub(super) drifts: bool,
}

/// Vectors that are used again.
#[derive(Clone, Debug, Default)]
pub(crate) struct RestBuffers {
    swung: Vec<f64>,
    mean: Vec<f64>,
    pulled: Vec<f64>,
    on_free: Vec<f64>,
    drift: Vec<f64>,
    /// Coordinates and velocities in the free directions.
    pub(super) free: [Vec<f64>; 2],
}

/// A closed stop: its stiffness, constant force at gap 0, direction, and the force on each mode per unit of its force.
#[derive(Clone, Debug)]
pub(super) struct RestContact {
    pub(super) stiffness: f64,
    pub(super) force: f64,
    pub(super) direction: Vec<f64>,
    pub(super) push: Vec<f64>,
}

impl RestForce {
    /// The force on each mode at the position `x`, into `push`, and the displacement of each mode that belongs to the
    /// velocities `v` alone, or none. `gaps` are those of the closed stops with their walls at their mean places. Harmonics of walls
    /// and of what they carry along are counted from their mean, as they are in what drives the modes; `turns` are their
    /// sines and cosines.
    #[inline]
    pub(super) fn at<'a>(
        &self,
        x: &[f64],
        v: &[f64],
        turns: &[(f64, f64)],
        gaps: impl Iterator<Item = f64>,
        buffers: &'a mut RestBuffers,
        push: &mut Vec<f64>,
    ) -> &'a [f64] {
        let RestBuffers { swung, mean, pulled, on_free, drift, .. } = buffers;
        let mean = if self.carries {
            // counted from the mean of what swings: the harmonics drive the modes apart from this
            swung.resize(x.len(), 0.0);
            for (swung, signal) in swung.iter_mut().zip(&self.carried) {
                *swung = signal.swing(turns);
            }
            mean.clear();
            mean.extend(x.iter().zip(swung.iter()).map(|(x, swung)| x - swung));
            mean
        } else {
            x
        };
        // the force less that of the springs, in the coordinates, where stiff stops are no part of it
        self.stiffness.apply_into(mean, pulled);
        for (pulled, force) in pulled.iter_mut().zip(&self.force) {
            *pulled = force - *pulled;
        }
        self.push_of_force.apply_into(pulled, push);
        for (contact, mut gap) in self.contacts.iter().zip(gaps) {
            if self.carries {
                gap += dot(&contact.direction, swung);
            }
            add_scaled(push, contact.stiffness * gap + contact.force, &contact.push);
        }
        drift.clear();
        if self.drifts {
            self.free.apply_transposed_into(v, on_free);
            self.drift.apply_into(on_free, drift);
        }
        drift
    }
}
