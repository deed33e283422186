//! The first contact of a flight.

use super::Horizon;
use crate::system::Side;

/// The first contact of a flight with a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// An impact on a stop.
    Impact {
        /// Time since the beginning of the flight.
        time: f64,
        /// The stop.
        side: Side,
        /// Speed of arrival, towards the stop.
        velocity: f64,
    },
    /// A grazing contact: tangential to within rounding errors.
    Grazing {
        /// Time since the beginning of the flight.
        time: f64,
        /// The stop.
        side: Side,
        /// The computed distance from the stop at the closest point: positive before the stop, negative beyond it.
        depth: f64,
    },
    /// The flight never reaches a stop, for the reason given.
    Never(Horizon),
    /// No contact up to this time since the beginning; nothing is known beyond.
    NoneUntil(f64),
    /// The flight begins on this stop and does not leave it: it arrives there, or is at rest there under a force into
    /// the stop.
    Contact {
        /// The stop.
        side: Side,
    },
}
