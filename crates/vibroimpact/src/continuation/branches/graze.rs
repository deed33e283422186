//! The cycle on the other side of a grazing event.
//!
//! A cycle with an impact of speed zero and the cycle without that impact are the same motion. It solves both systems
//! of equations, so the curves of solutions of both pass through it. The branch continues on the half of the *other*
//! curve on which the new impact has positive speed, or on which the flight clears the stop that it grazed. Whether the
//! parameter continues in the same direction there or turns back is a consequence of this.

use crate::continuation::equations::cycle_equations::CycleEquations;
use crate::continuation::equations::test_functions::TestFunction;
use crate::continuation::trace::equations::{Equations, tangent};
use crate::math::{sort_by, sort_by_key};
use crate::orbit::{Ring, closest};
use crate::system::{Oscillator, Side};
use core::cmp::Reverse;

/// The beginning of the branch beyond a grazing event.
pub(crate) struct Beyond {
    pub(crate) equations: CycleEquations,
    pub(crate) w: Vec<f64>,
    pub(crate) tangent: Vec<f64>,
    /// Test functions that are zero at this point and positive beyond it.
    pub(crate) positive: Vec<TestFunction>,
}

/// The distance along a tangent at which clearances are compared.
const AHEAD: f64 = 1e-6;
/// Impacts closer than this are the same when a ring is tested for repetition.
const SAME: f64 = 1e-7;

/// The branch beyond a point where the flights `touches` (the impact that they leave, and the stop) graze and the
/// impacts `gone` have speed zero; `along` is the tangent of the branch so far. `None` if no impact is left or no
/// direction is found.
pub(crate) fn beyond(
    equations: &CycleEquations,
    (osc, ring, value): (&Oscillator, &Ring, f64),
    touches: &[(usize, Side)],
    gone: &[usize],
    along: &[f64],
) -> Option<Beyond> {
    let mut next = ring.clone();
    let mut row = along[..2 * ring.len()].to_vec();
    // from the last to the first, so that the indices of earlier impacts stay valid
    let mut new: Vec<(usize, f64, Side)> = Vec::new();
    for &(k, side) in touches {
        let touch = closest(osc, ring, k, side)?;
        new.push((k, ring.theta(k) + osc.beta() * touch.time, side));
    }
    sort_by(&mut new, |a, b| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)));
    let mut old: Vec<usize> = gone.to_vec();
    sort_by_key(&mut old, |&k| Reverse(k));
    for &(k, theta, side) in &new {
        next.insert(k, theta, side);
        row.splice(2 * k + 2..2 * k + 2, [0.0, 0.0]);
    }
    for &k in &old {
        // impacts that were inserted before have moved it
        let k = k + new.iter().filter(|(j, ..)| *j < k).count();
        next.remove(k);
        row.drain(2 * k..2 * k + 2);
    }
    if next.len() == 0 {
        return None;
    }
    let whole = next.len();
    // without the impacts the cycle may repeat a shorter one
    if new.is_empty() {
        next = next.smallest(SAME);
        row.truncate(2 * next.len());
    }
    let equations = equations.with(&next);
    let w = CycleEquations::join(&next, value);
    row.push(*along.last()?);
    if new.is_empty() {
        // the flight that replaces impact k
        let less = |k: usize| old.iter().filter(|j| **j < k).count();
        let freed: Vec<(usize, Side)> =
            old.iter().map(|&k| (((k + whole - less(k) - 1) % whole) % next.len(), ring.side(k))).collect();
        clearing(equations, w, &row, &freed)
    } else {
        let at = |theta: f64| (0..next.len()).find(|&k| next.speed(k) == 0.0 && next.theta(k) == theta);
        let new: Vec<usize> = new.iter().filter_map(|(_, theta, _)| at(*theta)).collect();
        striking(equations, w, &new)
    }
}

/// The direction in which the impacts `new` gain speed.
pub(crate) fn striking(equations: CycleEquations, w: Vec<f64>, new: &[usize]) -> Option<Beyond> {
    let mut towards = vec![0.0; w.len()];
    for k in new {
        towards[2 * k + 1] = 1.0;
    }
    let tangent = tangent(&equations, &w, &towards)?;
    Some(Beyond { equations, w, tangent, positive: new.iter().map(|&k| TestFunction::Speed(k)).collect() })
}

/// The direction in which the flights `freed` clear the stop.
fn clearing(equations: CycleEquations, w: Vec<f64>, along: &[f64], freed: &[(usize, Side)]) -> Option<Beyond> {
    let mut tangent = tangent(&equations, &w, &equations.row(along))
        // at a fold in the old direction, that in which the parameter changes
        .or_else(|| tangent(&equations, &w, &equations.parameter_row()))?;
    let clear = |sign: f64| -> Option<f64> {
        let moved: Vec<f64> = w.iter().zip(&tangent).map(|(w, t)| w + sign * AHEAD * t).collect();
        let (osc, ring) = equations.split(&moved)?;
        let distance = |&(k, side): &(usize, Side)| closest(&osc, &ring, k, side).map_or(f64::INFINITY, |c| c.distance);
        freed.iter().map(distance).reduce(f64::min)
    };
    // the direction in which the flights come away from the stops
    if clear(-1.0)? > clear(1.0)? {
        tangent.iter_mut().for_each(|t| *t = -*t);
    }
    let positive = freed.iter().map(|&(k, side)| TestFunction::Clear(k, side)).collect();
    Some(Beyond { equations, w, tangent, positive })
}
