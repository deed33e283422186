//! The phase of the force, $`\theta = \beta\tau + \varphi_0`$, in $`[0, 2\pi)`$.
//!
//! Time restarts at each impact and the phase is advanced instead, as in the 1971 paper. The advance $`\beta s`$ is
//! computed exactly (as a product and its error) and reduced by a $`2\pi`$ of 107 bits. So the phase is accurate to its
//! last place for flights of any length, and there is no drift over 1e9 impacts.

use crate::math::{Lane, two_prod, two_sum};
use core::f64::consts::TAU;

/// $`2\pi - `$ [`TAU`].
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

/// 2π in pieces of 33 bits: a whole number below 2^20 times one of the first two is exact.
const TAU_PIECES: [f64; 3] = [6.283_185_306_936_502_5, 2.430_840_202_521_586_4e-10, 8.089_064_995_183_803e-21];
/// Angles up to this are fewer than 2^20 turns.
const SHORT: f64 = 6_000_000.0;

/// The largest magnitude of a phase that may be given. Up to here [`wrap`] is accurate to the last place. Neighbouring
/// doubles of this size are an eighth of a radian apart, so a larger one does not determine an angle.
pub const LARGEST: f64 = 1e15;

/// `angle` modulo $`2\pi`$, in $`[0, 2\pi)`$; for angles up to [`LARGEST`] in magnitude.
#[must_use]
pub fn wrap(angle: f64) -> f64 {
    if (0.0..TAU).contains(&angle) { angle } else { reduce(angle, 0.0) }
}

/// The phase reached from `phase` after a time `s` with the frequency ratio `beta`, in $`[0, 2\pi)`$.
#[inline]
#[must_use]
pub fn advance(phase: f64, beta: f64, s: f64) -> f64 {
    let (hi, lo) = advanced(phase, beta, s);
    reduce(hi, lo)
}

/// The same in lanes, for angles of at most 6e6.
#[inline(always)]
pub(crate) fn advance_lanes<L: Lane>(phase: L, beta: L, s: L) -> L {
    let (hi, lo) = advanced(phase, beta, s);
    reduce_short(hi, lo)
}

/// The phase after a time `s`, not reduced, as a sum of two numbers.
#[inline(always)]
fn advanced<L: Lane>(phase: L, beta: L, s: L) -> (L, L) {
    // the product and its rounding error, so that a long flight loses no digits of the phase
    let (turn, turn_low) = two_prod(beta, s);
    let (hi, lo) = two_sum(phase, turn);
    (hi, lo + turn_low)
}

/// The angle from `b` to `a` in the shorter direction, in $`[-\pi, \pi]`$.
#[inline]
#[must_use]
pub fn difference(a: f64, b: f64) -> f64 {
    let d = a - b;
    d - TAU * (d / TAU).round()
}

/// The angle `hi + lo` modulo 2 pi.
fn reduce(hi: f64, lo: f64) -> f64 {
    if hi.abs() < SHORT {
        return reduce_short(hi, lo);
    }
    let turns = (hi * (1.0 / TAU)).floor();
    let (p, pe) = two_prod(turns, TAU);
    within((hi - p) + ((lo - pe) - turns * TAU_LOW))
}

/// The same for angles below [`SHORT`], by pieces of 2 pi whose products are exact.
#[inline(always)]
fn reduce_short<L: Lane>(hi: L, lo: L) -> L {
    let turns = (hi * L::splat(1.0 / TAU)).floor();
    let (first, second, third) = (L::splat(TAU_PIECES[0]), L::splat(TAU_PIECES[1]), L::splat(TAU_PIECES[2]));
    within((hi - turns * first) + ((lo - turns * third) - turns * second))
}

/// Brings `r` into $`[0, 2\pi)`$, if rounding has left it in the neighbouring turn.
#[inline(always)]
fn within<L: Lane>(r: L) -> L {
    let (tau, tau_low, zero) = (L::splat(TAU), L::splat(TAU_LOW), L::splat(0.0));
    let up = (r + tau) + tau_low;
    let up = L::choose(up.less(tau), up, zero);
    let down = ((r - tau) - tau_low).max(zero);
    L::choose(r.less(zero), up, L::choose(r.less(tau), r, down))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sin_cos;

    #[test]
    fn wraps_into_one_turn() {
        for angle in [0.0, -1e-300, 6.3, -6.3, 1e6, -1e6, TAU, -TAU, 1e15] {
            let w = wrap(angle);
            assert!((0.0..TAU).contains(&w), "{angle} -> {w}");
        }
        assert_eq!(wrap(1.5), 1.5);
        assert_eq!(wrap(-0.0).abs(), 0.0);
    }

    /// Angles up to the largest, compared with 2 pi of 190 bits: digits from Python's mpmath, `mpf(angle) % (2 * pi)`.
    #[test]
    fn f10_phases_up_to_the_largest_are_reduced() {
        for (angle, want) in [
            (1000000000000000.0, 2.1096981170701126),
            (-1000000000000000.0, 4.173487190109474),
            (999999999999999.9, 1.9846981170701126),
            (-123456789012345.67, 6.253134088031678),
            (500000000000000.0, 4.19644171212485),
            (628318530717958.6, 6.260492778502931),
            (30000000000000.0, 5.403998454614752),
            (-7000000000000.0, 4.603373313957506),
            (930484283104246.0, 1.8900544710682181),
            (-976690612415717.8, 0.23514445688793228),
            (471983239593751.0, 5.289442664532788),
            (-683974550470503.8, 1.768808432869804),
        ] {
            let found = wrap(angle);
            assert!(difference(found, want).abs() < 1e-15 && (0.0..TAU).contains(&found), "{angle:e}: {found} {want}");
        }
    }

    #[test]
    fn long_flights_keep_the_phase() {
        // beta * s is exactly representable, so the sine of the unreduced angle is the reference
        for s in [4.0, 4e6, 4e12] {
            let (sine, cosine) = sin_cos(advance(1.0, 0.75, s));
            let (want_sine, want_cosine) = sin_cos(1.0 + 0.75 * s);
            assert!((sine - want_sine).abs() < 5e-16 && (cosine - want_cosine).abs() < 5e-16, "s = {s}");
        }
        // if it is not, the error of the product is taken into account: 1e6 forcing periods of 2 pi / 0.9, rounded
        let s = TAU * 1e6 / 0.9;
        let (turn, low) = two_prod(0.9, s);
        let (whole, rest) = two_prod(TAU, 1e6);
        let left = (turn - whole) + (low - rest - 1e6 * TAU_LOW);
        assert!((advance(1.0, 0.9, s) - (1.0 + left)).abs() < 5e-16);
        assert!((difference(0.1, TAU - 0.1) - 0.2).abs() < 1e-15);
    }
}
