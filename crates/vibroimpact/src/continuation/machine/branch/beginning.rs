//! Where a tracer begins: at a value of the number, or at a solution with a tangent.

use super::problem::MachineProblem;
use crate::continuation::branches::BranchOptions;
use crate::continuation::trace::equations::{correct, tangent};
use crate::continuation::trace::tracer::Tracer;

/// The tracer from the solution near `w` with this value of the number; the number changes in direction `up` first.
pub(super) fn begun(
    problem: MachineProblem,
    w: &[f64],
    value: f64,
    up: f64,
    options: BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let mut row = vec![0.0; w.len()];
    *row.last_mut()? = 1.0;
    let (w, _) = correct(&problem.equations, w, &row, value)?;
    *row.last_mut()? = up;
    let along = tangent(&problem.equations, &w, &row)?;
    traced(problem, w, along, options)
}

/// The tracer from a solution along a unit tangent.
pub(super) fn traced(
    problem: MachineProblem,
    w: Vec<f64>,
    along: Vec<f64>,
    options: BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    Tracer::new(problem, w, along, options.first_step())
}
