//! Small changes of the state of a structure: how they move during a flight, and the gradients of guards.
//!
//! A structure is linear, so a change obeys its equations without forcing, and its motion is exact. The state consists of
//! the mass-normalised coordinates and velocities, $`2n`$ numbers. Set points of joints that hold belong to it through
//! $`w\cdot x`$.

use super::contact_state::ContactState;
use super::normal::Normal;
use super::signal::{Observable, Signal};
use super::structure::Structure;
use crate::math::{Matrix, dot};

/// A change of the modes: displacements, velocities, and constant forces (from set points).
pub(crate) struct ModalChange {
    pub(crate) y: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) push: Vec<f64>,
    set: Vec<f64>,
}

impl Structure {
    /// The change of the modes that belongs to a change of the state.
    pub(crate) fn modal_change(&self, normal: &Normal, x: &[f64], v: &[f64]) -> ModalChange {
        let stops = self.states.len() - self.joints;
        let set: Vec<f64> = (0..self.joints)
            .map(|joint| match self.states[stops + joint] {
                ContactState::Holding => dot(&normal.directions[stops + joint], x),
                _ => 0.0,
            })
            .collect();
        let by_set = |signal: &Signal| dot(&signal.set, &set);
        let of = |maps: &[Matrix; 2], signals: &[Signal]| -> Vec<f64> {
            (0..self.modes.len())
                .map(|i| dot(maps[0].row(i), x) + dot(maps[1].row(i), v) - by_set(&signals[i]))
                .collect()
        };
        let y = of(&self.to_y, &self.to_y_signal);
        let z = of(&self.to_z, &self.to_z_signal);
        let rate = z.iter().zip(&self.slip).map(|(z, slip)| z + by_set(slip)).collect();
        let push = self.drive.iter().map(by_set).collect();
        ModalChange { y, v: rate, push, set }
    }

    /// The change of a linear function of the state.
    pub(crate) fn changed(&self, of: &Observable, change: &ModalChange) -> f64 {
        dot(&of.position, &change.y) + dot(&of.velocity, &change.v) + dot(&of.signal.set, &change.set)
    }

    /// The change of the modes after a time `s` of flight; `None` for a structure without modes.
    fn moved(&self, change: &mut ModalChange, s: f64) -> Option<()> {
        if self.dense.is_some() {
            return None;
        }
        for (i, mode) in self.modes.iter().enumerate() {
            let free = mode.free(s);
            let (y, v, p) = (change.y[i], change.v[i], change.push[i]);
            change.y[i] = y - y * free.one_minus_c + v * free.s + p * free.step;
            change.v[i] = (p - mode.k * y) * free.s + v * free.s_rate;
        }
        Some(())
    }

    /// The derivative of the state a time `s` later by the state now; both are of coordinates and, after them, velocities.
    pub(crate) fn transition(&self, normal: &Normal, s: f64) -> Matrix {
        let n = normal.n;
        let mut result = Matrix::zeros(2 * n, 2 * n);
        for j in 0..2 * n {
            let mut change = self.unit_change(normal, j);
            if self.moved(&mut change, s).is_none() {
                self.stepped(&mut change, s);
            }
            for i in 0..n {
                result[(i, j)] = self.changed(&self.x[i], &change);
                result[(n + i, j)] = self.changed(&self.v[i], &change);
            }
        }
        result
    }

    /// The same as `moved` for a structure without modes, by Taylor series in steps.
    fn stepped(&self, change: &mut ModalChange, s: f64) {
        const TERMS: u32 = 24;
        let Some((stiffness, damping)) = &self.dense else { return };
        let steps = (s * self.fastest()).ceil().max(1.0);
        let h = s / steps;
        let mut left = steps;
        while left > 0.0 {
            // derivatives times h^k / k!
            let (mut y, mut v) = (change.y.clone(), change.v.clone());
            let (mut sum_y, mut sum_v) = (y.clone(), v.clone());
            for k in 1..=TERMS {
                let over = h / f64::from(k);
                let (by_y, by_v) = (stiffness.apply(&y), damping.apply(&v));
                let push = |i: usize| if k == 1 { change.push[i] } else { 0.0 };
                let next_v: Vec<f64> = (0..v.len()).map(|i| (push(i) - by_y[i] - by_v[i]) * over).collect();
                y = v.iter().map(|v| v * over).collect();
                v = next_v;
                for i in 0..v.len() {
                    sum_y[i] += y[i];
                    sum_v[i] += v[i];
                }
            }
            (change.y, change.v) = (sum_y, sum_v);
            left -= 1.0;
        }
    }

    /// The change of the modes that belongs to a unit of component `j` of the state.
    fn unit_change(&self, normal: &Normal, j: usize) -> ModalChange {
        let n = normal.n;
        let unit = |from: usize| (0..n).map(|i| if from + i == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
        self.modal_change(normal, &unit(0), &unit(n))
    }

    /// The gradient of a linear function of the state: by coordinates and, after them, by velocities.
    pub(crate) fn gradient(&self, normal: &Normal, of: &Observable) -> Vec<f64> {
        (0..2 * normal.n).map(|j| self.changed(of, &self.unit_change(normal, j))).collect()
    }
}
