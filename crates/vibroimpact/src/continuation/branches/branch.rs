//! The branch of a cycle in one parameter, or along a line through two parameters, as an iterator over its points.

use super::impact_branch::ImpactBranch;
use super::options::{BranchError, BranchOptions, Direction, scale};
use super::point::SolutionPoint;
use super::resting::rest_branch::RestBranch;
use crate::continuation::event::BranchEvent;
use crate::orbit::{Cycle, DEFAULT_EVENTS, from_release};
use crate::system::{Oscillator, ParameterPath, Side, phase};
use core::ops::RangeInclusive;

/// A branch: an iterator over its points, including its events. The last point has an event that
/// [ends](crate::continuation::BranchEvent::ends) the branch.
///
/// ```
/// use vibroimpact::{Oscillator, Parameter, Label, orbit::{FindOptions, find}};
/// use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction};
/// // 1/beta = 1.11, eps = 0.5: as the gap grows 1/1 loses its stability to a motion of twice the period
/// let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5)?;
/// let orbit = find(&osc, Label::new(1, 1), FindOptions::default()).pop().expect("1/1 exists");
/// let (range, options) = (0.0..=4.0, BranchOptions::default());
/// let branch = Branch::new(&osc, &orbit.cycle, Parameter::Gap, range, Direction::Up, options).expect("it is a cycle");
/// let flip = branch.into_iter().find(|point| point.event == Some(BranchEvent::Flip)).expect("it flips");
/// assert!((flip.value - 1.829_006_189_683_6).abs() < 1e-12);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Branch {
    line: Line,
    method: Method,
    /// The last value that differed from the one before, and the number of points so far.
    last: f64,
    count: u32,
    /// The end of a branch that cannot go on.
    end: Option<SolutionPoint>,
}

/// An oscillator for each value of a parameter in a range, and how its branches are followed.
#[derive(Clone, Debug)]
struct Line {
    osc: Oscillator,
    varying: ParameterPath,
    range: RangeInclusive<f64>,
    options: BranchOptions,
}

/// The method by which a branch is followed.
#[derive(Clone, Debug)]
enum Method {
    /// The equations of the impacts of the cycle.
    Impacts(Box<ImpactBranch>),
    /// The release that determines the cycle.
    Release(Box<RestBranch>),
}

/// Where a rest begins or ends it takes no time, so the cycle beyond is looked for so far beyond, in the scale of the parameter.
const BEYOND: [f64; 4] = [1e-9, 1e-8, 1e-7, 1e-6];
/// The phases of the impacts of that cycle differ by less.
const NEAR: f64 = 1e-2;

impl Line {
    fn at(&self, value: f64) -> Option<Oscillator> {
        self.varying.set(&self.osc, value).ok()
    }

    /// The method for a cycle of the oscillator at a value.
    fn method(
        &self,
        (osc, cycle): (&Oscillator, &Cycle),
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Method, BranchError> {
        let (varying, range) = (self.varying.clone(), self.range.clone());
        Ok(if cycle.rests.is_empty() {
            let branch = ImpactBranch::of_cycle(osc, cycle, varying, range, direction, options)?;
            Method::Impacts(Box::new(branch))
        } else {
            Method::Release(Box::new(RestBranch::new(osc, cycle, varying, range, direction, options)?))
        })
    }

    /// The cycle near that at an event where a rest begins or ends, of an oscillator a little beyond.
    fn beside(&self, osc: &Oscillator, at: &SolutionPoint) -> Option<Cycle> {
        let of_release = |side: Side| from_release(osc, side, DEFAULT_EVENTS);
        let cycle = match at.event? {
            BranchEvent::Sticking { stop, begins: true, .. } => of_release(Side::at(stop))?,
            _ => {
                // without the rest that is over as it begins
                let held = |k: &usize| phase::difference(at.cycle.rests[*k].release, at.cycle.rests[*k].begin).abs();
                let over = (0..at.cycle.rests.len()).min_by(|a, b| held(a).total_cmp(&held(b)))?;
                let mut cycle = at.cycle.clone();
                cycle.rests.remove(over);
                match cycle.rests.last() {
                    Some(rest) => of_release(rest.side)?,
                    None => cycle,
                }
            }
        };
        alike(&cycle, &at.cycle).then_some(cycle)
    }
}

/// Whether two cycles have the same impacts, beginning with any. Of a chatter any number is listed, so the first half is compared.
fn alike(a: &Cycle, b: &Cycle) -> bool {
    let (m, n) = (a.points.len(), b.points.len());
    let chatters = |cycle: &Cycle| cycle.rests.iter().any(|rest| rest.chatter);
    let compared = if chatters(a) && chatters(b) { m.min(n).div_ceil(2) } else { m.max(n) };
    let same = |k: usize, shift: usize| {
        let (one, other) = (a.points[k % m].state, b.points[(k + shift) % n].state);
        one.side == other.side && phase::difference(one.phase, other.phase).abs() < NEAR
    };
    a.label == b.label && m > 0 && (0..n).any(|shift| (0..compared).all(|k| same(k, shift)))
}

impl Branch {
    /// The branch of `cycle`, a cycle of `osc`, in a [`Parameter`](crate::Parameter) over `range`, beginning in
    /// `direction`. On a line through two parameters, `range` is that of the first parameter.
    ///
    /// A cycle that sticks is followed by its release, any other cycle by the equations of its impacts. Where a chatter becomes
    /// complete, and where the mass begins or ceases to stick without a rebound, the branch goes on with the other method.
    ///
    /// # Errors
    /// [`BranchError`] if the branch cannot begin.
    pub fn new(
        osc: &Oscillator,
        cycle: &Cycle,
        varying: impl Into<ParameterPath>,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let line = Line { osc: *osc, varying: varying.into(), range, options };
        Ok(Self::along(line.method((osc, cycle), direction, options)?, line))
    }

    /// A branch of `osc` that begins with impacts.
    pub(super) fn of_impacts(
        branch: ImpactBranch,
        osc: &Oscillator,
        varying: ParameterPath,
        range: RangeInclusive<f64>,
        options: BranchOptions,
    ) -> Self {
        Self::along(Method::Impacts(Box::new(branch)), Line { osc: *osc, varying, range, options })
    }

    const fn along(method: Method, line: Line) -> Self {
        Self { line, method, last: f64::NAN, count: 0, end: None }
    }

    /// The method by which the branch goes on beyond a point at which the mass begins or ceases to stick.
    fn beyond(&self, at: &SolutionPoint) -> Option<Method> {
        let Line { range, options, .. } = &self.line;
        let direction = match &self.method {
            Method::Release(branch) => branch.direction,
            Method::Impacts(_) if at.value > self.last => Direction::Up,
            Method::Impacts(_) => Direction::Down,
        };
        let options = BranchOptions { points: options.points.saturating_sub(self.count), ..*options };
        let up = scale(range, at.value).ok()? * if direction == Direction::Up { 1.0 } else { -1.0 };
        BEYOND.into_iter().map(|by| at.value + by * up).filter(|value| range.contains(value)).find_map(|value| {
            let osc = self.line.at(value)?;
            let method = self.line.method((&osc, &self.line.beside(&osc, at)?), direction, options).ok()?;
            method.admissible().then_some(method)
        })
    }
}

impl Method {
    fn next(&mut self) -> Option<SolutionPoint> {
        match self {
            Self::Impacts(branch) => branch.next(),
            Self::Release(branch) => branch.next(),
        }
    }

    /// Whether the cycle with which it begins is admissible: that of a release always is.
    fn admissible(&self) -> bool {
        match self {
            Self::Impacts(branch) => branch.tracer.here.known.physical,
            Self::Release(_) => true,
        }
    }
}

impl Iterator for Branch {
    type Item = SolutionPoint;

    fn next(&mut self) -> Option<SolutionPoint> {
        if let Some(end) = self.end.take() {
            return Some(end);
        }
        let point = self.method.next()?;
        self.count += 1;
        if let Some(event @ BranchEvent::Sticking { .. }) = point.event {
            let leads_on = event.detail().is_some_and(|detail| detail.labels.1.is_some());
            // where a chatter ceases to be complete, the cycles beyond have infinitely many impacts
            let (next, end) = if leads_on {
                (self.beyond(&point), BranchEvent::NoConvergence)
            } else {
                (None, BranchEvent::ImpactLimit)
            };
            match next {
                Some(method) => self.method = method,
                None => self.end = Some(SolutionPoint { event: Some(end), ..point.clone() }),
            }
        }
        if point.value != self.last {
            self.last = point.value;
        }
        Some(point)
    }
}
