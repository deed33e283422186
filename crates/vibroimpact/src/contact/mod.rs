//! Contact: what happens at a stop.
//!
//! An impact sends the mass back with $`u_+ = -\varepsilon u_-`$ (eq. 9 of the 1971 paper). Under a force into the stop
//! the rebounds shrink geometrically and accumulate in finite time - chattering, completed here by a formula with a
//! known error ([`chatter`]) - after which the mass sticks until the force changes sign ([`sticking`]). At a few exact values
//! of the parameters the mass comes back to the stop without speed and without an impact ([`landing`]).

pub mod chatter;
mod impact;
pub mod landing;
pub mod sticking;

pub use impact::ImpactState;

use crate::system::Side;
use core::f64::consts::PI;

/// The phase as the given stop sees it: the lower stop is an upper one for the mirrored system, in which the force is
/// half a turn ahead.
#[inline]
pub(crate) fn mirrored(side: Side, phase: f64) -> f64 {
    match side {
        Side::Upper => phase,
        Side::Lower => phase + PI,
    }
}
