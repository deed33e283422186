//! Proves for a step that comes close to a stop and turns back that it does not reach the stop: its [hull](super::hull)
//! is divided at the highest point of the arc.
//!
//! The control polygon of a Bernstein polynomial lies above its maximum by about $`|a| h^2/24`$, and halving the step
//! reduces this only by a factor of four. If the polynomial is divided at its maximum (de Casteljau), each part is
//! nearly monotone and its polygon ends at the maximum, so only the error term remains. This also shows an arc that
//! rises above the stop for a short time, and where it does. The place of the maximum need not be exact: the parts are
//! a hull wherever the polynomial is divided.

use super::constants::Constants;
use super::hull::{End, Hull};
use super::stride::HullScale;
use crate::math::{Lane, Mask};

/// The number of Newton steps to the maximum, beginning at that of a parabola.
const ITERATIONS: usize = 3;

/// The result for a step that was not proven clear.
#[derive(Clone, Copy)]
pub(super) struct Swing<L: Lane> {
    /// Whether it is proven clear of the stops.
    pub(super) clear: L::Mask,
    /// Whether it seems to rise above a stop and to return,
    pub(super) above: L::Mask,
    /// for the first time at this fraction of the step,
    pub(super) estimate: L,
    /// on the stop on this side.
    pub(super) side: L,
}

impl<L: Lane> Constants<L> {
    /// Examines the arc of a step whose hull as a whole is not clear, except at its beginning; `margin` is relative.
    #[inline(always)]
    pub(super) fn swing(&self, scale: &HullScale<L>, from: &End<L>, to: &End<L>, margin: L) -> Swing<L> {
        let Hull { size, error, coefficients: [c1, c2, c3, c4, c5] } = Hull::of(scale, from, to);
        let one = L::splat(1.0);
        let arc = [from.x, c1, c2, c3 + error, c4, c5, to.x];
        let upper = split(arc, self.room(0, margin, size), error, one);
        if !self.two_stops {
            return upper;
        }
        // the lower stop is an upper one of the mirrored motion
        let arc = [-from.x, -c1, -c2, -(c3 - error), -c4, -c5, -to.x];
        let lower = split(arc, self.room(1, margin, size), error, -one);
        Swing {
            clear: upper.clear.and(lower.clear),
            above: upper.above.or(lower.above),
            estimate: L::choose(upper.above, upper.estimate, lower.estimate),
            side: L::choose(upper.above, upper.side, lower.side),
        }
    }
}

/// Whether both parts of the polynomial with these Bernstein coefficients, divided at its maximum, lie below `room`,
/// except at its beginning; if not, whether it rises above `room` by more than a quarter of `error`, and where.
#[inline(always)]
fn split<L: Lane>(mut arc: [L; 7], room: L, error: L, side: L) -> Swing<L> {
    let end = arc[6];
    let whole = arc[1].max(arc[2]).max(arc[3]).max(arc[4].max(arc[5])).max(end).less(room);
    // no lane needs the parts
    if whole.bits() == (1 << L::WIDTH) - 1 {
        return Swing { clear: whole, above: room.less(room), estimate: room, side };
    }
    let (t, bend) = summit(&arc);
    // the coefficients of the left part are the first of each row, and those of the right part remain
    let mut highest = end;
    let mut row = arc.len() - 1;
    while row > 0 {
        let mut k = 0;
        while k < row {
            arc[k] = arc[k] + t * (arc[k + 1] - arc[k]);
            k += 1;
        }
        highest = highest.max(arc[0]).max(arc[row]);
        row -= 1;
    }
    let clear = highest.less(room);
    // the crossing before the maximum, from a parabola; only if the height is above the error
    let height = arc[0] - room;
    let estimate = t - (L::splat(2.0) * height / -bend).sqrt();
    let above = (L::splat(0.25) * error).less(height).and(L::splat(0.0).less(estimate)).and(end.less(room));
    Swing { clear: whole.or(clear), above, estimate, side }
}

/// The approximate place of the maximum, as a fraction, and the second derivative there.
#[inline(always)]
fn summit<L: Lane>(arc: &[L; 7]) -> (L, L) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let mut slope = [zero; 6];
    let mut k = 0;
    while k < slope.len() {
        slope[k] = arc[k + 1] - arc[k];
        k += 1;
    }
    // where the line between both ends of the slope is zero
    let mut t = (slope[0] / (slope[0] - slope[5])).max(zero).min(one);
    let mut bend = zero;
    let mut iteration = 0;
    while iteration < ITERATIONS {
        let mut rows = slope;
        let mut row = rows.len() - 1;
        while row > 1 {
            let mut k = 0;
            while k < row {
                rows[k] = rows[k] + t * (rows[k + 1] - rows[k]);
                k += 1;
            }
            row -= 1;
        }
        // the remaining two coefficients are the tangent at t
        let rise = rows[1] - rows[0];
        // Newton's method: a polynomial of degree 5 has 5 times this difference as its slope
        t = (t - (rows[0] + t * rise) / (L::splat(5.0) * rise)).max(zero).min(one);
        bend = L::splat(30.0) * rise;
        iteration += 1;
    }
    (t, bend)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Bernstein coefficients of c - (t - u)^2 in degree 6.
    fn parabola(c: f64, u: f64) -> [f64; 7] {
        core::array::from_fn(|k| {
            let k = k as f64;
            (c - u * u) + 2.0 * u * k / 6.0 - k * (k - 1.0) / 30.0
        })
    }

    #[test]
    fn a_summit_is_found_and_no_more_than_it() {
        for u in [0.1, 0.37, 0.5, 0.93] {
            let arc = parabola(0.0, u);
            let (t, bend) = summit(&arc);
            assert!((t - u).abs() < 1e-12 && (bend + 2.0).abs() < 1e-12);
            // the undivided hull lies well above the maximum
            assert!(arc.iter().any(|c| *c > 0.01));
            assert!(split(arc, 1e-12, 0.0, 1.0).clear);
            let swing = split(arc, -1e-4, 0.0, 1.0);
            assert!(!swing.clear && swing.above && (u - swing.estimate - 0.01).abs() < 1e-9);
        }
    }

    #[test]
    fn ends_count_but_for_the_beginning() {
        let open = |swing: Swing<f64>| !swing.clear && !swing.above;
        // decreases from 0
        assert!(split([0.0, -1.0, -2.0, -3.0, -4.0, -5.0, -6.0], -1e-9, 0.0, 1.0).clear);
        // increases to 0
        assert!(open(split([-6.0, -5.0, -4.0, -3.0, -2.0, -1.0, 0.0], -1e-9, 0.0, 1.0)));
        assert!(open(split([f64::NAN; 7], 1.0, 0.0, 1.0)));
    }
}
