//! The first contact by exhaustion: cells from left to right, each proven clear, proven to hold one contact, or cut.
//!
//! No contact can be missed: a cell is left behind only when [`judge`] proved it clear, or when it is an arch whose
//! closest point, located to sixty digits, is short of the stop. The same search runs on two kinds of flight: the one
//! with 256 binary places ([`super::exact`]) and the fast one of the long run ([`super::march`]).

use super::cell::{Bounds, Verdict, View, judge};
use vibroimpact::Side;

/// A flight that can be looked at where it is asked to.
pub(crate) trait Curve {
    type Node: Copy;
    /// The stop on `side` seen from `node`.
    fn view(&self, node: &Self::Node, side: Side) -> View;
    /// $\max(|x|, |v|)$.
    fn size(&self, node: &Self::Node) -> f64;
    /// $\beta$ and $\zeta$.
    fn rates(&self) -> (f64, f64);
    /// The node a time `h` after `a`; `None` when `h` is finer than this curve resolves.
    fn after(&self, a: &Self::Node, h: f64) -> Option<Self::Node>;
    /// The closest point of an arch and how far past the stop it is, when this curve can tell for certain.
    fn apex(&self, side: Side, a: &Self::Node, b: &Self::Node) -> Option<(Self::Node, f64)>;
}

/// A cell and what is known of its left end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell<N> {
    pub(crate) a: N,
    pub(crate) b: N,
    pub(crate) h: f64,
    /// The flight begins at `a`, on the stop in question.
    pub(crate) on_stop: bool,
}

/// What a cell holds.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Found<N> {
    /// One contact between these, the first of the cell; the mass approaches throughout.
    Rise { a: N, b: N, h: f64 },
    /// A closest point that stays short of the stop by less than was asked to be told.
    Touch { at: N, past: f64 },
    /// The curve does not resolve what happens here.
    Unresolved,
}

/// Closest points nearer to the stop than this are told.
pub(crate) const NEAR: f64 = 1e-7;

/// Looks for contacts with the stop on `side` in a cell; true: the search ends here.
pub(crate) fn examine<C: Curve>(curve: &C, side: Side, cell: Cell<C::Node>, found: &mut Vec<Found<C::Node>>) -> bool {
    let Cell { a, b, h, on_stop } = cell;
    let (beta, zeta) = curve.rates();
    let bounds = Bounds::new(beta, zeta, curve.size(&a), h);
    match judge(&curve.view(&a, side), &curve.view(&b, side), h, bounds, on_stop) {
        Verdict::Clear => return false,
        Verdict::Rises => {
            found.push(Found::Rise { a, b, h });
            return true;
        }
        Verdict::Arch => {
            if let Some((at, past)) = curve.apex(side, &a, &b) {
                if past > 0.0 {
                    found.push(Found::Rise { a, b: at, h });
                    return true;
                }
                if past > -NEAR {
                    found.push(Found::Touch { at, past });
                }
                return false;
            }
        }
        Verdict::Cut => {}
    }
    let half = 0.5 * h;
    let Some(middle) = curve.after(&a, half) else {
        found.push(Found::Unresolved);
        return true;
    };
    examine(curve, side, Cell { a, b: middle, h: half, on_stop }, found)
        || examine(curve, side, Cell { a: middle, b, h: half, on_stop: false }, found)
}
