//! What can happen to the mass at a stop, and how a motion can end.

use crate::flight::Horizon;
use crate::system::Side;

/// Something that happened at a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Time since the start of the motion.
    pub time: f64,
    /// Phase of the force, in $`[0, 2\pi)`$.
    pub phase: f64,
    /// Which stop.
    pub side: Side,
    /// What happened.
    pub kind: EventKind,
}

/// What happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EventKind {
    /// An impact: arrival with `velocity_before > 0` towards the stop, rebound with `velocity_after <= 0`.
    Impact {
        /// Speed of arrival $`u_-`$.
        velocity_before: f64,
        /// $`u_+ = -\varepsilon u_-`$.
        velocity_after: f64,
    },
    /// A tangential touch, without effect; `depth` is the computed distance left.
    Graze {
        /// Distance left at the closest point, within rounding of zero.
        depth: f64,
    },
    /// The mass comes to rest on the stop.
    Stick {
        /// Whether a complete chatter, infinitely many impacts, led here since the last impact listed.
        chatter: bool,
        /// Bound on the error of the time of this event.
        error: f64,
    },
    /// The force changes sign and the mass leaves.
    Release,
}

/// Why a motion has no further event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// It never touches a stop again, for ever, and why.
    Never(Horizon),
    /// It touches no stop for this long after its last event; what comes later was not decided.
    NoneFor(f64),
    /// It rests on this stop for ever.
    Stuck(Side),
}
