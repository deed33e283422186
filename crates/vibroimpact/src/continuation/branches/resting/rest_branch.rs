//! A branch of cycles that stick, by their release.
//!
//! A release determines the motion that follows it, so a cycle that sticks is a function of the parameter: it needs no
//! Newton correction and has no folds. A step is accepted if the impacts at its end correspond to those at its
//! beginning; the number of impacts of a chatter that are listed before its sum does not matter. If no step is short
//! enough, there is an event, which `rest_events` identifies.

use super::super::impact_branch::place;
use super::super::options::{BranchError, BranchOptions, Direction, scale};
use super::super::point::SolutionPoint;
use super::likeness::{Likeness, likeness};
use crate::continuation::event::BranchEvent;
use crate::continuation::trace::step_length::StepLength;
use crate::orbit::{Cycle, DEFAULT_EVENTS, Excursion};
use crate::system::{Oscillator, ParameterPath, Side};
use core::ops::RangeInclusive;
use std::collections::VecDeque;

/// An event: the value of the parameter, and the cycle there.
pub(crate) struct FoundEvent {
    pub(crate) value: f64,
    pub(crate) event: BranchEvent,
    pub(crate) cycle: Cycle,
}

/// A branch of cycles that stick.
#[derive(Clone, Debug)]
pub(crate) struct RestBranch {
    osc: Oscillator,
    varying: ParameterPath,
    /// The stop of the release with which a cycle begins.
    side: Side,
    pub(crate) direction: Direction,
    /// The end of the range in the direction of the branch.
    end: f64,
    options: BranchOptions,
    /// The change of the parameter that has length 1: a quarter of the range.
    scale: f64,
    step: StepLength,
    pub(crate) value: f64,
    pub(crate) excursion: Excursion,
    /// The latest values at which an impact appeared, without another kind of event between them.
    added: Vec<f64>,
    count: u32,
    pending: VecDeque<SolutionPoint>,
    over: bool,
}

impl RestBranch {
    /// The branch of `cycle`, a cycle of `osc` that sticks.
    pub(crate) fn new(
        osc: &Oscillator,
        cycle: &Cycle,
        varying: ParameterPath,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let value = place(osc, &varying)?;
        let scale = scale(&range, value)?;
        let side = cycle.rests.last().map_or(Side::Upper, |rest| rest.side);
        let excursion = Excursion::new(osc, side, DEFAULT_EVENTS, f64::INFINITY).ok_or(BranchError::NoCycle)?;
        let found = excursion.cycle().ok_or(BranchError::NoCycle)?;
        // the number of impacts of a chatter in the list can differ, so the first impact and the label are compared
        let first = |cycle: &Cycle| cycle.points.first().map(|point| (point.state.side, point.state.phase));
        let same = match (first(&found), first(cycle)) {
            (Some((side, phase)), Some((s, p))) => side == s && crate::system::phase::difference(phase, p).abs() < SAME,
            _ => false,
        };
        if found.label != cycle.label || !same {
            return Err(BranchError::NoCycle);
        }
        let mut branch = Self {
            osc: *osc,
            varying,
            side,
            direction,
            end: if direction == Direction::Up { *range.end() } else { *range.start() },
            options,
            scale,
            step: StepLength { now: options.first * scale, longest: options.longest * scale, shortest: 0.0 },
            value,
            excursion,
            added: Vec::new(),
            count: 0,
            pending: VecDeque::new(),
            over: false,
        };
        branch.add(value, found, None);
        Ok(branch)
    }

    /// The oscillator at a value of the parameter; `None` if the value is invalid.
    pub(crate) fn at(&self, value: f64) -> Option<Oscillator> {
        self.varying.set(&self.osc, value).ok()
    }

    /// The motion from the release at a value of the parameter, over half a forcing period more than the cycle at the
    /// current value.
    pub(crate) fn excursion_at(&self, value: f64) -> Option<Excursion> {
        // half a period more than the cycle takes: a motion that is not back by then is another one
        let periods = 0.5 + f64::from(self.excursion.periods.unwrap_or(1));
        Excursion::new(&self.at(value)?, self.side, DEFAULT_EVENTS, periods)
    }

    /// The value at a distance from the current one, in the direction of the branch.
    pub(crate) fn ahead(&self, by: f64) -> f64 {
        if self.direction == Direction::Up { self.value + by } else { self.value - by }
    }

    fn add(&mut self, value: f64, cycle: Cycle, event: Option<BranchEvent>) {
        self.pending.push_back(SolutionPoint { value, cycle, physical: true, event });
        self.count += 1;
        self.over = event.is_some_and(|event| event.ends() || matches!(event, BranchEvent::Sticking { .. }));
    }

    /// Ends the branch with an event at the current point.
    fn finish(&mut self, event: BranchEvent) {
        if let Some(cycle) = self.excursion.cycle() {
            self.add(self.value, cycle, Some(event));
        }
        self.over = true;
    }

    /// Adds an event on the step to `target`; the branch continues at `target` unless the event ends it.
    fn happen(&mut self, found: FoundEvent, target: f64, there: Option<Excursion>) {
        let FoundEvent { value, event, cycle } = found;
        self.add(value, cycle, Some(event));
        if let (false, Some(there)) = (self.over, there) {
            (self.value, self.excursion) = (target, there);
        }
        if !matches!(event, BranchEvent::Grazing { appears: true, .. }) {
            return self.added.clear();
        }
        self.added.push(value);
        // the distances of these events shrink: the limit to which they tend is near
        if let [.., before, last] = self.added[..]
            && self.added.len() >= MANY
            && let Some(FoundEvent { value, event, cycle }) = self.other_rests(self.ahead(2.0 * (last - before).abs()))
        {
            self.add(value, cycle, Some(event));
        }
    }

    /// Takes one step, or ends the branch.
    fn advance(&mut self) {
        if self.count >= self.options.points {
            return self.finish(BranchEvent::StepLimit);
        }
        let narrow = NARROW * self.scale;
        loop {
            // exactly to the end of the range
            self.step.now = self.step.now.min((self.end - self.value).abs());
            let (target, there, alike) = self.look(self.step.now);
            if let (Likeness::Alike(unlike), Some(there)) = (&alike, &there)
                && let Some(cycle) = there.cycle()
            {
                (self.value, self.excursion) = (target, there.clone());
                self.add(target, cycle, (target == self.end).then_some(BranchEvent::EndOfRange));
                if *unlike < EASY {
                    self.step.grow(2.0);
                }
                return;
            }
            if self.step.now <= narrow {
                if let Some(found) = self.between(target, there.as_ref(), &alike) {
                    return self.happen(found, target, there);
                }
                // close to an event the motion changes fast, so the event is also looked for further ahead
                let (target, there, alike) = self.look(VERGE * self.step.now);
                if let Some(found) = self.between(target, there.as_ref(), &alike) {
                    return self.happen(found, target, there);
                }
                if self.step.now <= FINEST * (1.0 + self.value.abs()) {
                    return self.finish(BranchEvent::NoConvergence);
                }
            }
            self.step.halve();
        }
    }

    /// The motion at a distance from the current value, at most at the end of the range, and its comparison with the
    /// current motion.
    fn look(&self, by: f64) -> (f64, Option<Excursion>, Likeness) {
        let target = if by < (self.end - self.value).abs() { self.ahead(by) } else { self.end };
        let there = self.excursion_at(target);
        let alike = there.as_ref().map_or(Likeness::Rests, |there| likeness(&self.excursion, there));
        (target, there, alike)
    }
}

impl Iterator for RestBranch {
    type Item = SolutionPoint;

    fn next(&mut self) -> Option<SolutionPoint> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}

/// A cycle is the cycle of the release if the phase of its first impact differs by less than this.
const SAME: f64 = 1e-6;
/// A step that uses less than this fraction of the permitted change is followed by a step twice as long.
const EASY: f64 = 0.4;
/// An event is looked for only on steps shorter than this, in units of `scale`.
const NARROW: f64 = 1e-5;
/// If no event is found on a step, it is looked for up to this many steps ahead.
const VERGE: f64 = 64.0;
/// After this number of impacts that appeared one after another, the complete chatter to which they tend is looked for.
const MANY: usize = 8;
/// The smallest step, relative to the value.
const FINEST: f64 = 1e-15;
