//! The events of a motion, and how a motion can end.

use crate::contact::ImpactState;
use crate::flight::Horizon;
use crate::system::Side;

/// An event at a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Time since the start of the motion.
    pub time: f64,
    /// Phase of the force, in $`[0, 2\pi)`$.
    pub phase: f64,
    /// The stop.
    pub side: Side,
    /// The kind of the event.
    pub kind: EventKind,
}

impl Event {
    /// The state at the arrival of an impact; `None` of another event.
    #[inline]
    #[must_use]
    pub const fn arrival(&self) -> Option<ImpactState> {
        let EventKind::Impact { velocity_before: velocity, .. } = self.kind else { return None };
        Some(ImpactState { phase: self.phase, velocity, side: self.side })
    }
}

/// The kind of an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EventKind {
    /// An impact: arrival with `velocity_before > 0` towards the stop, rebound with `velocity_after <= 0`.
    Impact {
        /// Speed of arrival $`u_-`$.
        velocity_before: f64,
        /// $`u_+ = -\varepsilon u_-`$.
        velocity_after: f64,
    },
    /// A grazing contact, which has no effect on the motion.
    Graze {
        /// The computed distance from the stop at the closest point, zero to within rounding.
        depth: f64,
    },
    /// The mass begins to stick.
    Stick {
        /// Whether a complete chatter, with infinitely many impacts, precedes it since the last impact listed.
        chatter: bool,
        /// Bound on the error of the time of this event.
        error: f64,
    },
    /// The force changes sign and the mass leaves the stop.
    Release,
}

/// Why a motion has no further event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// The mass never reaches a stop again, for the reason given.
    Never(Horizon),
    /// The mass reaches no stop for this time after the last event; nothing is known beyond.
    NoneFor(f64),
    /// The mass sticks on this stop for ever.
    Stuck(Side),
}
