//! What a flight meets first.

use super::Horizon;
use crate::system::Side;

/// How a flight first meets a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// It strikes a stop.
    Impact {
        /// Time since the beginning of the flight.
        time: f64,
        /// Which stop.
        side: Side,
        /// Speed of arrival, towards the stop.
        velocity: f64,
    },
    /// It touches a stop tangentially, to within what rounding can tell.
    Grazing {
        /// Time since the beginning of the flight.
        time: f64,
        /// Which stop.
        side: Side,
        /// What is computed of the distance left at the closest point: positive short of the stop, negative beyond.
        depth: f64,
    },
    /// It never meets a stop, for ever, and why.
    Never(Horizon),
    /// No contact up to this time since the beginning; beyond it nothing was decided.
    NoneUntil(f64),
    /// It begins on this stop and does not leave it: it arrives there, or rests there under a force into the stop.
    Contact {
        /// Which stop.
        side: Side,
    },
}
