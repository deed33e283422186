//! Structures without modes: damping couples modes that are so nearly defective that their eigenvectors would amplify
//! rounding errors. The flight is then summed as a Taylor series in steps of fixed length from its beginning, which needs
//! no eigenvectors. It is slower than the closed form and as exact.

use super::drive::Drive;
use crate::math::{Matrix, dot, sin_cos};
use crate::regime::turned;

/// The terms of a series, and the length of a step in radians of the fastest rate.
const TERMS: usize = 24;
const STEP: f64 = 1.0;

/// The state after a number of steps, kept for the next time.
#[derive(Clone, Debug, Default)]
pub(super) struct Steps {
    /// The number of steps, as a float.
    count: f64,
    /// Displacements since the beginning, and velocities.
    moved: Vec<f64>,
    v: Vec<f64>,
    /// The beginning to which this belongs.
    begin: (Vec<f64>, Vec<f64>),
}

/// A structure without modes: its stiffness and damping in the free directions, and what drives them.
#[derive(Clone, Copy)]
pub(super) struct Dense<'a> {
    pub(super) stiffness: &'a Matrix,
    pub(super) damping: &'a Matrix,
    pub(super) drive: &'a Drive,
    /// A bound of the rates of all motions.
    pub(super) rate: f64,
}

impl Dense<'_> {
    /// The Taylor coefficients of all directions at a state a time `s` after the beginning, row after row of `terms`.
    pub(super) fn coefficients(&self, moved: &[f64], v: &[f64], s: f64, terms: usize, c: &mut Vec<f64>) {
        let count = moved.len();
        c.clear();
        c.resize(count * terms, 0.0);
        let turns: Vec<(f64, f64)> = self.drive.rates.iter().map(|w| sin_cos(w * s)).collect();
        let mut harmonics: Vec<(f64, f64)> = Vec::new();
        for (i, row) in c.chunks_exact_mut(terms).enumerate() {
            harmonics.clear();
            harmonics.extend(turned(self.drive.of(i), turns.iter().copied()));
            (row[0], row[1]) = (moved[i], v[i]);
            self.drive.coefficients(i, s, &harmonics, row);
        }
        // power by power, because each direction needs the lower powers of all
        let mut k = 0.0;
        for j in 2..terms {
            for i in 0..count {
                let mut sum = c[i * terms + j];
                for other in 0..count {
                    sum -= self.damping[(i, other)] * (k + 1.0) * c[other * terms + j - 1];
                    sum -= self.stiffness[(i, other)] * c[other * terms + j - 2];
                }
                c[i * terms + j] = sum / ((k + 1.0) * (k + 2.0));
            }
            k += 1.0;
        }
    }

    /// Displacements and velocities a time `h` after those at `from`.
    fn go(&self, moved: &mut [f64], v: &mut [f64], from: f64, h: f64, c: &mut Vec<f64>) {
        self.coefficients(moved, v, from, TERMS, c);
        for (i, row) in c.chunks_exact(TERMS).enumerate() {
            let (mut value, mut slope) = (0.0, 0.0);
            let mut real = f64::from(u32::try_from(TERMS - 1).unwrap_or(0));
            for k in (1..TERMS).rev() {
                value = value * h + row[k];
                slope = slope * h + real * row[k];
                real -= 1.0;
            }
            moved[i] += value * h;
            v[i] = slope;
        }
    }

    /// Displacements and velocities a time `s` after a beginning with velocities `v`, by steps from there, and a bound of
    /// the rounding errors of the displacements.
    pub(super) fn at(&self, v: &[f64], s: f64, steps: &mut Steps) -> (Vec<f64>, Vec<f64>, f64) {
        let step = if self.rate > 0.0 { STEP / self.rate } else { f64::INFINITY };
        let whole = (s / step).floor();
        // what is kept is of another beginning, or beyond this time
        if steps.count > whole || steps.begin.0 != self.drive.steady || steps.begin.1 != v {
            steps.count = 0.0;
            steps.begin = (self.drive.steady.clone(), v.to_vec());
            steps.moved = vec![0.0; v.len()];
            steps.v = v.to_vec();
        }
        let mut c = Vec::new();
        while steps.count < whole {
            self.go(&mut steps.moved, &mut steps.v, steps.count * step, step, &mut c);
            steps.count += 1.0;
        }
        let (mut moved, mut v) = (steps.moved.clone(), steps.v.clone());
        // without any rate a step is infinite, and no part of it a number
        let begin = if whole > 0.0 { whole * step } else { 0.0 };
        self.go(&mut moved, &mut v, begin, s - begin, &mut c);
        let slow = self.rate.max(f64::MIN_POSITIVE).max(1.0 / s.max(1e-300));
        let size = dot(&moved, &moved).sqrt() + dot(&v, &v).sqrt() / slow;
        // each step adds its rounding errors
        (moved, v, 0.5 * f64::EPSILON * size * (4.0 + whole))
    }
}
