//! Where the solutions along a step cease to be admissible.

use crate::continuation::trace::tracer::{Problem, Solution, Step, Tracer};

/// The last admissible solution before the inadmissible one at the distance `outside` on a step: its distance, the solution,
/// and what is known of the inadmissible solution next to it.
pub(crate) fn edge<P: Problem>(
    tracer: &Tracer<P>,
    step: &Step<P::Known>,
    outside: f64,
    admissible: impl Fn(&P::Known) -> bool,
) -> Option<(f64, Solution<P::Known>, P::Known)> {
    let at = |s: f64| tracer.at(step, s);
    let (mut low, mut high) = (0.0, outside);
    let mut inside = tracer.here.clone();
    let mut beyond =
        if outside == step.length { Some(step.there.known.clone()) } else { at(outside).map(|at| at.known) };
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if high - low <= 1e-14 * step.length.max(1e-3) {
            break;
        }
        match at(middle) {
            Some(solution) if admissible(&solution.known) => (low, inside) = (middle, solution),
            Some(solution) => (high, beyond) = (middle, Some(solution.known)),
            None => high = middle,
        }
    }
    Some((low, inside, beyond?))
}
