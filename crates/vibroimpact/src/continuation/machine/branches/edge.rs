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
    let known = |s: f64| {
        let w = tracer.between(step, s)?;
        Some((tracer.problem.known(&w)?, w))
    };
    let (mut low, mut high, mut inside) = (0.0, outside, None);
    let mut beyond =
        if outside == step.length { Some(step.there.known.clone()) } else { known(outside).map(|(known, _)| known) };
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if high - low <= 1e-14 * step.length.max(1e-3) {
            break;
        }
        match known(middle) {
            Some((known, w)) if admissible(&known) => (low, inside) = (middle, Some(w)),
            Some((known, _)) => (high, beyond) = (middle, Some(known)),
            None => high = middle,
        }
    }
    let inside = inside.map_or_else(|| Some(tracer.here.clone()), |w| tracer.solution(w))?;
    Some((low, inside, beyond?))
}
