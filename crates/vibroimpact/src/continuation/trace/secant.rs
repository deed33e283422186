//! The zero of a test function over the number, the last unknown, among the solutions with given values of it.

use super::equations::{Equations, correct, unit};

/// The first change of the number, relative to 1 plus its size.
const FIRST: f64 = 1e-7;
/// The largest number of steps.
const MAX_STEPS: u32 = 12;

/// The solution near `w` at which `test` is zero, by the secant method; `None` if an equation is not solved on the way.
pub(in crate::continuation) fn zero(
    equations: &impl Equations,
    w: &[f64],
    test: impl Fn(&[f64]) -> Option<f64>,
) -> Option<Vec<f64>> {
    let row = unit(w.len(), w.len() - 1, 1.0);
    let at = |near: &[f64], value: f64| -> Option<(Vec<f64>, f64)> {
        let (w, _) = correct(equations, near, &row, value)?;
        let test = test(&w)?;
        Some((w, test))
    };
    let mut from = *w.last()?;
    let mut before = at(w, from)?;
    let mut there = from + FIRST * (1.0 + from.abs());
    for _ in 0..MAX_STEPS {
        let here = at(&before.0, there)?;
        // the zero of the line through both
        let next = there - here.1 * (there - from) / (here.1 - before.1);
        if !next.is_finite() || (next - there).abs() <= f64::EPSILON * there.abs() {
            return Some(here.0);
        }
        (from, before, there) = (there, here, next);
    }
    Some(before.0)
}
