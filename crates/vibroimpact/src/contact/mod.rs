//! Contact: impacts, chatter, sticking and landing at a stop.
//!
//! An impact reverses the velocity, $`u_+ = -\varepsilon u_-`$ (eq. 9 of the 1971 paper). Under a force into the stop
//! the rebounds decrease geometrically and accumulate in finite time. This chatter is completed by a formula with a
//! known error ([`chatter`]). Then the mass sticks until the force changes sign ([`sticking`]). At a few exact values
//! of the parameters the mass returns to the stop without speed and without an impact ([`landing`]).

pub mod chatter;
mod impact;
pub mod landing;
pub mod sticking;

pub use impact::ImpactState;

use crate::system::Side;
use core::f64::consts::PI;

/// The phase of the force relative to the given stop. The lower stop is the upper stop of the mirrored system, in which
/// the force is ahead by half a period.
#[inline]
pub(crate) fn mirrored(side: Side, phase: f64) -> f64 {
    match side {
        Side::Upper => phase,
        Side::Lower => phase + PI,
    }
}
