//! A signature without the flights that take no time where a rest on a stop, or the hold of a joint, begins or ends.
//!
//! The cycles on one side of such a value have one more flight: the rest, or a flight between an event and the rest. Where it
//! takes no time, both events at its ends are one. The equations without it are smooth on both sides, and both halves of a
//! symmetric cycle lose their flight at once.

use crate::machine::StopLaw;
use crate::orbit::{MachineFrame, MachineRing};
use core::f64::consts::TAU;

/// A flight whose phases differ by less takes no time.
pub(super) const SHORT: f64 = 1e-3 * TAU;

/// Joins all events of this contact between which no time passes, with the states after the second of them, and leaves out
/// those at which then nothing changes; whether there were such events. The impacts of a chatter are not joined.
pub(crate) fn join(frame: &MachineFrame<'_>, ring: &mut MachineRing, contact: usize) -> bool {
    let stops = frame.machine.stops().len();
    let law = frame.machine.stops().get(contact).map(|stop| stop.law);
    if matches!(law, Some(StopLaw::Rigid { restitution }) if restitution > 0.0) {
        return false;
    }
    let mut joined = false;
    while ring.len() > 1 {
        let m = ring.len();
        let own = |k: usize| ring.events[k % m].guard.place(stops) == contact;
        let short = |k: &usize| own(*k) && own(k + 1) && ring.theta(k + 1) - ring.theta(*k) < SHORT;
        let Some(at) = (0..m).find(short) else { break };
        let next = (at + 1) % m;
        let (event, place) = (ring.events[next].clone(), ring.places[next].clone());
        ring.events[at].after = event.after;
        ring.events[at].back = event.back;
        ring.places[at].states = place.states;
        ring.places[at].surfaces = place.surfaces;
        let unchanged = ring.events[at].touches(&ring.events[(at + m - 1) % m].after);
        ring.remove(next);
        if unchanged && ring.len() > 1 {
            ring.remove(if next < at { at - 1 } else { at });
        }
        joined = true;
    }
    joined
}
