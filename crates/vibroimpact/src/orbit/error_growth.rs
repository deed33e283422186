//! Whether rounding errors decide the period of a motion that comes to rest.
//!
//! A rest forgets what was before, so a motion that returns to a release has the same state again, whatever happened on the way.
//! That it closes is no evidence of the way. There each event adds rounding errors, and the derivatives of flights and
//! events carry them on: with the covariance $`E`$ of the errors and the derivative $`A`$ of a step,
//! $`E_+ = AEA' + D`$, where $`D`$ is that of new errors. Where the errors become as large as the differences between motions that
//! end otherwise, numbers of these digits do not know how many periods pass until the next rest.
//!
//! The linear law does not see a contact that is nearly missed or nearly made, nor that a chatter forgets errors at its end. If the
//! errors grow noticeably, neighbours at the distance of a few roundings are followed from the release on: all must come
//! back.
//!
//! This rule is one for the oscillator (`release_errors`) and for machines (`machine::rounding`).

/// New errors of each step, relative to the sizes of coordinates and velocities.
pub(super) const NEW: f64 = 2.0 * f64::EPSILON;
/// Errors above this are noticeable: neighbours are followed.
const NOTICEABLE: f64 = 1e-9;
/// The distance of these neighbours.
const BESIDE: f64 = 8.0 * f64::EPSILON;
/// Their number.
pub(super) const NEIGHBOURS: usize = 4;

/// Whether rounding errors decide when the motion comes back, by the largest error on the way, relative to the motion, and by
/// whether its neighbours part from it; `None` if they cannot be followed.
pub(super) fn decide(largest: f64, neighbours_part: impl FnOnce() -> Option<bool>) -> bool {
    largest.is_nan() || largest > NOTICEABLE && neighbours_part().unwrap_or(true)
}

/// The distance of a neighbour in coordinate `i`, relative to the motion: each neighbour is on another side.
pub(super) fn beside(neighbour: usize, i: usize) -> f64 {
    if ((neighbour + 1) >> (i % 2)) & 1 == usize::from(i / 2 % 2 == 1) { -BESIDE } else { BESIDE }
}
