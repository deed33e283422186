//! Whether an impact of a solution is a graze: its speed zero to within rounding.
//!
//! An impact of speed zero is no impact: a cycle with one and the cycle without it are the same motion, which touches the
//! stop. On both sides of such a touch the equations of the cycle with the impact have a solution, whose speed passes
//! through zero there, and at the touch itself rounding gives it either sign. Such a solution is not an orbit of its label.
//!
//! It is decided by the touch, which is known without that speed. Without any other impact the touch is $`\delta = |f|`$.
//! Otherwise the impact is left out, the remaining ones are solved for, and the distance that the flight leaves at its turning
//! point is compared with what rounding makes of it.

use super::clearance::turning_near;
use super::cyclic::leaving;
use super::free;
use super::newton::solve;
use super::ring::Ring;
use crate::system::{Oscillator, phase};

/// Whether impact `k` of `ring`, a solution of the equations of `osc`, is a graze.
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
    // another solution says nothing of this one
    let moved = |(i, (a, b)): (usize, (&f64, &f64))| {
        let off = if i.is_multiple_of(2) { phase::difference(phase::wrap(*a), phase::wrap(*b)) } else { a - b };
        off.abs() > APART
    };
    if others.unknowns.iter().zip(&without.unknowns).enumerate().any(moved) {
        return false;
    }
    // the flight that takes the place of those to impact k and from it
    let before = if before > k { before - 1 } else { before };
    let (flight, time) = (leaving(osc, &others, before), others.turn(before) / osc.beta());
    let Some(touch) = turning_near(osc, &flight, side, time, near) else { return false };
    let fastest = (0..others.len()).map(|j| others.speed(j).abs()).fold(0.0, f64::max);
    (touch.time - near).abs() * osc.beta() < APART
        && touch.distance.abs() <= ROUNDING * m as f64 * (osc.size() + fastest)
}

/// Speeds above this, over the size of the motions, are impacts. Where the speed grows like the root of what is left to the
/// touch, rounding of the gap alone makes it a few times 1e-8.
const SLOW: f64 = 1e-6;
/// Solutions closer than this in phases and speeds, and touches closer in phase, are the same.
const APART: f64 = 1e-5;
/// What each flight of a cycle adds to the distance at a touch, over the size of positions and speeds: evaluating it takes some
/// ten roundings, and the phases and speeds it begins with are solved for to as many.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
