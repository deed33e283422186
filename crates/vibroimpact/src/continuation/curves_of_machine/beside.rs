//! Whether a solution with a touch, a corner, or contacts at their limits is admissible.
//!
//! At these events rounding decides which events the motion has. So the motion is followed from a little after each of them
//! to a little before the next one. There it must have the other events of the signature and reach the state that the
//! equations say.

use crate::continuation::of_machine::{CLOSED, Judged};
use crate::events::Place;
use crate::math::Multiplier;
use crate::orbit::{MachineCycle, MachineFrame, MachineLap, MachineRing, RingEvent};

/// How long after and before, as a fraction of the flights there.
const BESIDE: f64 = 1e-4;

/// The events of a ring apart from those of `special`, which are given by their first and last event, in the order of the
/// motion after the first of `special`.
fn others(m: usize, special: &[(usize, usize)]) -> Vec<usize> {
    let Some((_, begin)) = special.first() else { return Vec::new() };
    let own = |k: &usize| special.iter().any(|(first, last)| k == first || k == last);
    (1..=m).map(|i| (begin + i) % m).filter(|k| !own(k)).collect()
}

/// The ring without its events of `special`, beginning with the event after the first of them; `None` if there is no other.
pub(super) fn bare(ring: &MachineRing, special: &[(usize, usize)]) -> Option<MachineRing> {
    let kept = others(ring.len(), special);
    let events: Vec<RingEvent> = kept.iter().map(|k| ring.events[*k].clone()).collect();
    let places = kept.iter().map(|k| ring.places[*k].clone()).collect();
    (!events.is_empty()).then_some(MachineRing { events, places, periods: ring.periods, together: None })
}

/// The motion from a little after event `last` to a little before event `next`, which is counted on beyond the end of the
/// ring: the state at its beginning, the motion, and the state that the equations say at its end.
fn between(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (last, next): (usize, usize),
) -> Option<(Place, MachineLap, Place)> {
    let frequency = frame.machine.parts().frequency?;
    let m = ring.len();
    let at = |k: usize, time: f64| {
        let mut from = ring.place(k);
        frame.constrain(&mut from)?;
        let structure = frame.structure(&from.states)?;
        Some(frame.moved(&from, &structure, time))
    };
    let before = (next - 1) % m;
    let (after, until) = (BESIDE * ring.time(last, frequency), BESIDE * ring.time(before, frequency));
    let begin = at(last, after)?;
    let expected = at(before, ring.time(before, frequency) - until)?;
    let whole = (ring.theta(next) - ring.theta(last)) / frequency;
    let lap = MachineLap::fly(frame, &begin, whole - after - until)?;
    Some((begin, lap, expected))
}

/// What is known of a solution with the events `special`, in order, each given by its first and last event, which happen at
/// once or are one. The events seen are those after the first of them.
pub(super) fn judge_beside(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    special: &[(usize, usize)],
    (multipliers, rising): (Vec<Multiplier>, Option<usize>),
) -> Judged {
    let m = ring.len();
    let kept = others(m, special);
    let from = kept.len().max(1) - 1;
    let nothing = |multipliers, seen| Judged { cycle: None, multipliers, seen, from, rising };
    let mut seen = Vec::new();
    let mut flown = Vec::new();
    for (i, (_, last)) in special.iter().enumerate() {
        let next = special.get(i + 1).map_or_else(|| special[0].0 + m, |next| next.0);
        let Some(part) = between(frame, ring, (*last, next)) else { return nothing(multipliers, seen) };
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
        let whole = frame.machine.period()? * f64::from(ring.periods);
        let (begin, lap, _) = flown.first()?;
        let touches = |event: usize| ring.events[event].touches(&ring.events[(event + m - 1) % m].after);
        let touch = matches!(special, [(first, last)] if first == last && touches(*first));
        let flown = if touch { None } else { MachineLap::fly(frame, begin, whole) };
        // rounding can let a motion end at a limit
        let lap = flown.or_else(|| (special.len() == 1).then(|| MachineLap { time: whole, ..lap.clone() }))?;
        Some((begin, MachineLap { sizes, ..lap }))
    };
    let Some((begin, lap)) = cycle() else { return nothing(multipliers, seen) };
    let cycle = MachineCycle {
        multipliers: multipliers.clone(),
        ..MachineCycle::of(frame, (begin, ring.periods), &lap, residual, vec![begin.clone()])
    };
    Judged { cycle: Some(cycle), seen, ..nothing(multipliers, Vec::new()) }
}
