//! Structures without modes: damping couples modes that are so nearly defective that their eigenvectors would amplify
//! rounding errors. The flight is then summed as a Taylor series in steps of fixed length from its beginning, which needs
//! no eigenvectors. It is slower than the closed form and as exact.

use super::flight::{MachineFlight, Modes};
use crate::math::dot;

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

/// The Taylor coefficients of all directions at a state a time `s` after the beginning, row after row of `terms`.
pub(super) fn coefficients(flight: &MachineFlight, y: &[f64], v: &[f64], s: f64, terms: usize, c: &mut Vec<f64>) {
    let Some((stiffness, damping)) = &flight.structure.dense else { return };
    let count = y.len();
    c.clear();
    c.resize(count * terms, 0.0);
    let mut turned: Vec<(f64, f64)> = Vec::new();
    for i in 0..count {
        turned.clear();
        turned.extend(flight.mode_harmonics(i).iter().zip(&flight.structure.rates).map(|((a, b), w)| {
            let (sin, cos) = crate::math::sin_cos(w * s);
            (a * cos + b * sin, b * cos - a * sin)
        }));
        let row = &mut c[i * terms..(i + 1) * terms];
        (row[0], row[1]) = (y[i], v[i]);
        flight.driven(i, s, &turned, row);
    }
    let mut k = 0.0;
    for j in 2..terms {
        for i in 0..count {
            let mut sum = c[i * terms + j];
            for other in 0..count {
                sum -= damping[(i, other)] * (k + 1.0) * c[other * terms + j - 1];
                sum -= stiffness[(i, other)] * c[other * terms + j - 2];
            }
            c[i * terms + j] = sum / ((k + 1.0) * (k + 2.0));
        }
        k += 1.0;
    }
}

/// The displacements after a time, by steps from the beginning.
pub(super) fn at(flight: &MachineFlight, s: f64, modes: &mut Modes) {
    let count = flight.v.len();
    let rate = flight.structure.modes.first().map_or(0.0, |mode| mode.rate);
    let rate = rate.max(flight.structure.rates.last().copied().unwrap_or(0.0));
    let step = if rate > 0.0 { STEP / rate } else { f64::INFINITY };
    let whole = (s / step).floor();
    let steps = &mut modes.steps;
    if steps.count > whole || steps.begin.0 != flight.steady || steps.begin.1 != flight.v || steps.moved.len() != count
    {
        steps.count = 0.0;
        steps.begin = (flight.steady.clone(), flight.v.clone());
        steps.moved = vec![0.0; count];
        steps.v = flight.v.clone();
    }
    let mut c = Vec::new();
    let go = |moved: &mut Vec<f64>, v: &mut Vec<f64>, from: f64, h: f64, c: &mut Vec<f64>| {
        coefficients(flight, moved, v, from, TERMS, c);
        for i in 0..count {
            let row = &c[i * TERMS..(i + 1) * TERMS];
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
    };
    while steps.count < whole {
        go(&mut steps.moved, &mut steps.v, steps.count * step, step, &mut c);
        steps.count += 1.0;
    }
    let (mut moved, mut v) = (steps.moved.clone(), steps.v.clone());
    let begin = if whole > 0.0 { whole * step } else { 0.0 };
    go(&mut moved, &mut v, begin, s - begin, &mut c);
    let size = dot(&moved, &moved).sqrt() + dot(&v, &v).sqrt() / rate.max(f64::MIN_POSITIVE).max(1.0 / s.max(1e-300));
    modes.error.resize(count, 0.5 * f64::EPSILON * size * (4.0 + whole));
    modes.moved.extend(moved);
    modes.v.extend(v);
}
