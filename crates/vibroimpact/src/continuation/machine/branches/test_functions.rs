//! The test functions of a branch of a machine: they are continuous along the branch and change sign at an event.

use super::change::Difference;
use super::closest::Leg;
use super::rest::size;
use crate::machine::{Machine, StopLaw};
use crate::orbit::{MachineBlock, MachineFrame, MachineRing};
use crate::regime::GuardKind;

/// A test function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TestFunction {
    /// The component of the tangent along the number: zero where the number turns back.
    Pace,
    /// Zero where a multiplier is +1.
    PlusOne,
    /// Zero where a multiplier is -1.
    MinusOne,
    /// Zero where the product of two multipliers is 1.
    Torus,
    /// The rate at which the guard of an event falls; of a closing, its speed.
    Rate(usize),
    /// The smallest value of a guard on the flight after an event, where it turns; of a stop, its smallest gap.
    Clearance(usize, GuardKind),
}

impl TestFunction {
    /// The test functions for the cycles with the signature of `ring`: first those of the bifurcations.
    pub(crate) fn all(frame: &MachineFrame<'_>, ring: &MachineRing) -> Vec<Self> {
        let mut list = vec![Self::Pace, Self::PlusOne, Self::MinusOne, Self::Torus];
        for (k, event) in ring.events.iter().enumerate() {
            list.push(Self::Rate(k));
            let structure = frame.structure(&event.after);
            let guards = structure.iter().flat_map(|structure| structure.guards.iter().map(|guard| guard.kind));
            list.extend(guards.map(|guard| Self::Clearance(k, guard)));
        }
        list
    }

    /// Whether the cycle is admissible only while this function is positive.
    pub(crate) const fn needed(self) -> bool {
        matches!(self, Self::Rate(_) | Self::Clearance(..))
    }

    /// How the events differ beyond a zero of a function that has to be positive.
    pub(crate) fn difference(self, ring: &MachineRing) -> Option<Difference> {
        let stops = ring.events.first()?.back.len();
        let rest = |guard: GuardKind, begins: bool| {
            let place = guard.place(stops);
            Difference::Rest { place, joint: place >= stops, begins }
        };
        match self {
            Self::Rate(at) => {
                let event = &ring.events[at];
                Some(match event.guard {
                    GuardKind::Gap(stop) => Difference::Disappears { at, stop },
                    guard @ GuardKind::Sliding(_) => rest(guard, !event.after[guard.place(stops)].constrains()),
                    // the force comes to the limit and falls again: the joint holds on
                    guard @ (GuardKind::LimitForward(_) | GuardKind::LimitBackward(_)) => rest(guard, true),
                    guard => Difference::Other { place: Some(guard.place(stops)) },
                })
            }
            Self::Clearance(leg, guard) => {
                let at = (leg + 1) % ring.len();
                Some(match guard {
                    GuardKind::Gap(stop) | GuardKind::Depth(stop) | GuardKind::Force(stop) => {
                        Difference::Appears { at, stop }
                    }
                    guard => rest(guard, matches!(guard, GuardKind::Sliding(_))),
                })
            }
            _ => None,
        }
    }

    /// Whether it is that of a flight, and the stop or joint.
    pub(super) fn order(self, ring: &MachineRing) -> (bool, usize) {
        let place = |guard: GuardKind| guard.place(ring.events[0].back.len());
        match self {
            Self::Rate(at) => (false, place(ring.events[at].guard)),
            Self::Clearance(_, guard) => (true, place(guard)),
            _ => (true, usize::MAX),
        }
    }
}

/// The rate, in units of the largest velocity or acceleration along the contact, at which the guard of event `k` falls at the end of the
/// flight before it; `largest` is the largest velocity.
pub(crate) fn rate(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (k, flight): (usize, &MachineBlock),
    largest: f64,
) -> f64 {
    let guard = ring.events[k].guard;
    let length = frame.normal.length(guard.place(frame.machine.stops().len()));
    // a force along a contact accelerates the mass-normalised coordinates by it times the length of the direction
    let unit = if guard.of_force() { 1.0 / length } else { length };
    -flight.late[0] * ring.frequency(frame.machine) / (largest * unit)
}

/// The smallest value of a guard on a flight, relative to the largest coordinate, to the largest velocity, or to the terms of a
/// force; infinite if it does not turn there.
pub(crate) fn clearance(frame: &MachineFrame<'_>, leg: Option<&Leg<'_>>, guard: GuardKind, sizes: (f64, f64)) -> f64 {
    leg.and_then(|leg| leg.closest(guard)).map_or(f64::INFINITY, |(value, place)| match guard {
        GuardKind::Gap(stop) | GuardKind::Depth(stop) => value / frame.normal.along(stop, sizes).0,
        _ => value / size(frame, &place, guard, sizes.1),
    })
}

/// The sign of the product of all speeds by which the derivative over one period is divided: of closings at which the force
/// begins with a jump. Where one is zero, the derivative is infinite; its determinants with this sign do not change theirs.
pub(crate) fn pole_sign(machine: &Machine, ring: &MachineRing, flights: &[MachineBlock]) -> f64 {
    let jumps = |stop: usize| match machine.stops()[stop].law {
        StopLaw::Rigid { .. } => true,
        StopLaw::Compliant { preload, .. } => preload > 0.0,
    };
    let m = ring.len();
    flights.iter().enumerate().fold(1.0, |sign, (k, flight)| match ring.events[(k + 1) % m].guard {
        GuardKind::Gap(stop) if jumps(stop) && flight.late[0] > 0.0 => -sign,
        _ => sign,
    })
}
