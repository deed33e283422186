//! Branches of machines: of a machine that is an oscillator those of the oscillator, in the numbers of the machine.
//!
//! The oscillator is a function of the number that varies, and its branch has the same values, multipliers and events.
//! Where it ends and the machine goes on, as where a rest begins, or where the machine ceases to be an oscillator, the machine's
//! own equations continue from the last cycle.

use super::branches::{Family, SolutionPoint, UnreducedBranch};
use crate::continuation::branches;
use crate::continuation::branches::{BranchError, BranchOptions, Direction};
use crate::continuation::event::BranchEvent;
use crate::machine::Reduction;
use crate::orbit;
use crate::orbit::machine::Cycle;
use crate::system::{Oscillator, OscillatorFamily, Side, SystemError};
use core::ops::RangeInclusive;

/// A branch: an iterator over its points, including its events. The last point has an event that
/// [ends](BranchEvent::ends) the branch.
#[derive(Clone, Debug)]
pub struct Branch(Method);

#[derive(Clone, Debug)]
enum Method {
    Reduced(Box<ReducedBranch>),
    Unreduced(Box<UnreducedBranch>),
}

impl Branch {
    /// The branch of `cycle`, a cycle of the machine of `family` at `value`, over `range`, beginning in `direction`. In the
    /// options, the largest number of impacts is that of the branch of an oscillator; further impacts are followed by the
    /// equations of the machine.
    ///
    /// # Errors
    /// [`BranchError`] if the branch cannot begin.
    pub fn new(
        (family, value): (&Family, f64),
        cycle: &Cycle,
        range: &RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        match ReducedBranch::new((family, value), cycle, range, direction, options) {
            Some(branch) => Ok(Self(Method::Reduced(Box::new(branch)))),
            None => Self::unreduced((family, value), cycle, range, direction, options),
        }
    }

    /// The same, with a machine that is an oscillator followed as any other.
    ///
    /// # Errors
    /// [`BranchError`] if the branch cannot begin.
    pub fn unreduced(
        at: (&Family, f64),
        cycle: &Cycle,
        range: &RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        UnreducedBranch::new(at, cycle, range, direction, options)
            .map(|branch| Self(Method::Unreduced(Box::new(branch))))
    }
}

impl Iterator for Branch {
    type Item = SolutionPoint;

    fn next(&mut self) -> Option<SolutionPoint> {
        let branch = match &mut self.0 {
            Method::Unreduced(branch) => return branch.next(),
            Method::Reduced(branch) => branch,
        };
        match branch.step() {
            Step::Point(point) => Some(*point),
            Step::Over => None,
            Step::Beyond => match branch.beyond() {
                Some(further) => {
                    self.0 = Method::Unreduced(Box::new(further));
                    self.next()
                }
                None => branch.no_convergence(),
            },
        }
    }
}

/// The branch of the oscillator that a machine is.
#[derive(Clone, Debug)]
struct ReducedBranch {
    branch: branches::Branch,
    family: Family,
    range: RangeInclusive<f64>,
    options: BranchOptions,
    stops: usize,
    /// The value and the cycle at the last point without an event, and the direction in which the number changed to it.
    last: (f64, orbit::Cycle),
    direction: Direction,
    count: u32,
    over: bool,
}

/// What comes next on a branch.
enum Step {
    Point(Box<SolutionPoint>),
    /// The branch has ended.
    Over,
    /// That of the oscillator has ended, and the machine may go on.
    Beyond,
}

/// Parts of a range at whose ends the machine must be an oscillator.
const PARTS: u32 = 4;

/// The oscillator of a family of machines; an error where the machine is none.
pub(super) fn oscillator<const N: usize>(family: &Family<N>, values: [f64; N]) -> Result<Oscillator, SystemError> {
    let reduction = family.reduction(values).ok_or(SystemError::NoOscillator(values[0]))?;
    Ok(reduction.oscillator)
}

impl ReducedBranch {
    /// `None` if the machine is no oscillator somewhere in the range, if the cycle rests, or if it cannot be followed.
    fn new(
        (family, value): (&Family, f64),
        cycle: &Cycle,
        range: &RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Option<Self> {
        let reduction = family.reduction([value])?;
        let width = range.end() - range.start();
        // a check at a few values: where the machine is none in between, the branch of the oscillator ends there
        let at = |k: u32| range.start() + width * f64::from(k) / f64::from(PARTS);
        let same = |k: u32| family.reduction([at(k)]).is_some_and(|other| other.same_sides(&reduction));
        if !(0..=PARTS).all(same) {
            return None;
        }
        let along = family.clone();
        let path = OscillatorFamily::new(move |values| oscillator(&along, values), [value]);
        let followed = BranchOptions { keep_signature: false, ..options };
        let (osc, reduced) = (&reduction.oscillator, cycle.to_oscillator(&reduction)?);
        let branch = branches::Branch::new(osc, &reduced, path, range.clone(), direction, followed).ok()?;
        let last = (value, reduced);
        Some(Self {
            branch,
            family: family.clone(),
            range: range.clone(),
            options,
            stops: cycle.counts.len(),
            last,
            direction,
            count: 0,
            over: false,
        })
    }

    fn step(&mut self) -> Step {
        if self.over {
            return Step::Over;
        }
        let Some(of_oscillator) = self.branch.next() else { return Step::Beyond };
        let Some(mut point) = self.converted(&of_oscillator) else { return Step::Beyond };
        self.count += 1;
        // unless the branch ends here anyway, the last of the points asked for says that it was cut off
        if self.count >= self.options.points && !point.event.is_some_and(|event| event.ends()) {
            point.event = Some(BranchEvent::StepLimit);
        }
        self.over = point.event.is_some_and(|event| event.ends());
        if point.event.is_none() {
            if point.value != self.last.0 {
                self.direction = if point.value > self.last.0 { Direction::Up } else { Direction::Down };
            }
            self.last = (of_oscillator.value, of_oscillator.cycle);
        }
        Step::Point(Box::new(point))
    }

    /// A point in the numbers of the machine; `None` at an end that is none of the branch of the machine.
    fn converted(&self, point: &branches::SolutionPoint) -> Option<SolutionPoint> {
        if !point.physical {
            return None;
        }
        let reduction = self.family.reduction([point.value])?;
        let event = match point.event {
            Some(event) => Some(converted(event, &reduction)?),
            None => None,
        };
        let cycle = Cycle::of_oscillator(&reduction, self.stops, &point.cycle)?;
        Some(SolutionPoint { value: point.value, cycle, event, ring: None })
    }

    /// The branch of the machine from the last point on.
    fn beyond(&self) -> Option<UnreducedBranch> {
        let points = self.options.points.checked_sub(self.count)?;
        // one more, for the point that is passed over
        let options = BranchOptions { points: points + 1, ..self.options };
        let (value, cycle) = self.here()?;
        let mut further =
            UnreducedBranch::new((&self.family, value), &cycle, &self.range, self.direction, options).ok()?;
        // the first point is the last one
        further.next()?;
        Some(further)
    }

    /// The last point without an event.
    fn here(&self) -> Option<(f64, Cycle)> {
        let reduction = self.family.reduction([self.last.0])?;
        Some((self.last.0, Cycle::of_oscillator(&reduction, self.stops, &self.last.1)?))
    }

    /// The end where the machine does not go on.
    fn no_convergence(&mut self) -> Option<SolutionPoint> {
        self.over = true;
        let (value, cycle) = self.here()?;
        Some(SolutionPoint { value, cycle, event: Some(BranchEvent::NoConvergence), ring: None })
    }
}

/// The event of a branch of the machine; `None` for an end that is none of the machine's.
fn converted(event: BranchEvent, reduction: &Reduction) -> Option<BranchEvent> {
    let own = |stop: usize| reduction.stop(Side::at(stop));
    Some(match event {
        BranchEvent::Grazing { stop, also, appears, turns, .. } => {
            BranchEvent::Grazing { stop: own(stop)?, also: also.and_then(own), appears, turns, detail: None }
        }
        BranchEvent::LossOfContact { stop, .. } => BranchEvent::LossOfContact { stop: own(stop)?, detail: None },
        // the machine goes on where its oscillator rests, or has more impacts than are followed
        BranchEvent::Sticking { .. }
        | BranchEvent::SoftLanding { .. }
        | BranchEvent::RestForEver { .. }
        | BranchEvent::BecomesPhysical
        | BranchEvent::BecomesVirtual
        | BranchEvent::ImpactLimit
        | BranchEvent::NoConvergence => return None,
        event => event,
    })
}
