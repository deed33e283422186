//! Whether an event explains how the events of the cycle before it differ from those beyond, and what does otherwise.
//!
//! A test function or the first difference of two motions shows where the events change. Which event this is can show elsewhere in
//! the cycle: where a contact opens for no time, a joint on the same coordinate turns back in the same instant. So the whole
//! signatures of both sides are compared, each contact for itself.

use super::summed::same_in_turn;
use crate::continuation::event::BranchEvent;
use crate::orbit::{Chatter, MachineRing};
use crate::regime::{ContactState, GuardKind};

/// What a contact does in a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Tally {
    /// How often a stop closes, without the impacts of a complete chatter: how many of these are followed is no property of the
    /// cycle.
    closings: usize,
    /// How often a rest on a stop, or a hold of a joint, begins.
    rests: usize,
    /// How often a joint turns back.
    turns: usize,
}

impl Tally {
    /// Of each stop, then of each joint.
    fn all(ring: &MachineRing) -> Vec<Self> {
        let m = ring.len();
        let stops = ring.events.first().map_or(0, |event| event.back.len());
        let summed = summed(ring);
        let mut all = vec![Self::default(); ring.events.first().map_or(0, |event| event.after.len())];
        for (k, event) in ring.events.iter().enumerate() {
            let before = &ring.events[(k + m - 1) % m].after;
            // of stops at one place only one closes
            let closes = |stop: usize| event.pushes(stop) || event.after[stop] != before[stop];
            let with = event.with.iter().filter(|kind| closes(kind.place(stops)));
            if !event.touches(before) && !summed.contains(&k) && event.rests_on().is_none() {
                for kind in core::iter::once(&event.guard).chain(with) {
                    if let GuardKind::Gap(stop) = *kind {
                        all[stop].closings += 1;
                    }
                }
            }
            for (place, (now, then)) in event.after.iter().zip(before).enumerate() {
                let slides = |state: &ContactState| matches!(state, ContactState::Forward | ContactState::Backward);
                all[place].rests += usize::from(now.constrains() && !then.constrains());
                all[place].turns += usize::from(place >= stops && now != then && slides(now) && slides(then));
            }
        }
        all
    }
}

/// The events of all complete chatters before their rests: impacts, and what a joint does between them. How many of these are
/// followed is no property of the cycle.
fn summed(ring: &MachineRing) -> Vec<usize> {
    let m = ring.len();
    let stops = ring.events.first().map_or(0, |event| event.back.len());
    let of_chatter = |stop: usize, k: usize| {
        let event = &ring.events[k];
        event.struck() == Some(stop) || event.guard.place(stops) >= stops
    };
    let before = |Chatter { stop, rest }: Chatter| {
        (1..m).map(move |i| (rest + m - i) % m).take_while(move |k| of_chatter(stop, *k))
    };
    Chatter::all(ring).into_iter().flat_map(before).collect()
}

/// The two contacts whose events are the closest to each other in time among those where one is of a joint, or both of `joint`.
fn closest_pair(ring: &MachineRing, joint: Option<usize>) -> Option<(usize, usize)> {
    let m = ring.len();
    let stops = ring.events.first()?.back.len();
    let of = |k: usize| ring.events[k % m].guard.place(stops);
    let wanted = |k: &usize| {
        let (first, second) = (of(*k), of(k + 1));
        joint.map_or(first != second && first.max(second) >= stops, |joint| first == joint || second == joint)
    };
    let apart = |k: usize| ring.theta(k + 1) - ring.theta(k);
    let at = (0..m).filter(wanted).min_by(|a, b| apart(*a).total_cmp(&apart(*b)))?;
    Some((of(at), of(at + 1)))
}

/// The contacts whose rest or hold ends at the event of another one, each with that other one.
fn freed(ring: &MachineRing) -> Vec<(usize, usize)> {
    let m = ring.len();
    let stops = ring.events.first().map_or(0, |event| event.back.len());
    let at = |k: usize| {
        let (event, before) = (&ring.events[k], &ring.events[(k + m - 1) % m].after);
        let by = event.guard.place(stops);
        let states = before.iter().zip(&event.after).enumerate();
        states.filter_map(move |(place, (then, now))| {
            (then.constrains() && !now.constrains() && place != by).then_some((place, by))
        })
    };
    (0..m).flat_map(at).collect()
}

/// The guards of all events and the states after them, without touches and without those of complete chatters.
pub(super) fn told(ring: &MachineRing) -> Vec<(GuardKind, &[ContactState])> {
    let m = ring.len();
    let summed = summed(ring);
    let tells = |k: &usize| !summed.contains(k) && !ring.events[*k].touches(&ring.events[(k + m - 1) % m].after);
    (0..m).filter(tells).map(|k| (ring.events[k].guard, &ring.events[k].after[..])).collect()
}

/// The event, if it explains the difference of the cycle before it and that beyond; otherwise the one that does, and `None` if a
/// change is none. `turns` says whether the number turns back here.
pub(super) fn explained(
    event: BranchEvent,
    (before, beyond): (&MachineRing, &MachineRing),
    turns: bool,
) -> Option<BranchEvent> {
    // a rest after a chatter on both sides does not begin or end here
    let event = match event {
        BranchEvent::Sticking { stop, .. }
            if Chatter::count(before, stop) > 0 && Chatter::count(before, stop) == Chatter::count(beyond, stop) =>
        {
            BranchEvent::Change { place: Some(stop) }
        }
        event => event,
    };
    let changes = matches!(event, BranchEvent::Change { .. });
    if changes && !turns && same_in_turn(&told(before), &told(beyond)) {
        return None;
    }
    let (old, new) = (Tally::all(before), Tally::all(beyond));
    let stops = before.events.first().map_or(0, |event| event.back.len());
    let differ = |of: fn(&Tally) -> usize| (0..old.len()).find(|place| of(&old[*place]) != of(&new[*place]));
    let (rest, closing) = (differ(|tally| tally.rests), differ(|tally| tally.closings));
    let explains = match event {
        // without rebound a rest is interrupted where the stop ceases to press for an instant: it closes once more. A joint begins
        // to hold at once where it turned back for a moment before
        BranchEvent::Grazing { stop: place, .. }
        | BranchEvent::Sticking { stop: place, .. }
        | BranchEvent::Holding { joint: place, .. } => old[place] != new[place],
        BranchEvent::Change { .. } => false,
        _ => true,
    };
    // a contact is freed by the event of another one, or by its own force just before
    let one_sided = || {
        let (here, there) = (freed(before), freed(beyond));
        let only_here = here.iter().find(|pair| !there.contains(pair));
        only_here.or(there.iter().find(|pair| !here.contains(pair))).copied()
    };
    if !explains
        && old == new
        && let Some((first, second)) = one_sided()
    {
        return Some(BranchEvent::Corner { first, second });
    }
    // where nothing differs but the number of impacts of a chatter, what was found is all that is known
    if explains || old == new && !changes {
        return Some(match event {
            BranchEvent::Grazing { stop, appears, turns, detail, .. } => {
                let change = |place: usize| old[place].closings.cmp(&new[place].closings);
                let as_well =
                    |place: &usize| *place != stop && change(*place).is_ne() && change(*place) == change(stop);
                BranchEvent::Grazing { stop, also: (0..stops).find(as_well), appears, turns, detail }
            }
            event => event,
        });
    }
    let turned = differ(|tally| tally.turns);
    let more = |place: usize| if old[place].turns > new[place].turns { before } else { beyond };
    let corner = || {
        let pair = turned.map_or_else(|| closest_pair(before, None), |joint| closest_pair(more(joint), Some(joint)));
        pair.map_or(event, |(first, second)| {
            if first == second {
                BranchEvent::Holding { joint: first, begins: old[first].turns > new[first].turns }
            } else {
                BranchEvent::Corner { first, second }
            }
        })
    };
    Some(match (rest, closing) {
        (Some(place), _) => {
            let begins = old[place].rests < new[place].rests;
            if place < stops {
                BranchEvent::Sticking { stop: place, begins, detail: None }
            } else {
                BranchEvent::Holding { joint: place, begins }
            }
        }
        (None, Some(stop)) => {
            let appears = old[stop].closings < new[stop].closings;
            BranchEvent::Grazing { stop, also: None, appears, turns, detail: None }
        }
        _ => corner(),
    })
}
