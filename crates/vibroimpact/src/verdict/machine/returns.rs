//! What the record of a motion needs to know of a machine: its returns are its steps from event to event.

use super::super::recurring::{Measurement, Recurring};
use super::outcome::State;
use crate::events::{Event, Motion, Passage, Place, stretched, tangent_steps};
use crate::lyapunov::{Frame, MEASURED_IMPACTS, Run, Stretch, Tail};
use crate::machine::Machine;
use crate::math::dot;
use crate::orbit::machine;
use crate::orbit::{MachineFrame, MachineLap, Stability, passing, rounding_decides};
use crate::regime::GuardKind;
use core::cell::Cell;
use std::sync::Arc;

/// A machine whose motion is recorded.
#[derive(Clone, Debug)]
pub(crate) struct Recorded<'a> {
    pub(crate) frame: MachineFrame<'a>,
    /// The largest coordinates and velocities of late; distances are relative to them.
    pub(crate) sizes: Cell<(f64, f64)>,
}

/// One step of a motion: the state before it, what happened, the state after it.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    pub(crate) begin: Place,
    pub(crate) passage: Passage,
    pub(crate) end: Place,
    /// The number of stops that closed.
    pub(crate) closings: u32,
}

impl Step {
    /// Whether a stop on which the structure rested is left.
    pub(crate) fn releases(&self) -> bool {
        let kind = |guard: &usize| self.passage.structure.guards.get(*guard).map(|guard| guard.kind);
        matches!(self.passage.guards.first().and_then(kind), Some(GuardKind::Reaction(_)))
    }

    /// Whether nothing could move before: then the motion from here on depends on the phase alone.
    pub(crate) fn was_still(&self) -> bool {
        self.passage.structure.is_still()
    }

    /// The next step of a motion, and the events on it; `None` at the end of the motion.
    pub(crate) fn next(motion: &mut Motion<'_>) -> Option<(Self, Vec<Event>)> {
        let begin = motion.place().clone();
        let passage = motion.step()?;
        let events = motion.take_events();
        let closings = events.iter().filter(|event| event.closes()).count();
        let closings = u32::try_from(closings).unwrap_or(u32::MAX);
        Some((Self { begin, passage, end: motion.place().clone(), closings }, events))
    }
}

impl<'a> Recorded<'a> {
    pub(crate) fn new(frame: MachineFrame<'a>) -> Self {
        Self { frame, sizes: Cell::new((0.0, 0.0)) }
    }
}

impl Recurring for Recorded<'_> {
    type System = Machine;
    const LASTING: bool = true;
    type Return = Arc<Step>;
    type Measure = Run;
    /// The returns are the tail.
    type MeasuredTail = ();

    fn distance(&self, a: &Arc<Step>, b: &Arc<Step>) -> f64 {
        // steps with other events or contacts are never the same return
        if a.passage.guards != b.passage.guards || a.begin.states != b.begin.states {
            return f64::INFINITY;
        }
        self.frame.distance(&a.end, &b.end, self.sizes.get())
    }

    fn periods(&self, time: f64) -> f64 {
        self.frame.machine.period().map_or(1.0, |period| time / period)
    }

    fn cycle(&self, last: &Arc<Step>, _: u32, time: f64) -> Option<machine::Cycle> {
        // a machine that moves freely comes to rest anywhere: its motion without events begins after the last one
        let attracts = |cycle: &machine::Cycle| !cycle.events.is_empty() || cycle.translations() == 0;
        machine::Cycle::returning(&self.frame, &last.end, time).filter(attracts)
    }

    fn stable(cycle: &machine::Cycle) -> bool {
        cycle.stable()
    }

    fn captured(&self, last: &Arc<Step>, cycle: &machine::Cycle) -> bool {
        self.captures(&last.end, cycle).unwrap_or(false)
    }

    fn measure(&self, _: &Arc<Step>, over: u32) -> Run {
        Run::for_verdict(self.tangents(), u64::from(over))
    }

    fn add(&self, measure: &mut Run, next: &Arc<Step>, interval: f64) -> bool {
        self.pass(measure, next, interval);
        measure.complete()
    }

    fn left(measure: &Run) -> u32 {
        u32::try_from(measure.left()).unwrap_or(u32::MAX)
    }

    fn chaos(&self, measure: &Run) -> Option<(Measurement<Self>, bool)> {
        measure.chaos().map(|(spectrum, chaotic)| ((spectrum, ()), chaotic))
    }

    fn tail((): (), returns: &[(Arc<Step>, f64)]) -> Option<Tail<State>> {
        // the returns are kept, so the tail needs no record of its own
        let count = returns.len().min(usize::try_from(MEASURED_IMPACTS).unwrap_or(usize::MAX));
        let (first, last) = (&returns.get(returns.len() - count)?.0, &returns.last()?.0);
        Some(Tail { from: State::of(&first.begin), last: State::of(&last.end), impacts: count as u64 })
    }
}

impl Recorded<'_> {
    /// Tangent vectors at the beginning of a measurement.
    pub(crate) fn tangents(&self) -> Frame {
        Frame::new(self.frame.shape.size(), self.frame.metric(), 2 * self.frame.shape.n)
    }

    /// Adds a step to a measurement. A grazing contact has no derivative and is passed over.
    pub(crate) fn pass(&self, measure: &mut Run, step: &Step, interval: f64) {
        let frame = &self.frame;
        let steps = frame.with(|structures| {
            tangent_steps(&frame.shape, frame.machine, &frame.normal, structures, (&step.begin, &step.passage))
        });
        // its tangents stay what they were: one event in many does not change a mean
        let Some(steps) = steps else { return };
        let carry = |tangents: &mut Frame| {
            let logs = |vectors: &mut _, metric: &_| stretched(&frame.shape, &frame.normal, &steps, vectors, metric);
            tangents.carry(|vectors, metric| logs(vectors, metric).into_iter().map(Stretch::Log));
            f64::NAN
        };
        measure.add(carry, interval, f64::from(step.closings));
    }

    /// The cycle of a motion that returns to a state after a time.
    pub(crate) fn same(&self, step: &Arc<Step>, after: f64) -> Option<machine::Cycle> {
        // a time that rounds to no period, or to a longer one than is searched for
        if !(0.5..LONGEST + 0.5).contains(&self.periods(after)) {
            return None;
        }
        let cycle = machine::Cycle::returning(&self.frame, &step.end, after)?;
        self.captured(step, &cycle).then_some(cycle)
    }

    /// Whether rounding errors decide how the motion that returns to a state after a time goes on from it.
    pub(crate) fn rounding_decides(&self, step: &Step, after: f64) -> bool {
        MachineLap::replay(&self.frame, &step.end, after).is_some_and(|lap| rounding_decides(&self.frame, &lap))
    }

    /// Whether the motion from `place` is captured by a cycle: it is on it to rounding, and does not leave it if it is unstable, or all its
    /// directions contract but for the places of joints that hold all the time, and it is near at the phase of the states of the cycle,
    /// and its next period follows the linear law of the cycle so closely that the remainder cannot undo the contraction.
    /// Without forcing it is near where it crosses the plane across the flow at the state of the cycle.
    pub(crate) fn captures(&self, place: &Place, cycle: &machine::Cycle) -> Option<bool> {
        let frame = &self.frame;
        let (real, nearest, apart) = passing(frame, place, cycle)?;
        // far away the linear law says nothing
        if apart > NEAR {
            return Some(false);
        }
        if apart <= AT_ROUNDING {
            return Some(cycle.stability() != Stability::Unstable || self.stays(&real, cycle));
        }
        if cycle.stability() == Stability::Unstable {
            return Some(false);
        }
        let time = cycle.period;
        // both fly over one period of the cycle: their difference obeys its linear law up to second order
        let (reference, moved) = (MachineLap::fly(frame, nearest, time)?, MachineLap::replay(frame, &real, time)?);
        let before = frame.apart(&real, nearest);
        let mut linear = reference.derivative.as_ref()?.apply(&before);
        // where a body moves freely, its position is no part of the motion
        frame.normal.translations.remove(&mut linear);
        let after = frame.apart(&moved.end, &reference.end);
        let (size, speed) = cycle.sizes;
        let n = frame.shape.n;
        let largest = |of: &dyn Fn(usize) -> f64| {
            (0..2 * n)
                .map(|i| of(i).abs() / if i < n { size } else { speed })
                .filter(|x| x.is_finite())
                .fold(0.0, f64::max)
        };
        // relative to the sizes of the cycle, so that units do not matter
        let left_over = largest(&|i| after[i] - linear[i]);
        // joints that hold all the time keep their place, and all other directions must contract
        let (holding, each) = (reference.holding(), cycle.stabilities());
        let neutral = each.iter().filter(|one| **one == Stability::Neutral).count();
        let kept = holding.iter().all(|joint| {
            let direction = &frame.normal.directions[*joint];
            let moved = dot(direction, &before[..n]).abs() / dot(direction, direction).sqrt();
            moved <= AT_ROUNDING * size
        });
        if neutral > holding.len() || !kept {
            return Some(false);
        }
        // neutral directions belong to joints that hold, and were checked above
        let contracting = cycle.multipliers.iter().zip(&each).filter(|(_, one)| one.is_stable());
        let rate = contracting.map(|(multiplier, _)| multiplier.modulus()).fold(0.0, f64::max);
        Some(left_over <= 0.3 * (1.0 - rate) * largest(&|i| before[i]) + 1e-12)
    }

    /// Whether the motion from `real` stays on an unstable cycle for ever, as exactly symmetric ones do: for so many periods that
    /// a rounding error across it would have grown to the distance [`NEAR`].
    fn stays(&self, real: &Place, cycle: &machine::Cycle) -> bool {
        // a rounding error grows by this logarithm in each period
        let growth = crate::math::ln(cycle.multipliers.iter().map(|one| one.modulus()).fold(0.0, f64::max));
        let periods = crate::math::ln(NEAR / f64::EPSILON) / growth;
        if periods >= f64::from(PERIODS) {
            return false;
        }
        let mut place = real.clone();
        (0..PERIODS).take_while(|k| f64::from(*k) < periods).all(|_| {
            let Some(lap) = MachineLap::replay(&self.frame, &place, cycle.period) else { return false };
            // the phase is set, so that sums of the period do not drift
            place = Place { phase: place.phase, ..lap.end };
            let apart = |strobe| self.frame.distance(strobe, &place, cycle.sizes);
            cycle.strobes.iter().map(apart).fold(f64::INFINITY, f64::min) <= AT_ROUNDING
        })
    }
}

/// The longest period of a cycle that is searched for from a release, in forcing periods.
const LONGEST: f64 = 10_000.0;
/// The most periods for which a motion on an unstable cycle is followed.
const PERIODS: u32 = 10_000;
/// The distance from a cycle below which capture is tested.
const NEAR: f64 = 1e-3;
/// The distance below which the two differ only by rounding errors.
const AT_ROUNDING: f64 = 1e-10;
