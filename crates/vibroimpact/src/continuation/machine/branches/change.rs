//! How the events of a motion differ from those of a signature.

use super::problem::Judged;
use crate::continuation::event::BranchEvent;
use crate::orbit::{MachineRing, Push, RingEvent};
use crate::regime::{ContactState, GuardKind};

/// The first difference between the events of a signature and those of a motion beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Difference {
    /// Before event `at` of the signature a stop closes.
    Appears { at: usize, stop: usize },
    /// Event `at` of the signature, the closing of a stop, does not happen.
    Disappears { at: usize, stop: usize },
    /// Two events change their order, or happen together; of one stop, if its force and its depth are zero at once, or if its
    /// surface comes back just when it closes.
    Corner { first: usize, second: usize },
    /// A stop rests or a joint holds after an event where it did not, or the other way round.
    Rest { place: usize, joint: bool, begins: bool },
    /// Something else.
    Other { place: Option<usize> },
}

impl Difference {
    /// The event of a branch.
    pub(super) const fn event(&self, turns: bool) -> BranchEvent {
        match *self {
            Self::Appears { stop, .. } => BranchEvent::Grazing { stop, also: None, appears: true, turns, detail: None },
            Self::Disappears { stop, .. } => {
                BranchEvent::Grazing { stop, also: None, appears: false, turns, detail: None }
            }
            Self::Corner { first, second } => BranchEvent::Corner { first, second },
            Self::Rest { place, joint: false, begins } => BranchEvent::Sticking { stop: place, begins, detail: None },
            Self::Rest { place, begins, .. } => BranchEvent::Holding { joint: place, begins },
            Self::Other { place } => BranchEvent::Change { place },
        }
    }
}

/// The change of a rest of the contact whose guard this is; `holds` says whether the contact rests or holds after it in the
/// motion beyond. `None` for the guards of stops that are struck, open or are pushed.
fn rest(guard: GuardKind, stops: usize, holds: bool) -> Option<Difference> {
    let place = guard.place(stops);
    match guard {
        GuardKind::Gap(_) | GuardKind::Depth(_) | GuardKind::Force(_) => None,
        _ => Some(Difference::Rest { place, joint: place >= stops, begins: holds }),
    }
}

/// The additional closing of a stop in the motion, if it has all events of the signature and this one.
pub(super) fn additional(ring: &MachineRing, judged: &Judged) -> Option<Difference> {
    let m = ring.len();
    let wanted = |i: usize| (judged.from + 1 + i) % m;
    let i = (0..m).find(|i| judged.seen.get(*i) != Some(&ring.events[wanted(*i)]))?;
    let others = judged.seen.get(i + 1..)?;
    let alike = others.len() == m - i && (i..m).all(|k| others[k - i] == ring.events[wanted(k)]);
    match judged.seen[i].guard {
        GuardKind::Gap(stop) if alike => Some(Difference::Appears { at: wanted(i), stop }),
        _ => None,
    }
}

/// The first of two events in a row that the first list has and the second has not; only such a `pair` is looked for.
fn pair_of(events: &[&RingEvent], others: &[&RingEvent], pair: impl Fn(GuardKind, GuardKind) -> bool) -> Option<usize> {
    let more = events.len().checked_sub(2).filter(|fewer| *fewer == others.len())?;
    let guards = |events: &[&RingEvent]| events.iter().map(|event| event.guard).collect::<Vec<_>>();
    let (events, others) = (guards(events), guards(others));
    (0..=more)
        .find(|k| pair(events[*k], events[k + 1]) && events[..*k] == others[..*k] && events[k + 2..] == others[*k..])
}

/// Whether these are the guards of the closing of a compliant stop and of its opening.
fn is_contact(first: GuardKind, second: GuardKind) -> bool {
    matches!((first, second), (GuardKind::Gap(stop), GuardKind::Depth(same) | GuardKind::Force(same)) if stop == same)
}

/// Whether these are the guards of the beginning and of the end of a hold.
fn is_hold(first: GuardKind, second: GuardKind) -> bool {
    let ends = |joint: usize| [GuardKind::LimitForward(joint), GuardKind::LimitBackward(joint)].contains(&second);
    matches!(first, GuardKind::Sliding(joint) if ends(joint))
}

/// The events of a motion, and those of a signature in the same order.
fn both<'a>(ring: &'a MachineRing, judged: &'a Judged) -> (Vec<&'a RingEvent>, Vec<&'a RingEvent>) {
    let m = ring.len();
    (judged.seen.iter().collect(), (0..m).map(|i| &ring.events[(judged.from + 1 + i) % m]).collect())
}

/// The event of a signature at which a hold begins that is missing in the motion, while all else happens.
pub(super) fn missing_hold(ring: &MachineRing, judged: &Judged) -> Option<usize> {
    let (seen, expected) = both(ring, judged);
    Some((judged.from + 1 + pair_of(&expected, &seen, is_hold)?) % ring.len())
}

/// The first difference between a signature and the events of the motion from one of its solutions.
pub(crate) fn difference(ring: &MachineRing, judged: &Judged) -> Difference {
    let m = ring.len();
    let stops = ring.events.first().map_or(0, |event| event.back.len());
    // beyond, what an expected event begins does not begin
    let missing = |event: &RingEvent| {
        let own = event.guard.place(stops);
        rest(event.guard, stops, !event.after[own].constrains())
    };
    if let Some(at) = judged.rising {
        let expected = &ring.events[at];
        return match expected.guard {
            GuardKind::Gap(stop) => Difference::Disappears { at, stop },
            guard => missing(expected).unwrap_or(Difference::Other { place: Some(guard.place(stops)) }),
        };
    }
    let wanted = |i: usize| (judged.from + 1 + i) % m;
    let (seen, signature) = both(ring, judged);
    let stop = |event: &RingEvent| event.guard.place(stops);
    // a stop that closed together with another one may open before it
    let apart = |k: usize| k > 0 && signature[k - 1].with.contains(&seen[k].guard);
    if let Some(k) = pair_of(&seen, &signature, is_contact).filter(|k| !apart(*k)) {
        return Difference::Appears { at: wanted(k), stop: stop(seen[k]) };
    }
    if let Some(k) = pair_of(&signature, &seen, is_contact) {
        return Difference::Disappears { at: wanted(k), stop: stop(signature[k]) };
    }
    let at = (0..m.max(judged.seen.len())).find(|i| *i >= m || judged.seen.get(*i) != Some(&ring.events[wanted(*i)]));
    let Some(i) = at else { return Difference::Other { place: None } };
    let expected: &RingEvent = &ring.events[wanted(i % m)];
    let own = expected.guard.place(stops);
    let Some(found) = judged.seen.get(i) else {
        // the motion has fewer events than the signature
        return match expected.guard {
            GuardKind::Gap(stop) => Difference::Disappears { at: wanted(i % m), stop },
            _ => missing(expected).unwrap_or(Difference::Other { place: Some(own) }),
        };
    };
    if i < m && found.guard == expected.guard {
        if found.pushed.iter().map(|(j, _)| j).ne(expected.pushed.iter().map(|(j, _)| j)) {
            let other = found.pushed.iter().chain(&expected.pushed).map(|(j, _)| *j).find(|j| *j != own);
            return match other {
                Some(other) => Difference::Corner { first: own, second: other },
                // a rest that takes no time begins with an impact of speed zero
                None => Difference::Rest { place: own, joint: own >= stops, begins: found.after[own].constrains() },
            };
        }
        let changed = (0..found.after.len()).find(|j| found.after[*j] != expected.after[*j]);
        let rests = |state: ContactState| state.constrains();
        let one_sided = |kind: &&GuardKind| found.with.contains(kind) != expected.with.contains(kind);
        if let Some(kind) = found.with.iter().chain(&expected.with).find(one_sided) {
            return Difference::Corner { first: own, second: kind.place(stops) };
        }
        // the surface of a stop comes back to its holder just when the stop closes
        let returned = (0..found.back.len()).find(|j| found.back[*j] != expected.back[*j]);
        return match changed {
            None if returned.is_some() => {
                let stop = returned.unwrap_or(own);
                Difference::Corner { first: stop, second: stop }
            }
            Some(place) if rests(found.after[place]) != rests(expected.after[place]) => {
                Difference::Rest { place, joint: place >= stops, begins: rests(found.after[place]) }
            }
            Some(place) => Difference::Other { place: Some(place) },
            // a chatter that is summed after another number of impacts
            None => Difference::Rest {
                place: own,
                joint: false,
                begins: found.pushed.iter().any(|(_, push)| *push == Push::Summed),
            },
        };
    }
    let other = found.guard.place(stops);
    let later = |events: &mut dyn Iterator<Item = &RingEvent>, guard| events.take(3).any(|event| event.guard == guard);
    // the expected event comes a little later, or not at all
    let delayed = i < m && later(&mut judged.seen.iter().skip(i + 1), expected.guard);
    // an event after all expected ones is an additional one
    let early = i < m && later(&mut (1..m.min(4)).map(|k| &ring.events[wanted(i + k)]), found.guard);
    let new = || rest(found.guard, stops, found.after[other].constrains());
    match (found.guard, expected.guard) {
        // of stops that close together this one closes first
        (guard @ GuardKind::Gap(stop), GuardKind::Gap(_))
            if i < m && (expected.has(guard) || expected.pushes(stop)) =>
        {
            Difference::Corner { first: own, second: other }
        }
        // a closed stop opens by its force instead of its position, or the other way round
        (GuardKind::Depth(stop), GuardKind::Force(same)) | (GuardKind::Force(stop), GuardKind::Depth(same))
            if stop == same && judged.seen.len() == m =>
        {
            Difference::Corner { first: stop, second: stop }
        }
        _ if delayed && early && judged.seen.len() == m => Difference::Corner { first: own, second: other },
        // only one of both explains the difference
        (_, guard) if early && !delayed && rest(guard, stops, false).is_some() => {
            missing(expected).unwrap_or(Difference::Other { place: Some(own) })
        }
        (guard, _) if delayed && !early && rest(guard, stops, false).is_some() => {
            new().unwrap_or(Difference::Other { place: Some(other) })
        }
        (GuardKind::Gap(stop), _) if judged.seen.len() > m || i >= m => Difference::Appears { at: wanted(i), stop },
        (_, GuardKind::Gap(stop)) if judged.seen.len() < m => Difference::Disappears { at: wanted(i), stop },
        (GuardKind::Gap(stop), _) => Difference::Appears { at: wanted(i), stop },
        (_, GuardKind::Gap(stop)) => Difference::Disappears { at: wanted(i), stop },
        _ => new().or_else(|| missing(expected)).unwrap_or(Difference::Other { place: Some(other) }),
    }
}
