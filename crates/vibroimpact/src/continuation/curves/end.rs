//! The reason why a curve ends where no further step converges.
//!
//! Steps become ever shorter towards a point at which the equations are singular. The last cycle shows the kind of the
//! point: all speeds vanish, the halves of the cycle become equal, or a flight takes a whole number of natural periods.

use super::event::{CurveEvent, CurveKind};
use crate::continuation::equations::plane_equations::Plane;
use crate::continuation::equations::plane_tracer::{PlaneSolution, PlaneTracer};
use crate::continuation::trace::equations::Equations;
use crate::orbit::Ring;
use crate::system::Parameter;
use core::f64::consts::TAU;

/// The latest points of a fold curve on which the two halves of the cycle become equal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trail(Vec<(f64, Vec<f64>)>);

/// The number of points that are kept.
const KEPT: usize = 6;
/// The difference of the halves at a point is at most this fraction of that at the point before.
const NEARER: f64 = 0.85;
/// No merging of the halves is extrapolated from a larger difference than this.
const FAR: f64 = 0.2;
/// The largest speed that counts as vanishing where steps become too short, and the largest deviation from a whole
/// number of natural periods.
const NEAR: f64 = 1e-6;
/// The same for speeds on a curve of folds or flips, whose test functions are products of vanishing quantities.
const STILL: f64 = 1e-5;

impl Trail {
    /// Stores the current point of a trace, if the difference of the halves has decreased enough.
    pub(crate) fn pass(&mut self, tracer: &PlaneTracer) {
        let w = &tracer.here.w;
        let Some(unlike) = tracer.problem.plane.split(w).and_then(|(_, ring)| unlike(&ring)) else { return };
        match self.0.last() {
            // the halves go apart: what comes is another approach
            Some((last, _)) if unlike > *last => self.0.clear(),
            Some((last, _)) if unlike > NEARER * last => return,
            _ => {}
        }
        self.0.push((unlike, w.clone()));
        if self.0.len() > KEPT {
            self.0.remove(0);
        }
    }

    /// The unknowns at which the halves are equal; `None` if there are too few points. Everything that does not change
    /// when the halves are exchanged is an even function of their difference, so it is extrapolated in the square of
    /// the difference.
    fn merged(&self, plane: &Plane) -> Option<Vec<f64>> {
        if self.0.len() < KEPT || self.0.last()?.0 > FAR {
            return None;
        }
        let mut table: Vec<(f64, Vec<f64>)> = Vec::new();
        for (unlike, w) in &self.0 {
            let (_, ring) = plane.split(w)?;
            table.push((unlike * unlike, Plane::join(&evened(&ring), Plane::values(w))));
        }
        // Neville's scheme at 0
        for order in 1..table.len() {
            for k in 0..table.len() - order {
                let (near, far) = (table[k + order].0, table[k].0);
                let next = table[k + 1].1.clone();
                for (value, other) in table[k].1.iter_mut().zip(next) {
                    *value = (far * other - near * *value) / (far - near);
                }
            }
        }
        Some(table.swap_remove(0).1)
    }
}

/// The difference between the two halves of a ring; `None` for an odd number of impacts.
fn unlike(ring: &Ring) -> Option<f64> {
    let m = ring.len();
    if m.is_multiple_of(2) { ring.unlike_after(m / 2) } else { None }
}

/// The ring with each half replaced by the mean of both halves.
fn evened(ring: &Ring) -> Ring {
    let (m, mut even) = (ring.len(), ring.clone());
    let half = m / 2;
    let turn = 0.5 * TAU * f64::from(ring.periods);
    for k in 0..half {
        let theta = 0.5 * (ring.theta(k) + ring.theta(k + half) - turn);
        let speed = 0.5 * (ring.speed(k) + ring.speed(k + half));
        (even.unknowns[2 * k], even.unknowns[2 * k + 1]) = (theta, speed);
        (even.unknowns[2 * (k + half)], even.unknowns[2 * (k + half) + 1]) = (theta + turn, speed);
    }
    even
}

/// The point at which a trace ends, and its kind; `None` if no reason is known.
pub(crate) fn reason(tracer: &PlaneTracer, kind: CurveKind, trail: &Trail) -> Option<(PlaneSolution, CurveEvent)> {
    let (plane, here) = (&tracer.problem.plane, &tracer.here);
    let (osc, ring) = plane.split(&here.w)?;
    let m = ring.len();
    let onward = |step: f64| here.w.iter().zip(&here.tangent).map(|(w, t)| w + step * t).collect::<Vec<f64>>();
    let solution = |w: Vec<f64>| PlaneSolution { w, ..here.clone() };
    let grazing = matches!(kind, CurveKind::Grazing { .. });
    let still = if grazing { NEAR } else { STILL };
    if m > 1 && (0..m).all(|k| ring.speed(k).abs() < still) {
        // extrapolates along the tangent to the point at which the fastest impact has speed zero
        let fastest = (0..m).max_by(|&a, &b| ring.speed(a).abs().total_cmp(&ring.speed(b).abs()))?;
        // Newton's step along the tangent
        let step = -ring.speed(fastest) / here.tangent[2 * fastest + 1];
        return (step.abs() < 1e3 * still).then(|| (solution(onward(step)), CurveEvent::LossOfContact));
    }
    if kind == CurveKind::Fold
        && let Some(w) = trail.merged(plane)
    {
        let off: Vec<f64> = w.iter().zip(&here.w).map(|(a, b)| a - b).collect();
        return (plane.length(&off) < FAR).then(|| (solution(w), CurveEvent::DegenerateFlip));
    }
    if !grazing && let Some(w) = unbounded(tracer, &ring) {
        return Some((solution(w), CurveEvent::Unbounded));
    }
    let turns = f64::from(ring.periods) / osc.beta();
    let whole = turns.round();
    if m == 1 && osc.damping() == 0.0 && (turns - whole).abs() < NEAR {
        let n = f64::from(ring.periods);
        let Some((first, second)) = plane.over.parameters() else {
            return Some((solution(at_frequency(plane, here, n / whole)?), CurveEvent::WholePeriods));
        };
        let mut w = here.w.clone();
        let (p, q) = (w.len() - 2, w.len() - 1);
        for (at, parameter) in [(p, first), (q, second)] {
            let exact = match parameter {
                Parameter::Beta => n / whole,
                Parameter::InverseBeta => whole / n,
                _ => continue,
            };
            let step = (exact - w[at]) / here.tangent[at];
            if step.abs() < 1e3 * NEAR {
                w = onward(step);
            }
            w[at] = exact;
        }
        return Some((solution(w), CurveEvent::WholePeriods));
    }
    None
}

/// The unknowns on the tangent at a point where the frequency ratio is `beta`, by the secant method; `None` if that is far.
fn at_frequency(plane: &Plane, here: &PlaneSolution, beta: f64) -> Option<Vec<f64>> {
    let at = |step: f64| here.w.iter().zip(&here.tangent).map(|(w, t)| w + step * t).collect::<Vec<f64>>();
    let off = |step: f64| plane.oscillator(Plane::values(&at(step))).map(|osc| osc.beta() - beta);
    let (mut step, mut value) = (0.0, off(0.0)?);
    let (mut next, mut there) = (NEAR, off(NEAR)?);
    for _ in 0..8 {
        if there == value {
            break;
        }
        let better = next - there * (next - step) / (there - value);
        (step, value, next) = (next, there, better);
        there = off(next).filter(|_| next.abs() < 1e3 * NEAR)?;
    }
    Some(at(next))
}

/// The values of the parameters at which the speeds along a curve have no bound, as extrapolated; `None` where the
/// speeds are bounded. Restitution must be one of the parameters, and it is 1 there. The difference of the other
/// parameter from its limit is proportional to the inverse of the speeds.
fn unbounded(tracer: &PlaneTracer, ring: &Ring) -> Option<Vec<f64>> {
    let (w, along) = (&tracer.here.w, &tracer.here.tangent);
    let (p, q) = (w.len() - 2, w.len() - 1);
    let rates = tracer.problem.plane.over.rates((w[p], w[q])).ok()?;
    let is_restitution = |of: &[(Parameter, f64)]| matches!(of, [(Parameter::Restitution, rate)] if *rate == 1.0);
    let (eps, other) = match rates.each_ref().map(|of| is_restitution(of)) {
        [true, _] => (p, q),
        [_, true] => (q, p),
        _ => return None,
    };
    let (osc, _) = tracer.problem.plane.split(w)?;
    let fast = (0..ring.len()).all(|k| ring.speed(k) > FAST && along[2 * k + 1] > 0.0);
    if osc.damping() > 0.0 || 1.0 - w[eps] > LOSSLESS || !fast {
        return None;
    }
    let mut limit = w.clone();
    limit[eps] = 1.0;
    // with the parameter p = limit + c/U, the difference from the limit is -U dp/dU
    limit[other] += ring.speed(0) * along[other] / along[1];
    Some(limit)
}

/// Speeds above this that increase, with a restitution as close to 1 as [`LOSSLESS`], increase without bound.
const FAST: f64 = 50.0;
/// See [`FAST`].
const LOSSLESS: f64 = 1e-5;
