//! How small changes of the state of a structure move during a flight: as the structure does without forcing, exactly.

use super::dense::{Dense, Steps};
use super::drive::Drive;
use crate::math::Matrix;
use crate::regime::{FreeMode, ModalChange, Normal, Structure};

impl Structure {
    /// The derivative of the state a time `s` later by the state now; both are of coordinates and, after them, velocities.
    pub(crate) fn transition(&self, normal: &Normal, s: f64) -> Matrix {
        let n = normal.n;
        let mut result = Matrix::zeros(2 * n, 2 * n);
        let mut free = Vec::new();
        self.free_modes(s, &mut free);
        let mut change = ModalChange::default();
        for (j, unit) in self.unit_changes(normal).iter().enumerate() {
            change.copy(unit);
            self.carry(&mut change, &free, s);
            for i in 0..n {
                result[(i, j)] = self.changed(&self.x[i], &change);
                result[(n + i, j)] = self.changed(&self.v[i], &change);
            }
        }
        result
    }

    /// The free motions of the modes over a time, into `free`.
    pub(crate) fn free_modes(&self, s: f64, free: &mut Vec<FreeMode>) {
        free.clear();
        free.extend(self.modes.iter().map(|mode| mode.free(s)));
    }

    /// Moves a change on by a time, over which the modes have these free motions.
    pub(crate) fn carry(&self, change: &mut ModalChange, free: &[FreeMode], s: f64) {
        if self.dense.is_some() {
            return self.stepped(change, s);
        }
        for (i, (mode, free)) in self.modes.iter().zip(free).enumerate() {
            let (y, v, p) = (change.y[i], change.v[i], change.push[i]);
            // by 1 - C, so that a short time changes little and loses no digits
            change.y[i] = y - y * free.one_minus_c + v * free.s + p * free.step;
            change.v[i] = (p - mode.k * y) * free.s + v * free.s_rate;
        }
    }

    /// Moves a change of a structure without modes.
    fn stepped(&self, change: &mut ModalChange, s: f64) {
        let Some((stiffness, damping)) = &self.dense else { return };
        // displacements are counted from the beginning
        let pulled = stiffness.apply(&change.y);
        let steady = change.push.iter().zip(&pulled).map(|(push, pulled)| push - pulled).collect();
        let drive = Drive { steady, ramp: vec![0.0; pulled.len()], ..Drive::default() };
        let dense = Dense { stiffness, damping, drive: &drive, rate: self.fastest() };
        let (moved, v, _) = dense.at(&change.v, s, &mut Steps::default());
        change.y.iter_mut().zip(moved).for_each(|(y, moved)| *y += moved);
        change.v = v;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Machine, MachineParts};

    /// Over twice the time the derivative is the square, also of a structure without modes: at the second damping the
    /// eigenvalues of both modes meet.
    #[test]
    fn squares() {
        for (damping, stiffness, without_modes) in [(0.3, 2.0, false), (0.595_126_65, 0.912_081_07, true)] {
            let parts = MachineParts::new(["a", "b"])
                .with_mass(0, 1.0)
                .with_mass(1, 1.0)
                .with_link(&[1.0, 0.0], 1.0, damping)
                .with_link(&[0.0, 1.0], stiffness, 0.05)
                .with_link(&[1.0, -1.0], 0.3, 0.0);
            let machine = Machine::new(parts).unwrap();
            let normal = Normal::new(&machine);
            let structure = Structure::new(&machine, &normal, &[]).unwrap();
            assert_eq!(structure.dense.is_some(), without_modes);
            let (one, two) = (structure.transition(&normal, 0.7), structure.transition(&normal, 1.4));
            for (a, b) in one.times(&one).values().iter().zip(two.values()) {
                assert!((a - b).abs() < 1e-14, "{a} {b}");
            }
        }
    }
}
