//! Whether an impact of a solution is a grazing contact: its speed is zero to within rounding.
//!
//! A cycle with an impact of speed zero and the cycle without it are the same motion, which grazes the stop. On both
//! sides of such a grazing event the equations of the cycle with the impact have a solution, whose speed changes sign
//! at the event. At the event itself the speed is zero and rounding gives it either sign. Such a solution is not an
//! orbit of its label.
//!
//! The decision uses the grazing contact, which is computed without that speed. Without any other impact the mass
//! grazes where $`\delta = |f|`$. Otherwise the impact is removed and the equations of the remaining ones are solved.
//! The distance of the flight from the stop at its turning point is then compared with its rounding error.

use super::clearance::turning_near;
use super::cyclic::leaving;
use super::free;
use super::newton::solve;
use super::ring::Ring;
use crate::system::{Oscillator, phase};

/// Whether impact `k` of `ring`, a solution of the equations of `osc`, is a grazing contact.
pub(super) fn grazes(osc: &Oscillator, ring: &Ring, k: usize) -> bool {
    let (m, side, slow) = (ring.len(), ring.side(k), SLOW * osc.size());
    if ring.speed(k) > slow {
        return false;
    }
    if (0..m).all(|j| ring.speed(j) <= slow) {
        return free::excess(osc, side) == 0.0;
    }
    let before = (k + m - 1) % m;
    let near = ring.turn(before) / osc.beta();
    let mut without = ring.clone();
    without.remove(k);
    let Some((others, _)) = solve(osc, without.clone()) else { return false };
    // if Newton's method converges to a different solution, nothing is known of this one
    let moved = |(i, (a, b)): (usize, (&f64, &f64))| {
        let off = if i.is_multiple_of(2) { phase::difference(phase::wrap(*a), phase::wrap(*b)) } else { a - b };
        off.abs() > APART
    };
    if others.unknowns.iter().zip(&without.unknowns).enumerate().any(moved) {
        return false;
    }
    // the flight that replaces those to impact k and from it
    let before = if before > k { before - 1 } else { before };
    let (flight, time) = (leaving(osc, &others, before), others.turn(before) / osc.beta());
    let Some(touch) = turning_near(osc, &flight, side, time, near) else { return false };
    let fastest = (0..others.len()).map(|j| others.speed(j).abs()).fold(0.0, f64::max);
    (touch.time - near).abs() * osc.beta() < APART
        && touch.distance.abs() <= ROUNDING * m as f64 * (osc.size() + fastest)
}

/// Speeds above this, relative to the size of the motions, are impacts. Where the speed is proportional to the square
/// root of the distance, the rounding error of the gap alone makes it a few times 1e-8.
const SLOW: f64 = 1e-6;
/// Solutions that differ by less than this in phases and speeds, and grazing contacts that differ by less in phase, are
/// the same.
const APART: f64 = 1e-5;
/// The contribution of each flight of a cycle to the rounding error of the distance, relative to the size of positions
/// and speeds. The evaluation of a flight has about ten rounding errors, and the phases and speeds at its beginning as
/// many.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
