//! Why a curve ends where no further step converges.
//!
//! Steps become ever shorter towards a point where the equations are singular. What that point is shows in the cycle
//! reached: speeds that vanish together, halves that become alike, a flight of whole natural periods.

use super::point::{CurveEvent, CurveKind};
use crate::continuation::equations::plane_equations::Plane;
use crate::continuation::equations::plane_tracer::{PlaneSolution, PlaneTracer};
use crate::continuation::trace::equations::Equations;
use crate::orbit::Ring;
use crate::system::Parameter;
use core::f64::consts::TAU;

/// The last points of a fold curve on which the two halves of the cycle become alike.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trail(Vec<(f64, Vec<f64>)>);

/// Points kept.
const KEPT: usize = 6;
/// By how much they draw nearer from one to the next.
const NEARER: f64 = 0.85;
/// Halves more unlike than this do not merge yet.
const FAR: f64 = 0.2;
/// Where steps become too short speeds are below this, and halves of the period this near to whole ones.
const NEAR: f64 = 1e-6;
/// The same on a curve of folds or flips, whose test functions are products of what vanishes.
const STILL: f64 = 1e-5;

impl Trail {
    /// Takes note of where a trace is.
    pub(crate) fn pass(&mut self, tracer: &PlaneTracer) {
        let w = &tracer.here.w;
        let Some(unlike) = tracer.problem.plane.split(w).and_then(|(_, ring)| unlike(&ring)) else { return };
        match self.0.last() {
            Some((last, _)) if unlike > *last => self.0.clear(),
            Some((last, _)) if unlike > NEARER * last => return,
            _ => {}
        }
        self.0.push((unlike, w.clone()));
        if self.0.len() > KEPT {
            self.0.remove(0);
        }
    }

    /// Where the halves are alike: everything that does not change when they are exchanged is even in how unlike they are,
    /// so it is extrapolated in the square of that.
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

/// How unlike the two halves of a ring are that could go round a shorter one twice.
fn unlike(ring: &Ring) -> Option<f64> {
    let m = ring.len();
    if m.is_multiple_of(2) { ring.unlike_after(m / 2) } else { None }
}

/// The ring with its halves made alike.
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

/// The point at which a trace is lost, and what it is; `None` for no known reason.
pub(crate) fn reason(tracer: &PlaneTracer, kind: CurveKind, trail: &Trail) -> Option<(PlaneSolution, CurveEvent)> {
    let (plane, here) = (&tracer.problem.plane, &tracer.here);
    let (osc, ring) = plane.split(&here.w)?;
    let m = ring.len();
    let onward = |step: f64| here.w.iter().zip(&here.tangent).map(|(w, t)| w + step * t).collect::<Vec<f64>>();
    let solution = |w: Vec<f64>| PlaneSolution { w, ..here.clone() };
    let still = if kind == CurveKind::Grazing { NEAR } else { STILL };
    if m > 1 && (0..m).all(|k| ring.speed(k).abs() < still) {
        // on by what the fastest one still has
        let fastest = (0..m).max_by(|&a, &b| ring.speed(a).abs().total_cmp(&ring.speed(b).abs()))?;
        let step = -ring.speed(fastest) / here.tangent[2 * fastest + 1];
        return (step.abs() < 1e3 * still).then(|| (solution(onward(step)), CurveEvent::LossOfContact));
    }
    if kind == CurveKind::Fold
        && let Some(w) = trail.merged(plane)
    {
        let off: Vec<f64> = w.iter().zip(&here.w).map(|(a, b)| a - b).collect();
        return (plane.length(&off) < FAR).then(|| (solution(w), CurveEvent::DegenerateFlip));
    }
    if kind != CurveKind::Grazing
        && let Some(w) = unbounded(tracer, &ring)
    {
        return Some((solution(w), CurveEvent::Unbounded));
    }
    let turns = f64::from(ring.periods) / osc.beta();
    let whole = turns.round();
    if m == 1 && osc.damping() == 0.0 && (turns - whole).abs() < NEAR {
        let n = f64::from(ring.periods);
        let mut w = here.w.clone();
        let (p, q) = (w.len() - 2, w.len() - 1);
        for (at, parameter) in [(p, plane.parameters.0), (q, plane.parameters.1)] {
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

/// The parameters at which speeds that grow along a curve have no bound, restitution 1 being one of them; `None` where they do
/// not. The other one differs from its limit by as much as the inverse of the speeds.
fn unbounded(tracer: &PlaneTracer, ring: &Ring) -> Option<Vec<f64>> {
    let (w, along) = (&tracer.here.w, &tracer.here.tangent);
    let (p, q) = (w.len() - 2, w.len() - 1);
    let (eps, other) = match tracer.problem.plane.parameters {
        (Parameter::Restitution, _) => (p, q),
        (_, Parameter::Restitution) => (q, p),
        _ => return None,
    };
    let (osc, _) = tracer.problem.plane.split(w)?;
    let fast = (0..ring.len()).all(|k| ring.speed(k) > FAST && along[2 * k + 1] > 0.0);
    if osc.damping() > 0.0 || 1.0 - w[eps] > LOSSLESS || !fast {
        return None;
    }
    let mut limit = w.clone();
    limit[eps] = 1.0;
    limit[other] += ring.speed(0) * along[other] / along[1];
    Some(limit)
}

/// Speeds above this that grow, with a restitution as near to 1 as [`LOSSLESS`], grow without bound.
const FAST: f64 = 50.0;
/// See [`FAST`].
const LOSSLESS: f64 = 1e-5;
