//! The parts of a motion: flights, impacts, summed chatters and intervals of sticking.

use crate::flight::Flight;
use crate::motion::{Event, EventKind, Leg, Motion, Path};
use crate::system::Side;

/// A part of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// A flight over this time.
    Flight {
        /// The flight.
        flight: Flight,
        /// Its length.
        duration: f64,
    },
    /// An impact with the speed `speed`.
    Impact {
        /// The stop.
        side: Side,
        /// Speed of arrival.
        speed: f64,
    },
    /// The rest of a complete chatter, with infinitely many impacts.
    Chatter {
        /// The stop.
        side: Side,
        /// Phase of the force at its beginning, just after an impact.
        phase: f64,
        /// Speed of the rebound at its beginning.
        rebound: f64,
        /// Time to the accumulation point.
        duration: f64,
    },
    /// The mass sticks on a stop.
    Rest {
        /// The stop.
        side: Side,
        /// Phase of the force at its beginning.
        phase: f64,
        /// Its length.
        duration: f64,
    },
}

impl Segment {
    /// Its length; 0 for an impact.
    #[must_use]
    pub const fn duration(&self) -> f64 {
        match self {
            Self::Flight { duration, .. } | Self::Chatter { duration, .. } | Self::Rest { duration, .. } => *duration,
            Self::Impact { .. } => 0.0,
        }
    }
}

/// Follows a motion and calls `part` with each part in order. It stops at the end of the motion, or after an event for
/// which `go_on` returns false.
pub(super) fn follow(motion: &mut Motion<'_>, mut part: impl FnMut(Segment), mut go_on: impl FnMut(&Event) -> bool) {
    let mut rebound = 0.0;
    while let Some(event) = motion.next() {
        let Some(leg) = motion.leg() else { return };
        part(of_leg(leg, &event, rebound));
        if let EventKind::Impact { velocity_before, velocity_after } = event.kind {
            part(Segment::Impact { side: event.side, speed: velocity_before });
            rebound = -velocity_after;
        }
        if !go_on(&event) {
            return;
        }
    }
}

/// The part between two events; `rebound` is the speed after the last impact.
fn of_leg(leg: &Leg, event: &Event, rebound: f64) -> Segment {
    let (phase, duration) = (leg.phase, leg.duration);
    match leg.path {
        Path::Flight(flight) => Segment::Flight { flight, duration },
        Path::Rest(side) if matches!(event.kind, EventKind::Stick { chatter: true, .. }) => {
            Segment::Chatter { side, phase, rebound, duration }
        }
        Path::Rest(side) => Segment::Rest { side, phase, duration },
    }
}
