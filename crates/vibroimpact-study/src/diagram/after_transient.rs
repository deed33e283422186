//! A motion of a machine after its transient: its closings, or its states at phase 0.

use super::{AfterTransient, DiagramPoint, MotionKind, SAME};
use crate::PlanError;
use crate::dynamics::refused;
use crate::map::options;
use crate::motion_limits;
use crate::quantity::values_of;
use core::f64::consts::TAU;
use vibroimpact::events::{End, Motion, Sample, Samples, Start};
use vibroimpact::machine::Machine;
use vibroimpact::regime::ContactState;
use vibroimpact::system::phase;
use vibroimpact::verdict::settle_machine;

/// The largest number of events for each closing or period: opening, sticking, slipping and chatter are events too.
pub(crate) const EVENTS_EACH: u64 = 1000;
/// The number of closings for which a motion may have events in advance.
const BEFORE: u64 = 10;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * (1.0 + a.abs())
}

/// Follows the motion for `transient` closings and returns the next `keep` ones, or fewer if they repeat. A motion that
/// ends has no points, nor has one of a machine without stops; it is carried on for as many periods as the transient is long.
#[allow(clippy::cast_precision_loss)] // at most 1.1e6 periods
pub(super) fn closings(
    machine: &Machine,
    start: &Start,
    (transient, keep): (u64, u64),
) -> Result<AfterTransient<Start>, PlanError> {
    let onwards = |last: Start| match machine.period() {
        Some(period) => after(machine, &last, transient.max(1) as f64 * period),
        None => Ok(last),
    };
    if machine.stops().is_empty() {
        return Ok(AfterTransient { kind: MotionKind::NoImpact, points: Vec::new(), last: onwards(start.clone())? });
    }
    let mut motion = Motion::new(machine, start, motion_limits(machine, f64::INFINITY)).map_err(refused)?;
    let mut points: Vec<DiagramPoint> = Vec::new();
    let (mut count, mut events) = (0, 0);
    // a motion may have many events before its first closing, but one that closes no more is not followed for ever
    while events < EVENTS_EACH * (count + BEFORE) {
        events += 1;
        let Some(event) = motion.next() else {
            let kind = match motion.end() {
                Some(End::Never) => MotionKind::NoImpact,
                Some(End::Stuck) => MotionKind::Stuck,
                _ => MotionKind::Undecided,
            };
            let last = motion.reached();
            let last = if kind == MotionKind::Undecided { last } else { onwards(last)? };
            return Ok(AfterTransient { kind, points: Vec::new(), last });
        };
        if !event.closes() {
            continue;
        }
        count += 1;
        if count <= transient {
            continue;
        }
        let again = |first: &DiagramPoint| {
            matches!(first, DiagramPoint::Impact { stop, phase, speed }
                if *stop == event.place
                    && near(*speed, event.speed)
                    && phase::difference(*phase, event.phase).abs() <= SAME)
        };
        if points.first().is_some_and(again) {
            break;
        }
        points.push(DiagramPoint::Impact { stop: event.place, phase: event.phase, speed: event.speed });
        if points.len() as u64 >= keep {
            break;
        }
    }
    let kind = if points.is_empty() { MotionKind::Undecided } else { MotionKind::Impacts };
    Ok(AfterTransient { kind, points, last: motion.reached() })
}

/// The state a time after a start without events.
fn after(machine: &Machine, start: &Start, time: f64) -> Result<Start, PlanError> {
    let samples = Samples::new(machine, start, motion_limits(machine, time), (time, time)).map_err(refused)?;
    Ok(samples.last().map_or_else(|| start.clone(), |sample| sample.start()))
}

/// A motion from its first state at phase 0 of the forcing: that state, and the states at phase 0 over so many forcing periods,
/// which are even samples, with those at its events between them.
#[allow(clippy::cast_precision_loss)] // at most 1.1e6 periods
pub(crate) fn at_phase_zero<'a>(
    machine: &'a Machine,
    start: &Start,
    periods: u64,
) -> Result<(Start, Samples<'a>), PlanError> {
    let period = machine.period().ok_or(PlanError::Unforced)?;
    let start = if start.phase > 0.0 {
        let there = after(machine, start, (TAU - start.phase) / TAU * period)?;
        Start { phase: 0.0, ..there.within_stops(machine) }
    } else {
        start.clone()
    };
    let until = periods as f64 * period;
    let samples = Samples::new(machine, &start, motion_limits(machine, until), (until, period)).map_err(refused)?;
    Ok((start, samples))
}

/// Follows the motion for `transient` forcing periods and returns the values of `of` at the next `keep` times of phase 0,
/// or fewer if the states repeat.
pub(super) fn strobes(
    machine: &Machine,
    start: &Start,
    (transient, keep): (u64, u64),
    of: impl Fn(&Sample) -> f64,
) -> Result<AfterTransient<Start>, PlanError> {
    let (start, samples) = at_phase_zero(machine, start, transient + keep)?;
    let mut points: Vec<DiagramPoint> = Vec::new();
    let mut first: Option<Sample> = None;
    let (mut number, mut events) = (0, false);
    let mut last = start.clone();
    let mut rests = false;
    for sample in samples {
        if !sample.even {
            events |= number > transient && number > 0;
            continue;
        }
        number += 1;
        last = sample.start();
        last.phase = 0.0;
        if number <= transient {
            continue;
        }
        rests = sample.states.contains(&ContactState::Resting);
        let again = first.as_ref().is_some_and(|first| {
            let pairs = first.q.iter().zip(&sample.q).chain(first.qdot.iter().zip(&sample.qdot));
            pairs.clone().all(|(a, b)| near(*a, *b))
        });
        if again || points.len() as u64 >= keep {
            break;
        }
        points.push(DiagramPoint::State { x: of(&sample), v: None });
        first.get_or_insert(sample);
    }
    let kind = match (points.is_empty(), events, rests) {
        (true, ..) => MotionKind::Undecided,
        (_, true, _) => MotionKind::Impacts,
        (_, _, true) => MotionKind::Stuck,
        _ => MotionKind::NoImpact,
    };
    Ok(AfterTransient { kind, points, last })
}

/// The settled motion, with one point: the value of a quantity of it, if it is defined and finite.
pub(super) fn settled(machine: &Machine, start: &Start, quantity: &str) -> Result<AfterTransient<Start>, PlanError> {
    let found = settle_machine(machine, start, &options(None)).map_err(refused)?.verdict;
    let value = values_of(machine, &found, &[quantity.to_owned()])[0];
    let point = value.is_finite().then_some(DiagramPoint::Value(value));
    let kind = MotionKind::of(&found);
    let last = found.reached(machine).unwrap_or_else(|| start.clone());
    Ok(AfterTransient { kind, points: point.into_iter().collect(), last })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineSource;

    /// A machine with friction and without stops has events for ever, and no closings.
    #[test]
    fn without_stops_there_are_no_closings() {
        let machine = MachineSource::open("den-hartog").unwrap().machine().unwrap();
        let start = Start { q: vec![0.0], qdot: vec![0.0], phase: 0.0, ..Start::default() };
        let AfterTransient { kind, points, last } = closings(&machine, &start, (500, 100)).unwrap();
        assert!(kind == MotionKind::NoImpact && points.is_empty() && last != start);
    }
}
