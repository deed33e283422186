//! Recurrence of impacts, which suggests a period, and the test whether a motion is captured by a cycle.

use crate::motion::ImpactState;
use crate::orbit::{Cycle, Lap, cycle_distance, flight_limits};
use crate::system::Oscillator;
use core::f64::consts::TAU;

/// A period suggested by the latest impacts.
pub(super) struct Candidate {
    /// Number of impacts.
    pub(super) m: usize,
    /// Number of forcing periods.
    pub(super) n: u32,
    /// Whether the last impacts equal the earlier ones up to the small remainder of a transient.
    pub(super) close: bool,
}

/// The numbers of impacts after which the last impacts resemble earlier ones, smallest first. `impacts` holds the
/// states and the time since the impact before; at most `longest` impacts are compared. A chance resemblance is more
/// likely for a larger number m, so the tolerance is proportional to 1/m.
pub(super) fn candidates(
    osc: &Oscillator,
    impacts: &[(ImpactState, f64)],
    longest: usize,
    tolerance: f64,
) -> impl Iterator<Item = Candidate> {
    let j = impacts.len() - 1;
    let mut time = 0.0;
    let beta = osc.beta();
    (1..=longest.min(j / 2)).filter_map(move |m| {
        time += impacts[j + 1 - m].1;
        #[allow(clippy::cast_precision_loss)] // a small count
        let close = |k: usize, tolerance: f64| cycle_distance(&impacts[k].0, &impacts[k - m].0) * m as f64 <= tolerance;
        let periods = (beta * time / TAU).round();
        // the phases agree, so the time is close to a whole number of periods
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // checked to be small
        (close(j, tolerance) && close(j - 1, tolerance) && (1.0..1e6).contains(&periods)).then(|| Candidate {
            m,
            n: periods as u32,
            close: close(j, CLOSE) && close(j - 1, CLOSE),
        })
    })
}

/// Whether a motion that arrives at `state` is captured by the stable `cycle`: it is near, and its next period follows
/// the linear law of the cycle so closely that the remainder cannot undo the contraction of the multipliers.
pub(super) fn captured(osc: &Oscillator, state: &ImpactState, cycle: &Cycle) -> bool {
    let nearest =
        cycle.points.iter().min_by(|a, b| cycle_distance(&a.state, state).total_cmp(&cycle_distance(&b.state, state)));
    let Some(nearest) = nearest else { return false };
    let apart = cycle_distance(&nearest.state, state);
    if apart > NEAR || !cycle.stable() {
        return false;
    }
    let m = u32::try_from(cycle.points.len()).unwrap_or(u32::MAX);
    let fly = |from| Lap::fly(osc, from, m, flight_limits(cycle.label.periods));
    let (Ok(reference), Ok(real)) = (fly(nearest.state), fly(*state)) else {
        return false;
    };
    if apart <= AT_ROUNDING {
        return true;
    }
    let offset = |a: &ImpactState, b: &ImpactState| {
        [crate::system::phase::difference(a.phase, b.phase), a.velocity - b.velocity]
    };
    let before = offset(state, &nearest.state);
    let linear = reference.derivative.apply(before);
    let after = offset(&real.last, &reference.last);
    let size = |d: [f64; 2]| d[0].abs().max(d[1].abs() / nearest.state.velocity);
    let left_over = size([after[0] - linear[0], after[1] - linear[1]]);
    let largest = cycle.multipliers[0].modulus();
    left_over <= 0.3 * (1.0 - largest) * size(before) + 1e-12
}

/// See [`Candidate::close`].
const CLOSE: f64 = 1e-8;
/// The distance from a cycle below which capture is tested.
const NEAR: f64 = 1e-3;
/// The distance below which the two differ only by rounding errors.
const AT_ROUNDING: f64 = 1e-10;
