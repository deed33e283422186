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

/// How often each contact closes; `None` of a stop with a complete chatter, of which not all impacts are followed.
pub(super) fn closings(ring: &MachineRing) -> Vec<Option<usize>> {
    let tallies = Tally::all(ring);
    let counted = |(place, tally): (usize, &Tally)| (Chatter::count(ring, place) == 0).then_some(tally.closings);
    tallies.iter().enumerate().map(counted).collect()
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

/// The contacts that are so and cease to be at the event of another one, each with that other one.
fn ended_by_others(ring: &MachineRing, are_so: fn(ContactState) -> bool) -> Vec<(usize, usize)> {
    let m = ring.len();
    let stops = ring.events.first().map_or(0, |event| event.back.len());
    let at = |k: usize| {
        let (event, before) = (&ring.events[k], &ring.events[(k + m - 1) % m].after);
        let by = event.guard.place(stops);
        let states = before.iter().zip(&event.after).enumerate();
        states.filter_map(move |(place, (then, now))| {
            (are_so(*then) && !are_so(*now) && place != by).then_some((place, by))
        })
    };
    (0..m).flat_map(at).collect()
}

/// The first pair of which one list has more than the other.
fn on_one_side(here: &[(usize, usize)], there: &[(usize, usize)]) -> Option<(usize, usize)> {
    let count = |all: &[(usize, usize)], pair: &(usize, usize)| all.iter().filter(|own| *own == pair).count();
    here.iter().chain(there).find(|pair| count(here, pair) != count(there, pair)).copied()
}

/// What tells an event: its guard and the states after it.
type Told<'a> = (GuardKind, &'a [ContactState]);

/// The events from each rest that ends a chatter to the next one, without touches; of a cycle without such rests all.
fn stretches(ring: &MachineRing) -> Vec<Vec<Told<'_>>> {
    let m = ring.len();
    let rests: Vec<usize> = Chatter::all(ring).into_iter().map(|chatter| chatter.rest).collect();
    let tells = |k: &usize| !ring.events[*k].touches(&ring.events[(k + m - 1) % m].after);
    let told = |k: usize| (ring.events[k].guard, &ring.events[k].after[..]);
    let stretch = |rest: &usize| {
        let end = (1..m).map(|i| (rest + i) % m).take_while(|k| !rests.contains(k));
        core::iter::once(*rest).chain(end).filter(tells).map(told).collect()
    };
    if rests.is_empty() { vec![(0..m).filter(tells).map(told).collect()] } else { rests.iter().map(stretch).collect() }
}

/// Whether two cycles have the same events in turn, but for the last ones of chatters: impacts, and what a joint does between them. How
/// many of these are followed before the sum is no property of the cycle.
pub(super) fn same_events(a: &MachineRing, b: &MachineRing) -> bool {
    let (one, other) = (stretches(a), stretches(b));
    let count = one.len();
    if Chatter::all(a).is_empty() || count != other.len() {
        return Chatter::all(b).is_empty() && same_in_turn(&one[0], &other[0]);
    }
    let alike = |(one, other): (&Vec<Told<'_>>, &Vec<Told<'_>>)| one.starts_with(other) || other.starts_with(one);
    (0..count).any(|shift| (0..count).all(|k| alike((&one[k], &other[(k + shift) % count]))))
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
    if changes && !turns && same_events(before, beyond) {
        return None;
    }
    let (old, new) = (Tally::all(before), Tally::all(beyond));
    let stops = before.events.first().map_or(0, |event| event.back.len());
    let differ = |of: fn(&Tally) -> usize| (0..old.len()).find(|place| of(&old[*place]) != of(&new[*place]));
    let (rest, closing) = (differ(|tally| tally.rests), differ(|tally| tally.closings));
    let explains = match event {
        // without rebound a rest is interrupted where the stop ceases to press for an instant: it closes once more. A joint begins
        // to hold at once where it turned back for a moment before
        BranchEvent::Grazing { stop, .. } => old[stop] != new[stop],
        // not an impact that appears between cycles without a rest
        BranchEvent::Sticking { stop, .. } => old[stop] != new[stop] && old[stop].rests + new[stop].rests > 0,
        // an impact that appears turns the joint of its coordinate back too
        BranchEvent::Holding { joint, .. } => {
            old[joint].rests != new[joint].rests || old[joint] != new[joint] && closing.is_none() && rest.is_none()
        }
        BranchEvent::Change { .. } => false,
        _ => true,
    };
    let one_sided = |are_so: fn(ContactState) -> bool| {
        on_one_side(&ended_by_others(before, are_so), &ended_by_others(beyond, are_so))
    };
    let grazes = |at: usize| matches!(event, BranchEvent::Grazing { stop, .. } if stop == at);
    // a contact is freed by the event of another one, or by its own force just before
    let freed = || if old == new { one_sided(ContactState::constrains) } else { None };
    // an impact elsewhere ends a contact that has just begun, or whose own force has just ended it
    let ended = || {
        one_sided(|state| state == ContactState::Closed).filter(|(stop, _)| old[*stop] == new[*stop] || grazes(*stop))
    };
    let pair = if explains { None } else { freed() };
    if let Some((first, second)) = pair.or_else(ended) {
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
