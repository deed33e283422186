//! A moment of a cycle at which rounding decides which events the motion has.

use crate::machine::Machine;
use crate::orbit::MachineRing;

/// A moment: events that happen at once, or a touch on a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Moment {
    /// The events from the first one to the last one.
    Events(usize, usize),
    /// A flight, by the event before it, and the phase on it.
    Flight(usize, f64),
}

/// A place on a flight: the event before the flight, and the time since.
pub(super) type OnFlight = (usize, f64);

impl Moment {
    /// Whether one of `m` events belongs to it.
    pub(super) fn has(&self, event: usize, m: usize) -> bool {
        matches!(*self, Self::Events(first, last) if (event + m - first) % m <= (last + m - first) % m)
    }

    /// Its phase, beside those of the ring.
    pub(super) fn phase(&self, ring: &MachineRing) -> f64 {
        match *self {
            Self::Events(first, _) => ring.theta(first),
            Self::Flight(_, phase) => phase,
        }
    }

    /// The end of the motion before it.
    pub(super) fn before(&self, ring: &MachineRing, machine: &Machine) -> OnFlight {
        match *self {
            Self::Events(first, _) => {
                let leg = (first + ring.len() - 1) % ring.len();
                (leg, ring.time(leg, machine))
            }
            Self::Flight(leg, phase) => (leg, (phase - ring.theta(leg)) / ring.frequency(machine)),
        }
    }

    /// The beginning of the motion after it.
    pub(super) fn after(&self, ring: &MachineRing, machine: &Machine) -> OnFlight {
        match *self {
            Self::Events(_, last) => (last, 0.0),
            Self::Flight(..) => self.before(ring, machine),
        }
    }
}
