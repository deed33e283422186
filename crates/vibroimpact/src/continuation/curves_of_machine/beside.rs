//! Whether a solution with a touch or a corner is admissible.
//!
//! At a touch and at a corner rounding decides which events the motion has. So the motion is followed from a little after to
//! a little before, where it must have the other events of the signature and reach the state that the equations say.

use crate::continuation::of_machine::{CLOSED, Judged};
use crate::math::Multiplier;
use crate::orbit::{MachineCycle, MachineFrame, MachineLap, MachineRing, RingEvent};

/// How long after and before, as a fraction of the flights there.
const BESIDE: f64 = 1e-4;

/// The ring without its events from `first` to `last`, beginning with the event after them; `None` if there is no other.
pub(super) fn bare(ring: &MachineRing, (first, last): (usize, usize)) -> Option<MachineRing> {
    let m = ring.len();
    let count = if first == last { 1 } else { 2 };
    let kept: Vec<usize> = (1..=m - count).map(|i| (last + i) % m).collect();
    let events: Vec<RingEvent> = kept.iter().map(|k| ring.events[*k].clone()).collect();
    let places = kept.iter().map(|k| ring.places[*k].clone()).collect();
    (!events.is_empty()).then_some(MachineRing { events, places, periods: ring.periods, together: None })
}

/// What is known of a solution whose events from `first` to `last` happen at once or are a touch. The events seen are those
/// after them.
pub(super) fn judge_beside(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (first, last): (usize, usize),
    (multipliers, rising): (Vec<Multiplier>, Option<usize>),
) -> Judged {
    let m = ring.len();
    let others = m - if first == last { 1 } else { 2 };
    let nothing = |multipliers| Judged { cycle: None, multipliers, seen: Vec::new(), from: others.max(1) - 1, rising };
    let flown = || {
        let frequency = frame.machine.parts().frequency?;
        let at = |k: usize, time: f64| {
            let mut from = ring.place(k);
            frame.constrain(&mut from)?;
            let structure = frame.structure(&from.states)?;
            Some(frame.moved(&from, &structure, time))
        };
        let before = (first + m - 1) % m;
        let (after, until) = (BESIDE * ring.time(last, frequency), BESIDE * ring.time(before, frequency));
        let begin = at(last, after)?;
        let expected = at(before, ring.time(before, frequency) - until)?;
        let apart = if first == last { 0.0 } else { ring.time(first, frequency) };
        let whole = frame.machine.period()? * f64::from(ring.periods);
        let lap = MachineLap::fly(frame, &begin, whole - after - until - apart)?;
        // both events of a corner belong to the cycle
        let touching = || MachineLap { time: whole, ..lap.clone() };
        let cycle = if first == last { touching() } else { MachineLap::fly(frame, &begin, whole)? };
        Some((begin, expected, lap, cycle))
    };
    let Some((begin, expected, lap, cycle)) = flown() else { return nothing(multipliers) };
    let seen: Vec<RingEvent> =
        lap.steps[..lap.steps.len() - 1].iter().filter_map(|step| RingEvent::of(&step.2)).collect();
    let alike = seen.len() == others && (0..others).all(|i| seen[i] == ring.events[(last + 1 + i) % m]);
    let residual = frame.distance(&expected, &lap.end, lap.sizes);
    let cycle = (alike && rising.is_none() && residual < CLOSED).then(|| MachineCycle {
        multipliers: multipliers.clone(),
        ..MachineCycle::of(frame, (&begin, ring.periods), &cycle, residual, vec![begin.clone()])
    });
    Judged { cycle, seen, ..nothing(multipliers) }
}
