//! A stretch of a motion in one regime, kept for those who look at it between its events.

use super::place::Place;
use crate::arc::MachineFlight;
use crate::math::Wide;

/// A flight and how long it lasted.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    /// The time of its beginning.
    pub(super) begin: Wide,
    /// Its duration, positive.
    pub(super) duration: f64,
    /// The state at its beginning.
    pub(super) place: Place,
    pub(super) flight: MachineFlight,
}

/// Adds a stretch. Those that begin at the same time are a part of it, up to a touch without effect.
pub(super) fn follow(trail: &mut Vec<Stretch>, stretch: Stretch) {
    while trail.last().is_some_and(|last| last.begin == stretch.begin) {
        trail.pop();
    }
    trail.push(stretch);
}
