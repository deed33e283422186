//! Where a tracer begins: at a value of the number, or at a solution with a tangent.

use super::problem::MachineProblem;
use crate::continuation::branches::BranchOptions;
use crate::continuation::trace::equations::{correct, tangent, unit};
use crate::continuation::trace::tracer::Tracer;

/// The tracer from the solution near `w` with this value of the number; the number changes in direction `up` first.
pub(super) fn begun(
    problem: MachineProblem,
    w: &[f64],
    value: f64,
    up: f64,
    options: BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let row = |factor| unit(w.len(), w.len() - 1, factor);
    let (there, _) = correct(&problem.equations, w, &row(1.0), value)?;
    let along = tangent(&problem.equations, &there, &row(up))?;
    traced(problem, there, along, options)
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
