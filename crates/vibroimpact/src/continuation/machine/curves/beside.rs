//! Whether a solution with a touch, a corner, or contacts at their limits is admissible.
//!
//! At these events rounding decides which events the motion has. So the motion is followed from a little after each of them
//! to a little before the next one. There it must have the other events of the signature and reach the state that the
//! equations say.

use super::moment::{Moment, OnFlight};
use crate::continuation::machine::branches::{CLOSED, Judged, matched, seen_on};
use crate::events::Place;
use crate::orbit::{Chatter, MachineFrame, MachineLap, MachineRing, RingEvent, machine::Cycle, machine::Neighbours};

/// How long after and before, as a fraction of the flight to the next or from the last event.
const BESIDE: f64 = 1e-4;

/// Moments whose phases differ by less are the same.
const SAME: f64 = 1e-6;

/// The events of a ring that belong to none of these moments, in the order of the motion after the first moment.
fn others(m: usize, moments: &[Moment]) -> Vec<usize> {
    let Some(Moment::Events(_, begin) | Moment::Flight(begin, _)) = moments.first() else { return Vec::new() };
    (1..=m).map(|i| (begin + i) % m).filter(|k| !moments.iter().any(|moment| moment.has(*k, m))).collect()
}

/// The ring without its events at these moments, beginning with the event after the first of them; `None` if there is no
/// other.
pub(super) fn bare(ring: &MachineRing, moments: &[Moment]) -> Option<MachineRing> {
    let kept = others(ring.len(), moments);
    let events: Vec<RingEvent> = kept.iter().map(|k| ring.events[*k].clone()).collect();
    let places = kept.iter().map(|k| ring.places[*k].clone()).collect();
    (!events.is_empty()).then_some(MachineRing { events, places, together: None, ..*ring })
}

/// The motion from a little after a moment to a little before the next one.
struct Part {
    begin: Place,
    /// The phase at its beginning, since the first moment.
    since: f64,
    lap: MachineLap,
    /// The state that the equations say at its end.
    expected: Place,
}

/// The motion between two moments; `base` is the phase of the first of all.
fn between(frame: &MachineFrame<'_>, ring: &MachineRing, (one, next): (&Moment, &Moment), base: f64) -> Option<Part> {
    let (machine, frequency) = (frame.machine, ring.frequency(frame.machine));
    let at = |(leg, time): OnFlight| {
        let mut from = ring.place(leg);
        frame.constrain(&mut from)?;
        let structure = frame.structure(&from.states)?;
        Some(frame.moved(&from, &structure, time))
    };
    let ((leg, since), (end, until)) = (one.after(ring, machine), next.before(ring, machine));
    let (after, before) = (BESIDE * (ring.time(leg, machine) - since), BESIDE * until);
    let begin = at((leg, since + after))?;
    let expected = at((end, until - before))?;
    let mut angle = ring.theta(end) - ring.theta(leg) + frequency * (until - since);
    // from the only moment to itself
    if angle < SAME {
        angle += ring.angle();
    }
    let lap = MachineLap::replay(frame, &begin, angle / frequency - after - before)?;
    let since = (ring.theta(leg) + frequency * (since + after) - base).rem_euclid(ring.angle());
    Some(Part { begin, since, lap, expected })
}

/// The motion over the period through all moments, from a little after the first of them, with all chatters of the signature.
/// Of a chatter that is complete at its release rounding decides whether it is; where it is not, velocities before it are changed
/// by a little. `speed` is the largest velocity, and phases are those since the first moment.
fn through(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    parts: &[Part],
    (speed, since): (f64, impl Fn(usize) -> f64),
) -> Option<MachineLap> {
    // a chatter that rounding keeps from its end can have very many impacts
    let most = 100 + 10 * ring.len();
    let mut whole: Option<MachineLap> = None;
    for (i, part) in parts.iter().enumerate() {
        let until = parts.get(i + 1).map_or(parts[0].since + ring.angle(), |next| next.since);
        let within = |chatter: &Chatter| (part.since..until).contains(&since(chatter.rest));
        let chatters = Chatter::all(ring).iter().filter(|chatter| within(chatter)).count();
        let fly = |by: f64| {
            let mut begin = part.begin.clone();
            begin.v.iter_mut().for_each(|v| *v += by * speed);
            frame.constrain(&mut begin)?;
            MachineLap::replay_in(frame, &begin, (until - part.since) / ring.frequency(frame.machine), most)
        };
        let alike =
            |lap: &MachineLap| lap.steps.iter().filter(|(.., passage)| passage.rest.is_some()).count() == chatters;
        let own = fly(0.0);
        let beside = || NUDGES.into_iter().flat_map(|by| [fly(by), fly(-by)]).flatten().find(alike);
        let lap = own.clone().filter(alike).or_else(beside).or(own)?;
        whole = Some(if let Some(whole) = whole { whole.then(lap) } else { lap });
    }
    whole
}

/// Changes of the velocities, in the largest one.
const NUDGES: [f64; 7] = [1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];

/// What is known of a solution with these moments in order. The events seen are those after the first of them.
pub(super) fn judge_beside(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    moments: &[Moment],
    (neighbours, rising): (Neighbours, Option<usize>),
) -> Judged {
    let m = ring.len();
    let kept = others(m, moments);
    let from = kept.len().max(1) - 1;
    let nothing = |seen| Judged { cycle: None, multipliers: neighbours.multipliers.clone(), seen, from, rising };
    // phases since the first moment
    let (first, base) = match moments.first() {
        Some(Moment::Flight(leg, phase)) => (*leg, *phase),
        Some(Moment::Events(_, last)) => (*last, ring.theta(*last)),
        None => return nothing(Vec::new()),
    };
    let since = |k: usize| ring.theta(first + 1 + (k + m - first - 1) % m) - base;
    let wanted: Vec<(f64, &RingEvent)> = kept.iter().map(|k| (since(*k), &ring.events[*k])).collect();
    let mut seen = Vec::new();
    let mut flown = Vec::new();
    for (one, next) in moments.iter().zip(moments.iter().cycle().skip(1)) {
        let Some(part) = between(frame, ring, (one, next), base) else { return nothing(Vec::new()) };
        let events = seen_on(&part.lap, ring.frequency(frame.machine)).into_iter();
        seen.extend(events.map(|(phase, event)| (part.since + phase, event)));
        flown.push(part);
    }
    let seen = matched(&wanted, &seen);
    let alike = seen.len() == kept.len() && seen.iter().zip(&kept).all(|(seen, k)| *seen == ring.events[*k]);
    // a machine with friction has no velocity at its events
    let middle = ring.middle(frame).map(|(_, middle)| frame.sizes(&middle));
    let larger = |a: (f64, f64), b: (f64, f64)| (a.0.max(b.0), a.1.max(b.1));
    let sizes = flown.iter().map(|part| part.lap.sizes).chain(middle).fold((0.0, 0.0), larger);
    let residual = flown.iter().map(|part| frame.distance(&part.expected, &part.lap.end, sizes)).fold(0.0, f64::max);
    if !(alike && rising.is_none() && residual < CLOSED) {
        return nothing(seen);
    }
    // the cycle has all events but a touch
    let cycle = || {
        let whole = ring.period(frame);
        let Part { begin, lap, .. } = flown.first()?;
        let touches = |event: usize| ring.events[event].touches(&ring.events[(event + m - 1) % m].after);
        let touch = matches!(moments, [Moment::Events(first, last)] if first == last && touches(*first));
        let flown = if touch { None } else { through(frame, ring, &flown, (sizes.1, since)) };
        // rounding can let a motion end at a limit
        let lap = flown.or_else(|| (moments.len() == 1).then(|| MachineLap { time: whole, ..lap.clone() }))?;
        Some((begin, MachineLap { sizes, ..lap }))
    };
    let Some((begin, lap)) = cycle() else { return nothing(seen) };
    let whole = (residual, vec![begin.clone()]);
    let cycle = Cycle::beside(frame, (begin, ring.periods), &lap, whole, neighbours.clone());
    Judged { cycle: Some(cycle), ..nothing(seen) }
}
