//! A branch of cycles that rest on a stop, by their release.
//!
//! What follows a release is one motion, so a cycle with a rest is a function of the parameter: nothing has to converge and
//! no fold can come. A step is taken when the impacts at its end are those at its beginning, moved a little; how many
//! of a chatter are listed before its sum does not count. Where no step is short enough, something happens: what is found
//! out in `rest_events`.

use super::super::impact_branch::{place, scale};
use super::super::options::{BranchError, BranchOptions, Direction};
use super::super::point::{BranchEvent, Change, SolutionPoint};
use super::likeness::{Likeness, likeness};
use crate::continuation::trace::step_length::StepLength;
use crate::orbit::{Cycle, DEFAULT_EVENTS, Excursion};
use crate::system::{Oscillator, ParameterPath, Side};
use core::ops::RangeInclusive;
use std::collections::VecDeque;

/// An event: where, what, and the cycle there.
pub(crate) struct FoundEvent {
    pub(crate) value: f64,
    pub(crate) event: BranchEvent,
    pub(crate) cycle: Cycle,
}

/// A branch of cycles with rests.
#[derive(Clone, Debug)]
pub(crate) struct RestBranch {
    osc: Oscillator,
    varying: ParameterPath,
    /// Stop whose release a cycle begins with.
    side: Side,
    pub(crate) direction: Direction,
    /// Where the range ends.
    end: f64,
    options: BranchOptions,
    /// A change of the parameter that counts as 1.
    scale: f64,
    step: StepLength,
    pub(crate) value: f64,
    pub(crate) excursion: Excursion,
    /// Values at which impact after impact appeared, the last ones.
    added: Vec<f64>,
    count: u32,
    pending: VecDeque<SolutionPoint>,
    over: bool,
}

impl RestBranch {
    /// That of `cycle`, a cycle of `osc` with a rest.
    pub(crate) fn new(
        osc: &Oscillator,
        cycle: &Cycle,
        varying: ParameterPath,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let value = place(osc, varying)?;
        let scale = scale(&range, value)?;
        let side = cycle.rests.last().map_or(Side::Upper, |rest| rest.side);
        let excursion = Excursion::new(osc, side, DEFAULT_EVENTS, f64::INFINITY).ok_or(BranchError::NoCycle)?;
        let found = excursion.cycle().ok_or(BranchError::NoCycle)?;
        // how many impacts of a chatter are listed may depend on who made the list
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

    /// The oscillator at a value of the parameter; `None` where there is none.
    pub(crate) fn at(&self, value: f64) -> Option<Oscillator> {
        self.varying.set(&self.osc, value).ok()
    }

    /// What follows the release there, for as many forcing periods as the cycle here takes and half of one more.
    pub(crate) fn excursion_at(&self, value: f64) -> Option<Excursion> {
        let periods = 0.5 + f64::from(self.excursion.periods.unwrap_or(1));
        Excursion::new(&self.at(value)?, self.side, DEFAULT_EVENTS, periods)
    }

    /// A value so far on from here.
    pub(crate) fn ahead(&self, by: f64) -> f64 {
        if self.direction == Direction::Up { self.value + by } else { self.value - by }
    }

    fn add(&mut self, value: f64, cycle: Cycle, event: Option<BranchEvent>) {
        self.pending.push_back(SolutionPoint { value, cycle, physical: true, event });
        self.count += 1;
        self.over = event.is_some_and(|event| event.ends());
    }

    /// An event at the present point.
    fn finish(&mut self, event: BranchEvent) {
        if let Some(cycle) = self.excursion.cycle() {
            self.add(self.value, cycle, Some(event));
        }
        self.over = true;
    }

    /// An event on the way to `target`, which the branch goes on from if there is more of it.
    fn happen(&mut self, found: FoundEvent, target: f64, there: Option<Excursion>) {
        let FoundEvent { value, event, cycle } = found;
        self.add(value, cycle, Some(event));
        if let (false, Some(there)) = (self.over, there) {
            (self.value, self.excursion) = (target, there);
        }
        if !matches!(event, BranchEvent::Grazing { change: Change::Appears, .. }) {
            return self.added.clear();
        }
        self.added.push(value);
        if let [.., before, last] = self.added[..]
            && self.added.len() >= MANY
            && let Some(FoundEvent { value, event, cycle }) = self.other_rests(self.ahead(2.0 * (last - before).abs()))
        {
            self.add(value, cycle, Some(event));
        }
    }

    /// One step on, or the end of the branch.
    fn advance(&mut self) {
        if self.count >= self.options.points {
            return self.finish(BranchEvent::StepLimit);
        }
        let narrow = NARROW * self.scale;
        loop {
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
                // on the verge of an event all changes fast, and it may lie a little further
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

    /// The motion so far on, or at the end of the range, and how it compares with the one here.
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

/// A cycle whose first impact is this near the one that the release leads to is that one.
const SAME: f64 = 1e-6;
/// A step that changes this share of what it may can be followed by one twice as long.
const EASY: f64 = 0.4;
/// In steps shorter than this an event is looked for.
const NARROW: f64 = 1e-5;
/// How many times further than a step an event is looked for.
const VERGE: f64 = 64.0;
/// So many impacts appear one after another before it is asked whether they go on to, towards a complete chatter.
const MANY: usize = 8;
/// No step is shorter, relative to the value.
const FINEST: f64 = 1e-15;
