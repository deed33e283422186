//! A branch by the equations of the impacts, step by step.
//!
//! The steps use [pseudo-arclength](crate::continuation) in the phases and speeds of all impacts and the parameter, so
//! a fold is passed like any other point. At a grazing event the signature changes, and the branch continues with one
//! impact more or less.

use super::options::{BranchError, BranchOptions, Direction, scale};
use super::point::SolutionPoint;
use super::problem::{BranchProblem, BranchSolution, BranchTracer};
use crate::continuation::equations::cycle_equations::CycleEquations;
use crate::continuation::equations::test_functions::TestFunction;
use crate::continuation::event::BranchEvent;
use crate::continuation::trace::driver::{Driver, Path, PathEvent};
use crate::continuation::trace::equations::{tangent, unit};
use crate::continuation::trace::tracer::{Step, Tracer, last};
use crate::orbit::{Cycle, Orbit, Ring, solve};
use crate::system::{Oscillator, ParameterPath, SystemError};
use core::ops::RangeInclusive;

/// What a branch keeps beside its tracer.
#[derive(Clone, Debug)]
pub(crate) struct ImpactPath {
    pub(crate) options: BranchOptions,
    /// The grazing events so far. When one occurs a second time, the branch is closed.
    pub(crate) grazed: Vec<(f64, BranchEvent)>,
}

pub(crate) type ImpactBranch = Driver<ImpactPath>;

impl PathEvent for BranchEvent {
    const CLOSED: Self = Self::Closed;
    const STEP_LIMIT: Self = Self::StepLimit;
    const NO_CONVERGENCE: Self = Self::NoConvergence;
}

impl Path for ImpactPath {
    type Problem = BranchProblem;
    type Event = BranchEvent;
    type Point = SolutionPoint;

    const EXACT: bool = false;

    /// An event at which the cycle becomes inadmissible counts as admissible.
    fn point(branch: &ImpactBranch, at: &BranchSolution, event: Option<BranchEvent>) -> Option<SolutionPoint> {
        let here = branch.tracer.here.known.physical;
        let limit = |event| here || event == BranchEvent::BecomesPhysical;
        let physical = at.known.physical || event.is_some_and(limit);
        Some(SolutionPoint { value: last(&at.w), cycle: at.known.cycle.clone(), physical, event })
    }

    fn go_through(branch: &mut ImpactBranch, step: Step<Orbit>) {
        branch.go_through(step);
    }

    /// If impacts appear one after another, the limit of these events.
    fn limit(branch: &ImpactBranch, event: BranchEvent) -> Option<SolutionPoint> {
        let fails = matches!(event, BranchEvent::NoConvergence | BranchEvent::ImpactLimit);
        fails.then(|| branch.accumulation()).flatten()
    }
}

impl ImpactBranch {
    /// The branch of `cycle`, a cycle of `osc` that does not stick, in `varying` over `range`, beginning in
    /// `direction`.
    pub(crate) fn of_cycle(
        osc: &Oscillator,
        cycle: &Cycle,
        varying: ParameterPath,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let value = place(osc, &varying)?;
        let ring = Ring::of(osc, cycle).ok_or(BranchError::Rests)?;
        // it is one of a continuum of motions, and the equations of a cycle need an isolated one
        if ring.len() == 0 && osc.damping() == 0.0 {
            return Err(BranchError::Undamped);
        }
        // the given cycle may have fewer digits than the tracer needs
        let (ring, _) = solve(osc, ring).ok_or(BranchError::NoCycle)?;
        let equations = CycleEquations::new(osc, varying, &ring, scale(&range, value)?);
        let w = CycleEquations::join(&ring, value);
        // of both directions of the tangent the one in which the parameter changes so
        let row = unit(w.len(), w.len() - 1, if direction == Direction::Up { 1.0 } else { -1.0 });
        let along = tangent(&equations, &w, &row).ok_or(BranchError::NoCycle)?;
        Self::begin(equations, w, along, &range, options)
    }

    /// The branch from a solution `w` along the tangent `along`.
    pub(crate) fn begin(
        equations: CycleEquations,
        w: Vec<f64>,
        along: Vec<f64>,
        range: &RangeInclusive<f64>,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let tracer = trace(equations, w, along, (*range.start(), *range.end()), options);
        let path = ImpactPath { options, grazed: Vec::new() };
        tracer.and_then(|tracer| Self::new(path, tracer, options.points)).ok_or(BranchError::NoCycle)
    }

    /// The equations that are followed at present.
    pub(crate) const fn cycles(&self) -> &CycleEquations {
        &self.tracer.problem.equations
    }

    /// Continues with other equations, from a solution `w` along the tangent `along`, on the part on which the test
    /// functions in `positive` are positive. Returns false if a test function has no value.
    pub(crate) fn go_on(
        &mut self,
        equations: CycleEquations,
        w: Vec<f64>,
        along: Vec<f64>,
        positive: &[TestFunction],
    ) -> bool {
        let Some(mut tracer) = trace(equations, w, along, self.tracer.problem.range, self.path.options) else {
            return false;
        };
        // at the event itself rounding can make the solution inadmissible
        tracer.here.known.physical = true;
        // at the event itself they are zero within rounding, so that their signs have to be told
        for (known, test) in tracer.signs.iter_mut().zip(&tracer.problem.tests) {
            if positive.contains(test) {
                *known = Some(true);
            }
        }
        self.exchange(tracer);
        true
    }
}

/// The tracer of these equations, with the test functions of their signature.
fn trace(
    equations: CycleEquations,
    w: Vec<f64>,
    along: Vec<f64>,
    range: (f64, f64),
    options: BranchOptions,
) -> Option<BranchTracer> {
    let (osc, ring) = equations.split(&w)?;
    let tests = TestFunction::all(&osc, &ring);
    Tracer::new(BranchProblem { equations, tests, range }, w, along, options.first_step())
}

/// The value of the parameter, or the place on the line through two parameters, that belongs to an oscillator.
pub(crate) fn place(osc: &Oscillator, varying: &ParameterPath) -> Result<f64, BranchError> {
    varying.get(osc).map_err(|error| match error {
        SystemError::NoSecondStop(name) => BranchError::NoSuchParameter(name),
        _ => BranchError::NoCycle,
    })
}
