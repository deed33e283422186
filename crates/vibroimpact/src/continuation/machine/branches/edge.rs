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
    let known = |s: f64| tracer.problem.known(&tracer.between(step, s)?);
    let (mut low, mut high) = (0.0, outside);
    let mut beyond = if outside == step.length { Some(step.there.known.clone()) } else { known(outside) };
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if high - low <= 1e-14 * step.length.max(1e-3) {
            break;
        }
        match known(middle) {
            Some(known) if admissible(&known) => low = middle,
            Some(known) => (high, beyond) = (middle, Some(known)),
            None => high = middle,
        }
    }
    let inside = if low > 0.0 { tracer.at(step, low)? } else { tracer.here.clone() };
    Some((low, inside, beyond?))
}
