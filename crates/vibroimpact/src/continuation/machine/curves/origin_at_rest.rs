//! The events and the condition of a curve on which a rest on a stop, or the hold of a joint, begins or ends.
//!
//! The cycles on one side of such a curve have a flight that takes no time on it: the rest, or the flight between an event
//! and the rest. The signature of the curve is that without this flight. It is smooth on both sides, and both halves of a
//! symmetric cycle lose their flight at once.

use super::condition::Condition;
use crate::continuation::machine::branches::{RestZero, closest, join, rest_zero, size};
use crate::orbit::{MachineFrame, MachineRing, RingEvent};

/// Prepares the signature of a ring close to an event at which a rest of this contact begins or ends, and gives the
/// condition of its curve. `None` if it is not known what is zero there.
pub(super) fn condition(
    frame: &MachineFrame<'_>,
    ring: &mut MachineRing,
    (contact, speed): (usize, f64),
) -> Option<Condition> {
    join(frame, ring, contact);
    match rest_zero(frame, ring, (contact, speed))? {
        RestZero::Limit(limit) => {
            let size = limit.of(frame, ring)?.size;
            Some(Condition::Limit { limit, contact, size })
        }
        RestZero::Touch(touch) => {
            let (_, place) = closest(frame, ring, (touch.leg, touch.guard))?;
            let size = ring.frequency(frame.machine) * size(frame, &place, touch.guard, speed);
            let back = place.surfaces.iter().map(Option::is_some).collect();
            ring.insert(touch.leg + 1, RingEvent::touch(touch.guard, &place.states, back), place);
            Some(Condition::Touch { at: touch.leg + 1, size, contact: Some(contact), speed })
        }
    }
}
