//! How far the rounding of its data moves a flight: the condition of a root and of a maximum.
//!
//! $$\Sigma = \sum_d \left|d\,\frac{\partial g}{\partial d}\right|, \qquad d \in \{\beta, \zeta, x_0, v_0, \varphi, \delta, s\}$$
//!
//! One rounding of every datum moves $g$ by up to $2^{-53}\Sigma$ and its root by that over $|\dot g|$. A flight that begins
//! on the stop has $x_0 = \delta$, one datum. The derivatives are difference quotients over $2^{-48}$, with 256
//! places to lose.

use super::case::Case;
use super::elementary::sin_cos;
use super::exact::Exact;
use super::fixed::Fixed;
use super::textbook::{Data, Solution};
use vibroimpact::Side;

/// Relative step of the difference quotients.
const STEP: u32 = 48;

/// $\Sigma$ at time `s` for the stop on `side`, all data but `s` itself.
pub(crate) fn spread(case: &Case, exact: &Exact, side: Side, s: Fixed) -> f64 {
    let base = *exact.solution.data();
    let here = exact.solution.at(s);
    let nudged = |d: Fixed| d + d.halved(STEP);
    let (sine, cosine) = base.force;
    let (turned_sine, turned_cosine) = sin_cos(Fixed::from_f64(case.phase).halved(STEP));
    let turned = (sine * turned_cosine + cosine * turned_sine, cosine * turned_cosine - sine * turned_sine);
    let moved = |data: Data, displacement: bool| {
        let there = Solution::new(data).at(s);
        let shift = if displacement { there.d - here.d } else { (there.d - here.d) + (data.x - base.x) };
        shift.to_f64().abs() * 2_f64.powi(48)
    };
    let on_this_stop = case.begins_on() == Some(side);
    let gap = match side {
        Side::Upper => case.gap,
        Side::Lower => case.second.expect("asked of a stop that is there"),
    };
    let mut sum = if on_this_stop { 0.0 } else { gap.abs() };
    if case.x != 0.0 {
        sum += moved(Data { x: nudged(base.x), ..base }, on_this_stop);
    }
    if case.v != 0.0 {
        sum += moved(Data { v: nudged(base.v), ..base }, true);
    }
    if case.zeta != 0.0 {
        sum += moved(Data { zeta: nudged(base.zeta), ..base }, true);
    }
    sum += moved(Data { beta: nudged(base.beta), ..base }, true);
    if case.phase != 0.0 {
        sum += moved(Data { force: turned, ..base }, true);
    }
    sum
}
