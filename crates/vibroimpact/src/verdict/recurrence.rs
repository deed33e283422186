//! Recurrence of impacts, which suggests a period, and the test whether a motion is captured by a cycle.

use super::recurring::{Measurement, Recurring};
use crate::lyapunov::{Measure, Tail};
use crate::motion::ImpactState;
use crate::orbit::{Cycle, Lap, Stability, cycle_distance, flight_limits, shoot_stable};
use crate::system::Oscillator;
use core::f64::consts::TAU;

/// A period suggested by the latest impacts.
pub(super) struct Candidate {
    /// Number of returns.
    pub(super) m: usize,
    /// Their time.
    pub(super) time: f64,
    /// Whether the last returns equal the earlier ones up to the small remainder of a transient.
    pub(super) close: bool,
}

/// The numbers of returns after which the last ones resemble earlier ones, smallest first. `returns` holds the states and
/// the time since the return before; at most `longest` of them are compared. A chance resemblance is more likely for a larger number m, so the tolerance is proportional to 1/m.
pub(super) fn candidates<R: Recurring>(
    system: &R,
    returns: &[(R::Return, f64)],
    longest: usize,
    tolerance: f64,
) -> impl Iterator<Item = Candidate> {
    // two returns in sequence must agree, because a single one may be near by chance
    let j = returns.len() - 1;
    let mut time = 0.0;
    (1..=longest.min(j / 2)).filter_map(move |m| {
        // summed backwards from the last return, so that one pass serves all periods
        time += returns[j + 1 - m].1;
        #[allow(clippy::cast_precision_loss)] // a small count
        let close =
            |k: usize, tolerance: f64| system.distance(&returns[k].0, &returns[k - m].0) * m as f64 <= tolerance;
        let periods = system.periods(time).round();
        // the phases agree, so the time is close to a whole number of periods
        (close(j, tolerance) && close(j - 1, tolerance) && (1.0..1e6).contains(&periods)).then(|| Candidate {
            m,
            time,
            close: close(j, CLOSE) && close(j - 1, CLOSE),
        })
    })
}

/// Whether a motion that arrives at `state` is captured by `cycle`: it is on it to rounding and the cycle is not unstable, or
/// the cycle is stable, and the motion is near and its next period follows
/// the linear law of the cycle so closely that the remainder cannot undo the contraction of the multipliers.
pub(super) fn captured(osc: &Oscillator, state: &ImpactState, cycle: &Cycle) -> bool {
    let nearest =
        cycle.points.iter().min_by(|a, b| cycle_distance(&a.state, state).total_cmp(&cycle_distance(&b.state, state)));
    let Some(nearest) = nearest else { return false };
    let apart = cycle_distance(&nearest.state, state);
    // an unstable cycle is left, however near the motion passes
    let stability = cycle.stability();
    if apart > NEAR || stability == Stability::Unstable {
        return false;
    }
    let m = u32::try_from(cycle.points.len()).unwrap_or(u32::MAX);
    let fly = |from| Lap::fly(osc, from, m, flight_limits(cycle.label.periods));
    // both fly over the same period, so their difference obeys the linear law up to second order
    let (Ok(reference), Ok(real)) = (fly(nearest.state), fly(*state)) else {
        return false;
    };
    // the difference is rounding only, and no law can be seen in it
    if apart <= AT_ROUNDING {
        return true;
    }
    if !stability.is_stable() {
        return false;
    }
    let offset = |a: &ImpactState, b: &ImpactState| {
        [crate::system::phase::difference(a.phase, b.phase), a.velocity - b.velocity]
    };
    let before = offset(state, &nearest.state);
    let linear = reference.derivative(osc).apply(before);
    let after = offset(&real.last, &reference.last);
    // radians, and parts of the impact speed: numbers of one size
    let size = |d: [f64; 2]| d[0].abs().max(d[1].abs() / nearest.state.velocity);
    let left_over = size([after[0] - linear[0], after[1] - linear[1]]);
    // the remainder may undo 0.3 of the contraction at most: the next period is nearer, its remainder smaller, and the
    // motion converges
    let largest = cycle.multipliers[0].modulus();
    left_over <= 0.3 * (1.0 - largest) * size(before) + 1e-12
}

/// See [`Candidate::close`].
const CLOSE: f64 = 1e-8;
/// The distance from a cycle below which capture is tested.
const NEAR: f64 = 1e-3;
/// The distance below which the two differ only by rounding errors.
const AT_ROUNDING: f64 = 1e-10;

impl Recurring for Oscillator {
    type System = Self;
    const LASTING: bool = false;
    type Return = ImpactState;
    type Measure = Measure;
    type MeasuredTail = Tail;

    fn distance(&self, a: &ImpactState, b: &ImpactState) -> f64 {
        cycle_distance(a, b)
    }

    fn periods(&self, time: f64) -> f64 {
        self.beta() * time / TAU
    }

    fn cycle(&self, last: &ImpactState, m: u32, time: f64) -> Option<Cycle> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most 10^6, as that of a candidate
        let n = self.periods(time).round() as u32;
        shoot_stable(self, *last, m, n)
    }

    fn stable(cycle: &Cycle) -> bool {
        cycle.stable()
    }

    fn captured(&self, last: &ImpactState, cycle: &Cycle) -> bool {
        captured(self, last, cycle)
    }

    fn measure(&self, from: &ImpactState, over: u32) -> Measure {
        Measure::new(*from, over)
    }

    fn add(&self, measure: &mut Measure, next: &ImpactState, interval: f64) -> bool {
        measure.impact(self, *next, interval);
        measure.complete()
    }

    fn left(measure: &Measure) -> u32 {
        measure.left()
    }

    fn chaos(&self, measure: &Measure) -> Option<(Measurement<Self>, bool)> {
        measure.chaos(self).map(|(spectrum, chaotic)| ((spectrum, measure.tail()), chaotic))
    }

    fn tail(measured: Tail, _: &[(ImpactState, f64)]) -> Option<Tail> {
        Some(measured)
    }
}
