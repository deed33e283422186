//! The events and the condition of a curve on which a rest on a stop, or the hold of a joint, begins or ends.
//!
//! The cycles on one side of such a curve have a flight that takes no time on it: the rest, or the flight between an event
//! and the rest. The signature of the curve is that without this flight. It is smooth on both sides, and both halves of a
//! symmetric cycle lose their flight at once.

use super::condition::Condition;
use crate::continuation::of_machine::{RestZero, closest, rest_zero, size};
use crate::orbit::{MachineFrame, MachineRing, RingEvent};
use core::f64::consts::TAU;

/// A flight of this contact that is shorter than this, in forcing periods, takes no time on the curve.
const SHORT: f64 = 1e-3;

/// Prepares the signature of a ring close to an event at which a rest of this contact begins or ends, and gives the
/// condition of its curve. `None` if it is not known what is zero there.
pub(super) fn condition(
    frame: &MachineFrame<'_>,
    ring: &mut MachineRing,
    (contact, speed): (usize, f64),
) -> Option<Condition> {
    let frequency = frame.machine.parts().frequency?;
    while join(frame, ring, (contact, frequency)) {}
    let m = ring.len();
    let own = |k: &usize| ring.events[*k].guard.place(frame.machine.stops().len()) == contact;
    let touches = |k: &usize| ring.events[*k].touches(&ring.events[(k + m - 1) % m].after);
    if let Some(at) = (0..m).find(|k| own(k) && touches(k)) {
        let size = frequency * size(frame, &ring.place(at), ring.events[at].guard, speed);
        return Some(Condition::Touch { at, size });
    }
    match rest_zero(frame, ring, (contact, speed))? {
        RestZero::Limit(limit) => {
            let size = limit.of(frame, ring)?.size;
            Some(Condition::Limit { limit, contact, size })
        }
        RestZero::Touch(touch) => {
            let (_, place) = closest(frame, ring, (touch.leg, touch.guard))?;
            let size = frequency * size(frame, &place, touch.guard, speed);
            let back = place.surfaces.iter().map(Option::is_some).collect();
            ring.events.insert(touch.leg + 1, RingEvent::touch(touch.guard, &place.states, back));
            ring.places.insert(touch.leg + 1, place);
            Some(Condition::Touch { at: touch.leg + 1, size })
        }
    }
}

/// Joins the first two events of this contact between which no time passes to one, with the states after the second;
/// whether there were such events.
fn join(frame: &MachineFrame<'_>, ring: &mut MachineRing, (contact, frequency): (usize, f64)) -> bool {
    let (m, stops) = (ring.len(), frame.machine.stops().len());
    let own = |k: usize| ring.events[k % m].guard.place(stops) == contact;
    let short = |k: &usize| own(*k) && own(k + 1) && ring.time(*k, frequency) < SHORT * TAU / frequency;
    let Some(at) = (0..m).find(short).filter(|_| m > 1) else { return false };
    let next = (at + 1) % m;
    let (event, place) = (ring.events[next].clone(), ring.places[next].clone());
    ring.events[at].after = event.after;
    ring.events[at].back = event.back;
    ring.places[at].states = place.states;
    ring.places[at].surfaces = place.surfaces;
    ring.events.remove(next);
    ring.places.remove(next);
    true
}
