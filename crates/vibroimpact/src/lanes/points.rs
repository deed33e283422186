//! Points of one flight, side by side.

use crate::flight::Flight;
use crate::math::Lane;

/// The shortest flight, in units of the time in which it changes: over shorter ones the closed form loses digits of the
/// displacement, and the few points by the series cost little.
const SHORTEST: f64 = 0.25;
/// The longest flight, for the sine and cosine in lanes.
const LONGEST: f64 = 1e5;

/// Whether the points of the first `duration` of a flight can be computed side by side.
pub(super) fn suited(flight: &Flight, duration: f64) -> bool {
    let response = flight.response();
    response.is_light() && (SHORTEST..LONGEST).contains(&(duration * response.beta().max(1.0)))
}

/// Positions, velocities, the force and its derivative.
pub(super) struct Points<L> {
    pub(super) x: L,
    pub(super) v: L,
    pub(super) force: L,
    pub(super) force_rate: L,
}

impl<L: Lane> Points<L> {
    /// At the time `middle` of a flight plus these offsets; see [`Response::nearby`](crate::system::Response).
    #[inline(always)]
    pub(super) fn new(flight: &Flight, middle: f64, offset: L) -> Self {
        let p = flight.response().nearby(middle, offset);
        let (x, v, beta) = (L::splat(flight.x), L::splat(flight.v), L::splat(flight.response().beta()));
        let (sin, cos) = (L::splat(flight.sin), L::splat(flight.cos));
        Self {
            x: x * p.c + v * p.s + (sin * p.kc + cos * p.ks),
            // K' = S + i beta K
            v: v * p.s_rate - x * p.s + (sin * (p.s - beta * p.ks) + cos * (beta * p.kc)),
            force: sin * p.cos_turn + cos * p.sin_turn,
            force_rate: beta * (cos * p.cos_turn - sin * p.sin_turn),
        }
    }
}
