//! Functions of the events of a cycle that are zero where a rest on a stop, or the hold of a joint, begins or ends to be a
//! part of it.
//!
//! | zero | where | name for joints |
//! |---|---|---|
//! | the limit at which a contact would slip, after the event at which its velocity becomes zero | [`Limit`] | crossing and switching |
//! | the velocity of a joint that slides, at its minimum | [`Touch`] | grazing |
//! | the limit of a contact that rests or holds, at its minimum | [`Touch`] | adding |
//!
//! The names are those of M. di Bernardo, P. Kowalczyk and A. Nordmark, "Bifurcations of dynamical systems with sliding:
//! derivation of normal-form mappings", Physica D 170 (2002) 175-205. A limit is what is missing to the largest force of a
//! joint that holds, or the reaction of a stop.

use super::closest::closest;
use crate::events::Place;
use crate::machine::StopLaw;
use crate::orbit::{MachineFrame, MachineRing};
use crate::regime::{ContactState, GuardKind};

/// A limit of a contact in the regime in which it rests or holds, at the state after an event.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Limit {
    /// The event.
    pub(crate) at: usize,
    /// The states of all stops and joints with the contact at rest.
    pub(crate) states: Vec<ContactState>,
    /// The guard of that regime.
    pub(crate) guard: GuardKind,
}

/// The smallest value of a guard on a flight.
#[derive(Clone, Debug)]
pub(crate) struct Touch {
    /// The event before the flight.
    pub(crate) leg: usize,
    /// The guard.
    pub(crate) guard: GuardKind,
    /// The phase there, beside those of the ring.
    pub(crate) phase: f64,
}

/// Of a limit its value, its rate while the contact is at rest, and the size of its terms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pressed {
    pub(crate) value: f64,
    pub(crate) rate: f64,
    pub(crate) size: f64,
}

impl Limit {
    /// Its value on a ring; `None` if there is no such regime, or if the contact has a velocity after the event.
    pub(crate) fn of(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<Pressed> {
        still(frame, ring, (self.at, self.guard.place(frame.machine.stops().len()))).then_some(())?;
        let mut place = Place { states: self.states.clone(), known: Vec::new(), ..ring.place(self.at) };
        frame.constrain(&mut place)?;
        pressed(frame, &place, self.guard)
    }
}

/// The value of a guard at a state.
fn pressed(frame: &MachineFrame<'_>, place: &Place, guard: GuardKind) -> Option<Pressed> {
    let structure = frame.structure(&place.states)?;
    let function = &structure.guards.iter().find(|of| of.kind == guard)?.function;
    let flight = place.unguarded_flight(&frame.normal, structure.clone());
    let (value, rate) = flight.first(function);
    Some(Pressed { value, rate, size: flight.size(function).max(f64::MIN_POSITIVE) })
}

/// The guards of a contact in a regime, without those of its gap or depth.
fn guards(frame: &MachineFrame<'_>, states: &[ContactState], contact: usize) -> Vec<GuardKind> {
    let stops = frame.machine.stops().len();
    let of_rest = |kind: &GuardKind| !matches!(kind, GuardKind::Gap(_) | GuardKind::Depth(_) | GuardKind::Force(_));
    let Some(structure) = frame.structure(states) else { return Vec::new() };
    structure
        .guards
        .iter()
        .map(|guard| guard.kind)
        .filter(|kind| of_rest(kind) && kind.place(stops) == contact)
        .collect()
}

/// Whether a contact has no velocity after an event, which is not its own release.
fn still(frame: &MachineFrame<'_>, ring: &MachineRing, (at, contact): (usize, usize)) -> bool {
    let (m, stops) = (ring.len(), frame.machine.stops());
    let event = &ring.events[at];
    if event.pushes(contact) {
        return matches!(stops[contact].law, StopLaw::Rigid { restitution } if restitution == 0.0);
    }
    let own = event.guard.place(stops.len()) == contact;
    let held = ring.events[(at + m - 1) % m].after[contact].constrains();
    let other = held && !own && event.pushed.is_empty();
    event.after[contact].constrains() || other || own && matches!(event.guard, GuardKind::Sliding(_))
}

/// All limits of a contact at events at which it has no velocity, relative to their terms.
pub(crate) fn limits(frame: &MachineFrame<'_>, ring: &MachineRing, contact: usize) -> Vec<(f64, Limit)> {
    let stops = frame.machine.stops().len();
    let mut found = Vec::new();
    for (at, event) in ring.events.iter().enumerate().filter(|(at, _)| still(frame, ring, (*at, contact))) {
        let mut states = event.after.clone();
        states[contact] = if contact < stops { ContactState::Resting } else { ContactState::Holding };
        for guard in guards(frame, &states, contact) {
            let limit = Limit { at, states: states.clone(), guard };
            if let Some(pressed) = limit.of(frame, ring) {
                found.push((pressed.value / pressed.size, limit));
            }
        }
    }
    found
}

/// The smallest values of all guards of a contact on all flights, relative to the largest velocity `speed` or to their
/// terms.
pub(crate) fn touches(frame: &MachineFrame<'_>, ring: &MachineRing, contact: usize, speed: f64) -> Vec<(f64, Touch)> {
    let mut found = Vec::new();
    for leg in 0..ring.len() {
        for guard in guards(frame, &ring.events[leg].after, contact) {
            let Some((value, place)) = closest(frame, ring, (leg, guard)) else { continue };
            let size = size(frame, &place, guard, speed);
            found.push((value / size, Touch { leg, guard, phase: place.phase }));
        }
    }
    found
}

/// What is zero where a rest begins or ends.
#[derive(Clone, Debug)]
pub(crate) enum RestZero {
    Limit(Limit),
    Touch(Touch),
}

impl RestZero {
    /// Whether a contact rests or holds in the signature of `ring` where this is zero.
    pub(crate) fn rests(&self, ring: &MachineRing, contact: usize) -> bool {
        let (Self::Limit(Limit { at: event, .. }) | Self::Touch(Touch { leg: event, .. })) = self;
        ring.events[*event].after[contact].constrains()
    }
}

/// A limit or a touch of a contact that is larger, relative to its size, is not zero.
const NEAR: f64 = 1e-3;

/// What is zero close to a solution where a rest of this contact begins or ends; `None` if it is not known. `speed` is the
/// largest velocity.
pub(crate) fn rest_zero(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (contact, speed): (usize, f64),
) -> Option<RestZero> {
    let limits = limits(frame, ring, contact).into_iter().map(|(value, limit)| (value, RestZero::Limit(limit)));
    let touches =
        touches(frame, ring, contact, speed).into_iter().map(|(value, touch)| (value, RestZero::Touch(touch)));
    let nearest = limits.chain(touches).min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    (nearest.0.abs() < NEAR).then_some(nearest.1)
}

/// The size of a guard: the largest velocity, or that of the terms of a force.
pub(crate) fn size(frame: &MachineFrame<'_>, place: &Place, guard: GuardKind, speed: f64) -> f64 {
    match guard {
        GuardKind::Sliding(joint) => frame.normal.length(frame.machine.stops().len() + joint) * speed,
        _ => pressed(frame, place, guard).map_or(1.0, |pressed| pressed.size),
    }
}
