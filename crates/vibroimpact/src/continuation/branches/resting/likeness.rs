//! Compares the motions from a release at two values of the parameter.
//!
//! The impacts are compared one by one by the times and speeds between them, down to the last impacts of a chatter.
//! Their relative changes are smooth in the parameter, so an impact that appears or disappears is detected at once.

use crate::math::ln;
use crate::orbit::{Excursion, Stretch};
use crate::system::Side;

/// The result of comparing the motions from a release at two values of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Likeness {
    /// The same impacts and intervals of sticking; the largest change as a fraction of the permitted change.
    Alike(f64),
    /// The same intervals of sticking in the same number of periods, but in these stretches the impacts from these
    /// indices on differ.
    From(Vec<(usize, usize)>),
    /// Different intervals of sticking.
    Rests,
}

/// The permitted relative change of times and speeds; that of the times of sticking is larger.
const CHANGE: f64 = 0.2;
const CHANGE_AT_REST: f64 = 0.6;

/// The number of periods, and the stops on which each stretch begins and ends.
pub(crate) fn shape(excursion: &Excursion) -> (Option<u32>, Vec<(Side, Option<Side>)>) {
    let ends = |stretch: &Stretch| (stretch.from, stretch.rest.map(|rest| rest.span.side));
    (excursion.periods, excursion.stretches.iter().map(ends).collect())
}

/// Compares two motions from a release; the first one returns to the release.
pub(crate) fn likeness(a: &Excursion, b: &Excursion) -> Likeness {
    if shape(a) != shape(b) {
        return Likeness::Rests;
    }
    let mut most = 0.0_f64;
    let mut unlike = Vec::new();
    for (k, (a, b)) in a.stretches.iter().zip(&b.stretches).enumerate() {
        match stretch(a, b) {
            Ok(change) => most = most.max(change),
            Err(at) => unlike.push((k, at)),
        }
    }
    if unlike.is_empty() { Likeness::Alike(most) } else { Likeness::From(unlike) }
}

/// The largest change as a fraction of the permitted change, or the index of the first impact that differs.
pub(crate) fn stretch(a: &Stretch, b: &Stretch) -> Result<f64, usize> {
    let change = |x: f64, y: f64| if x == y { 0.0 } else { ln(x / y).abs() };
    let common = a.strikes.len().min(b.strikes.len());
    let mut most = 0.0_f64;
    for (k, (x, y)) in a.strikes.iter().zip(&b.strikes).enumerate() {
        let moved = change(x.flown, y.flown).max(change(x.state.velocity, y.state.velocity)) / CHANGE;
        if x.state.side != y.state.side || moved.is_nan() || moved > 1.0 {
            return Err(k);
        }
        most = most.max(moved);
    }
    // the number of impacts of a chatter that are listed before its sum does not matter
    let summed = |stretch: &Stretch| stretch.rest.is_some_and(|rest| rest.span.chatter);
    if a.strikes.len() != b.strikes.len() && !(summed(a) && summed(b)) {
        return Err(common);
    }
    if let (Some(x), Some(y)) = (&a.rest, &b.rest) {
        let moved = change(x.held, y.held) / CHANGE_AT_REST;
        if moved.is_nan() || moved > 1.0 {
            return Err(common);
        }
        most = most.max(moved);
    }
    Ok(most)
}
