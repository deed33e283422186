//! Whether a solution with a touch, a corner, or contacts at their limits is admissible.
//!
//! At these events rounding decides which events the motion has. So the motion is followed from a little after each of them
//! to a little before the next one. There it must have the other events of the signature and reach the state that the
//! equations say.

use super::moment::{Moment, OnFlight};
use crate::continuation::of_machine::{CLOSED, Judged};
use crate::events::Place;
use crate::math::Multiplier;
use crate::orbit::{MachineCycle, MachineFrame, MachineLap, MachineRing, RingEvent};

/// How long after and before, as a fraction of the flight to the next or from the last event.
const BESIDE: f64 = 1e-4;

/// Moments whose phases differ by less are the same.
const SAME: f64 = 1e-6;

/// The events of a ring that belong to none of these moments, in the order of the motion after the first moment.
fn others(m: usize, moments: &[Moment]) -> Vec<usize> {
    let Some(Moment::Events(_, begin) | Moment::Flight(begin, _)) = moments.first() else { return Vec::new() };
    (1..=m).map(|i| (begin + i) % m).filter(|k| !moments.iter().any(|moment| moment.has(*k))).collect()
}

/// The ring without its events at these moments, beginning with the event after the first of them; `None` if there is no
/// other.
pub(super) fn bare(ring: &MachineRing, moments: &[Moment]) -> Option<MachineRing> {
    let kept = others(ring.len(), moments);
    let events: Vec<RingEvent> = kept.iter().map(|k| ring.events[*k].clone()).collect();
    let places = kept.iter().map(|k| ring.places[*k].clone()).collect();
    (!events.is_empty()).then_some(MachineRing { events, places, together: None, ..*ring })
}

/// The motion from a little after a moment to a little before the next one: the state at its beginning, the motion, and the
/// state that the equations say at its end.
fn between(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (one, next): (&Moment, &Moment),
) -> Option<(Place, MachineLap, Place)> {
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
    let lap = MachineLap::fly(frame, &begin, angle / frequency - after - before)?;
    Some((begin, lap, expected))
}

/// What is known of a solution with these moments in order. The events seen are those after the first of them.
pub(super) fn judge_beside(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    moments: &[Moment],
    (multipliers, rising): (Vec<Multiplier>, Option<usize>),
) -> Judged {
    let m = ring.len();
    let kept = others(m, moments);
    let from = kept.len().max(1) - 1;
    let nothing = |multipliers, seen| Judged { cycle: None, multipliers, seen, from, rising };
    let mut seen = Vec::new();
    let mut flown = Vec::new();
    for (one, next) in moments.iter().zip(moments.iter().cycle().skip(1)) {
        let Some(part) = between(frame, ring, (one, next)) else { return nothing(multipliers, seen) };
        let steps = &part.1.steps;
        seen.extend(steps[..steps.len() - 1].iter().filter_map(|step| RingEvent::of(&step.2)));
        flown.push(part);
    }
    let alike = seen.len() == kept.len() && seen.iter().zip(&kept).all(|(seen, k)| *seen == ring.events[*k]);
    // a machine with friction has no velocity at its events
    let middle = ring.middle(frame).map(|(_, middle)| frame.sizes(&middle));
    let larger = |a: (f64, f64), b: (f64, f64)| (a.0.max(b.0), a.1.max(b.1));
    let sizes = flown.iter().map(|(_, lap, _)| lap.sizes).chain(middle).fold((0.0, 0.0), larger);
    let residual = flown.iter().map(|(_, lap, expected)| frame.distance(expected, &lap.end, sizes)).fold(0.0, f64::max);
    if !(alike && rising.is_none() && residual < CLOSED) {
        return nothing(multipliers, seen);
    }
    // the cycle has all events but a touch
    let cycle = || {
        let whole = ring.period(frame);
        let (begin, lap, _) = flown.first()?;
        let touches = |event: usize| ring.events[event].touches(&ring.events[(event + m - 1) % m].after);
        let touch = matches!(moments, [Moment::Events(first, last)] if first == last && touches(*first));
        let flown = if touch { None } else { MachineLap::fly(frame, begin, whole) };
        // rounding can let a motion end at a limit
        let lap = flown.or_else(|| (moments.len() == 1).then(|| MachineLap { time: whole, ..lap.clone() }))?;
        Some((begin, MachineLap { sizes, ..lap }))
    };
    let Some((begin, lap)) = cycle() else { return nothing(multipliers, seen) };
    let cycle = MachineCycle {
        multipliers: multipliers.clone(),
        ..MachineCycle::of(frame, (begin, ring.periods), &lap, residual, vec![begin.clone()])
    };
    Judged { cycle: Some(cycle), seen, ..nothing(multipliers, Vec::new()) }
}
