//! Orbits followed along a line through numbers of a system, and the branches that begin at their events.

use crate::branch::{Followed, Origin};
use crate::dynamics::not_stopped;
use crate::machine::MachineSource;
use crate::{Control, Cut, FollowedEvent, PlanError, RunError, Stopped};
use core::fmt::Debug;
use core::ops::RangeInclusive;
use std::collections::VecDeque;
use vibroimpact::continuation::{self, Branch, BranchError, BranchEvent, BranchOptions, Direction, machine};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{self, Stability};
use vibroimpact::verdict::{Count, System};
use vibroimpact::{Label, Oscillator, ParameterPath};

/// A point of a branch of any system.
pub trait Solution: Clone + Debug {
    /// The system, which says what a cycle is.
    type System: System;

    /// The value of the number that varies.
    fn value(&self) -> f64;
    /// The cycle there.
    fn cycle(&self) -> &<Self::System as System>::Cycle;
    /// The event at this point; `None` for an ordinary point.
    fn event(&self) -> Option<BranchEvent>;
    /// Whether neighbours approach the cycle.
    fn stability(&self) -> Stability;

    /// Whether the cycle is a motion: a branch of a machine ends where its orbit ceases to be admissible, but solutions of the
    /// equations of an oscillator may pass through a stop.
    fn admissible(&self) -> bool {
        true
    }

    /// The name of the event at this point.
    fn event_name(&self) -> Option<&'static str> {
        self.event().map(|event| event.name())
    }

    /// Whether the branch ends here.
    fn ends(&self) -> bool {
        self.event().is_some_and(|event| event.ends())
    }

    /// Whether the branch is closed here.
    fn closes(&self) -> bool {
        self.event() == Some(BranchEvent::Closed)
    }

    /// Whether other branches begin here.
    fn begins_others(&self) -> bool {
        self.admissible() && matches!(self.event(), Some(BranchEvent::Flip | BranchEvent::BranchPoint))
    }

    /// Whether the event is of a kind that curves follow.
    fn is(&self, kind: FollowedEvent) -> bool {
        use BranchEvent as Event;
        self.event().is_some_and(|event| match kind {
            FollowedEvent::Fold => matches!(event, Event::Fold),
            FollowedEvent::Flip => matches!(event, Event::Flip),
            FollowedEvent::Torus => matches!(event, Event::Torus),
            FollowedEvent::Grazing => matches!(event, Event::Grazing { .. } | Event::LossOfContact { .. }),
            FollowedEvent::Corner => matches!(event, Event::Corner { .. }),
            FollowedEvent::Sticking => matches!(event, Event::Sticking { .. }),
            FollowedEvent::Holding => matches!(event, Event::Holding { .. }),
        })
    }

    /// The label of the cycle; at an event of the cycle before it.
    fn label(&self) -> Label {
        Self::System::label(self.cycle())
    }

    /// The label beyond the event at this point, if the event leads to another motion; `next` is the label of the next point.
    fn label_after(&self, next: impl FnOnce() -> Option<Label>) -> Option<Label> {
        match self.event()?.detail() {
            Some(detail) => detail.labels.1,
            None if self.ends() => None,
            None => next(),
        }
    }
}

impl Solution for continuation::SolutionPoint {
    type System = Oscillator;

    fn value(&self) -> f64 {
        self.value
    }

    fn cycle(&self) -> &orbit::Cycle {
        &self.cycle
    }

    fn event(&self) -> Option<BranchEvent> {
        self.event
    }

    fn stability(&self) -> Stability {
        self.cycle.stability()
    }

    fn admissible(&self) -> bool {
        self.physical
    }
}

impl Solution for machine::SolutionPoint {
    type System = Machine;

    fn value(&self) -> f64 {
        self.value
    }

    fn cycle(&self) -> &orbit::machine::Cycle {
        &self.cycle
    }

    fn event(&self) -> Option<BranchEvent> {
        self.event
    }

    fn stability(&self) -> Stability {
        self.cycle.stability()
    }
}

/// The systems along a line: an oscillator with the parameters that vary, or a family of machines.
#[allow(clippy::missing_errors_doc, reason = "they are those of the core")]
pub trait Along: Sized {
    /// A point of a branch.
    type Point: Solution;
    /// The points of a branch, one after another.
    type Branch: Iterator<Item = Self::Point>;

    /// The branch of a cycle at a value of the first number.
    fn branch(
        line: &OrbitLine<Self>,
        at: (f64, &CycleOn<Self>),
        direction: Direction,
    ) -> Result<Self::Branch, BranchError>;

    /// The branches that begin at the event at a point.
    fn leaving(line: &OrbitLine<Self>, point: &Self::Point) -> Result<Vec<Self::Branch>, BranchError>;
}

/// A cycle of the systems along a line.
pub(crate) type CycleOn<A> = <<<A as Along>::Point as Solution>::System as System>::Cycle;

impl Along for (Oscillator, ParameterPath) {
    type Point = continuation::SolutionPoint;
    type Branch = Branch;

    /// The oscillator is that of the cycle.
    fn branch(
        line: &OrbitLine<Self>,
        (_, cycle): (f64, &CycleOn<Self>),
        direction: Direction,
    ) -> Result<Branch, BranchError> {
        let (osc, path) = &line.along;
        Branch::new(osc, cycle, path.clone(), line.range.clone(), direction, line.options)
    }

    fn leaving(line: &OrbitLine<Self>, point: &Self::Point) -> Result<Vec<Branch>, BranchError> {
        let ((osc, path), range) = (&line.along, line.range.clone());
        if point.event == Some(BranchEvent::Flip) {
            return Ok(vec![Branch::from_flip(osc, point, path.clone(), range, line.options)?]);
        }
        Ok(Branch::from_branch_point(osc, point, path.clone(), range, line.options)?.into())
    }
}

impl Along for machine::Family {
    type Point = machine::SolutionPoint;
    type Branch = machine::Branch;

    fn branch(
        line: &OrbitLine<Self>,
        (value, cycle): (f64, &CycleOn<Self>),
        direction: Direction,
    ) -> Result<machine::Branch, BranchError> {
        machine::Branch::new((&line.along, value), cycle, &line.range, direction, line.options)
    }

    /// A cycle that ceases to exist at once has no branch.
    fn leaving(line: &OrbitLine<Self>, point: &Self::Point) -> Result<Vec<machine::Branch>, BranchError> {
        let found = point.leaving(&line.along, 0.25 * (line.range.end() - line.range.start()));
        let found = found.into_iter().filter(|(value, _)| line.range.contains(value));
        let branch = |(value, cycle): (f64, _)| {
            let away = if value > point.value { Direction::Up } else { Direction::Down };
            Self::branch(line, (value, &cycle), away).ok()
        };
        Ok(found.filter_map(branch).collect())
    }
}

/// A line through numbers of a system, along which its orbits are followed.
#[derive(Clone, Debug)]
pub struct OrbitLine<A> {
    pub(crate) along: A,
    pub(crate) range: RangeInclusive<f64>,
    pub(crate) options: BranchOptions,
}

/// The label and the value of the number at an event at which branches begin.
pub type BranchPlace = (String, f64);

/// The first event of a branch, if there is one, and the label beyond it unless the branch ends.
type FirstEvent<P> = Option<(P, Option<Label>)>;

/// Branches that begin on another one, and the events at which a branch was expected but could not be followed.
type Beginning<P> = (Vec<Followed<P>>, Vec<Origin<P>>);

/// Two values of the number are the same event if they differ by less than this, relative to the size of the range.
const SAME: f64 = 1e-7;
/// Two cycles closer than this are the same one.
const SAME_CYCLE: f64 = 1e-6;

impl OrbitLine<machine::Family> {
    /// A line through numbers of a machine, and the largest number of points of each branch.
    #[must_use]
    pub fn new(source: &MachineSource, cut: &Cut<String>, points: u32) -> Self {
        Self::over(cut.family(source), cut.ends, points)
    }
}

impl<A: Along> OrbitLine<A> {
    /// A line over a range, and the largest number of points of each branch.
    pub(crate) fn over(along: A, (from, to): (f64, f64), points: u32) -> Self {
        let options = BranchOptions { points, ..BranchOptions::default() };
        Self { along, range: from.min(to)..=from.max(to), options }
    }

    /// The points of a branch.
    fn points(branch: A::Branch, control: &Control<'_>) -> Result<Vec<A::Point>, Stopped> {
        let found: Vec<A::Point> = branch.take_while(|_| !control.stopping()).collect();
        not_stopped(control).map(|()| found)
    }

    /// The branch of a cycle at a value of the number in one direction.
    ///
    /// # Errors
    /// [`PlanError::Branch`] if the cycle cannot be followed, [`Stopped`] when stopped.
    pub fn trace(
        &self,
        at: (f64, &CycleOn<A>),
        direction: Direction,
        control: &Control<'_>,
    ) -> Result<Vec<A::Point>, RunError> {
        let branch = A::branch(self, at, direction).map_err(PlanError::from)?;
        Ok(Self::points(branch, control)?)
    }

    /// The points of the branch through a cycle, from its end downwards to its end upwards. A cycle that cannot be followed, as one
    /// without events, is no branch.
    pub(crate) fn both_ways(&self, at: (f64, &CycleOn<A>), control: &Control<'_>) -> Result<Vec<A::Point>, RunError> {
        let way = |direction| match self.trace(at, direction, control) {
            Err(RunError::Plan(_)) => Ok(Vec::new()),
            other => other,
        };
        let mut points = way(Direction::Down)?;
        if points.last().is_some_and(Solution::closes) {
            return Ok(points);
        }
        points.reverse();
        // both begin with the cycle itself
        points.extend(way(Direction::Up)?.into_iter().skip(usize::from(!points.is_empty())));
        // at an end of the range a branch has its first point twice
        points.dedup_by(|b, a| {
            let same = <A::Point as Solution>::System::same_cycle(a.cycle(), b.cycle(), SAME_CYCLE);
            a.value() == b.value() && a.event_name().is_some() && same
        });
        Ok(points)
    }

    /// The first event of the branch of a cycle at a value of the number in one direction, and the label beyond it unless the branch
    /// ends; `None` if there is none in the range.
    pub(crate) fn first_event(
        &self,
        at: (f64, &CycleOn<A>),
        direction: Direction,
        control: &Control<'_>,
    ) -> Result<FirstEvent<A::Point>, RunError> {
        let mut branch = A::branch(self, at, direction).map_err(PlanError::from)?;
        let event = branch.by_ref().take_while(|_| !control.stopping()).find(|point| point.event_name().is_some());
        not_stopped(control)?;
        let event = event.filter(|point| point.event() != Some(BranchEvent::EndOfRange));
        Ok(event.map(|point| {
            let after = point.label_after(|| branch.next().map(|next| next.label()));
            (point, after)
        }))
    }

    /// At most so many of the branches that begin at flips and branch points of a branch, and of these branches in turn. Events
    /// in `seen` are left out, and those that are passed are added to it. Also the events at which a branch was expected but could not be
    /// followed.
    ///
    /// # Errors
    /// [`Stopped`] when stopped.
    pub fn beginning_on(
        &self,
        points: &[A::Point],
        most: usize,
        seen: &mut Vec<BranchPlace>,
        control: &Control<'_>,
    ) -> Result<Beginning<A::Point>, RunError> {
        let close = SAME * (self.range.start().abs() + self.range.end().abs());
        let mut waiting: VecDeque<Origin<A::Point>> = origins(points, 0).collect();
        let (mut followed, mut lost) = (Vec::new(), Vec::new());
        while let (Some(begin), true) = (waiting.pop_front(), followed.len() < most) {
            let (label, at) = (begin.point.label().to_string(), begin.point.value());
            if seen.iter().any(|(of, value)| *of == label && (value - at).abs() <= close) {
                continue;
            }
            seen.push((label, at));
            let Ok(leaving) = A::leaving(self, &begin.point) else {
                lost.push(begin);
                continue;
            };
            for branch in leaving {
                if followed.len() >= most {
                    break;
                }
                let points = Self::points(branch, control)?;
                seen.extend(points.iter().filter_map(other_end));
                waiting.extend(origins(&points, followed.len() + 1));
                followed.push(Followed { origin: Some(begin.clone()), start: None, points });
            }
        }
        Ok((followed, lost))
    }
}

/// The points of branch number `branch` at which other branches begin.
fn origins<P: Solution>(points: &[P], branch: usize) -> impl Iterator<Item = Origin<P>> + '_ {
    let begins = points.iter().filter(|point| point.begins_others());
    begins.map(move |point| Origin { branch, point: point.clone() })
}

/// The flip at which a branch of twice the period ends. The branch that begins at this flip is already known.
fn other_end<P: Solution>(point: &P) -> Option<BranchPlace> {
    let label = point.label();
    let Count::Finite(impacts) = label.impacts else { return None };
    let half = Label { impacts: Count::Finite(impacts / 2), periods: label.periods / 2 };
    (point.event() == Some(BranchEvent::Halving)).then(|| (half.to_string(), point.value()))
}
