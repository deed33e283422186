//! A branch by the equations of the impacts, step by step.
//!
//! The steps use [pseudo-arclength](crate::continuation) in the phases and speeds of all impacts and the parameter, so
//! a fold is passed like any other point. At a grazing event the signature changes, and the branch continues with one
//! impact more or less.

use super::options::{BranchError, BranchOptions, Direction};
use super::point::{BranchEvent, SolutionPoint};
use super::problem::{BranchProblem, BranchSolution, BranchTracer};
use crate::continuation::equations::cycle_equations::CycleEquations;
use crate::continuation::equations::test_functions::TestFunction;
use crate::continuation::trace::equations::tangent;
use crate::continuation::trace::step_length::StepLength;
use crate::continuation::trace::tracer::Tracer;
use crate::orbit::{Cycle, Ring, solve};
use crate::system::{Oscillator, ParameterPath, SystemError};
use core::ops::RangeInclusive;
use std::collections::VecDeque;

#[derive(Clone, Debug)]
pub(crate) struct ImpactBranch {
    pub(crate) options: BranchOptions,
    pub(crate) tracer: BranchTracer,
    /// The first solution of the branch, as long as the signature has not changed.
    begin: Option<BranchSolution>,
    /// The grazing events so far. When one occurs a second time, the branch is closed.
    pub(crate) grazed: Vec<(f64, BranchEvent)>,
    count: u32,
    pending: VecDeque<SolutionPoint>,
    pub(crate) over: bool,
}

impl ImpactBranch {
    /// The branch of `cycle`, a cycle of `osc` that does not stick, in `varying` over `range`, beginning in
    /// `direction`.
    pub(crate) fn new(
        osc: &Oscillator,
        cycle: &Cycle,
        varying: ParameterPath,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let value = place(osc, varying)?;
        let ring = Ring::of(osc, cycle).ok_or(BranchError::Rests)?;
        if ring.len() == 0 && osc.damping() == 0.0 {
            return Err(BranchError::Undamped);
        }
        let (ring, _) = solve(osc, ring).ok_or(BranchError::NoCycle)?;
        let equations = Self::equations(osc, varying, &range, value, &ring)?;
        let w = CycleEquations::join(&ring, value);
        let mut row = equations.parameter_row();
        if direction == Direction::Down {
            row.iter_mut().for_each(|r| *r = -*r);
        }
        let along = tangent(&equations, &w, &row).ok_or(BranchError::NoCycle)?;
        Self::begin(equations, w, along, (*range.start(), *range.end()), options).ok_or(BranchError::NoCycle)
    }

    pub(crate) fn equations(
        osc: &Oscillator,
        varying: ParameterPath,
        range: &RangeInclusive<f64>,
        value: f64,
        ring: &Ring,
    ) -> Result<CycleEquations, BranchError> {
        Ok(CycleEquations::new(osc, varying, ring, scale(range, value)?))
    }

    /// The branch from a solution `w` along the tangent `along`.
    pub(crate) fn begin(
        equations: CycleEquations,
        w: Vec<f64>,
        along: Vec<f64>,
        range: (f64, f64),
        options: BranchOptions,
    ) -> Option<Self> {
        let tracer = trace(equations, w, along, range, options)?;
        let first = point(&tracer.here, None);
        let begin = Some(tracer.here.clone());
        let pending = VecDeque::from([first]);
        Some(Self { options, tracer, begin, grazed: Vec::new(), count: 0, pending, over: false })
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
        let Some(mut tracer) = trace(equations, w, along, self.tracer.problem.range, self.options) else {
            return false;
        };
        // at the event itself rounding can make the solution inadmissible
        tracer.here.known.physical = true;
        for (known, test) in tracer.signs.iter_mut().zip(&tracer.problem.tests) {
            if positive.contains(test) {
                *known = Some(true);
            }
        }
        (self.tracer, self.begin) = (tracer, None);
        true
    }

    /// Adds a point to the branch.
    pub(crate) fn add(&mut self, point: SolutionPoint) {
        self.pending.push_back(point);
        self.count += 1;
    }

    /// Adds an event. An event at which the cycle becomes inadmissible counts as admissible.
    pub(crate) fn emit(&mut self, at: &BranchSolution, event: BranchEvent) {
        let mut point = point(at, Some(event));
        point.physical |= self.tracer.here.known.physical || event == BranchEvent::BecomesPhysical;
        self.add(point);
    }

    /// Adds an event that ends the branch.
    pub(crate) fn end(&mut self, at: &BranchSolution, event: BranchEvent) {
        self.emit(at, event);
        self.over = true;
    }

    /// Ends the branch at the current point or, if impacts appear one after another there, at the limit of these
    /// events.
    pub(crate) fn finish(&mut self, event: BranchEvent) {
        let stuck = matches!(event, BranchEvent::NoConvergence | BranchEvent::ImpactLimit);
        match stuck.then(|| self.accumulation()).flatten() {
            Some(limit) => self.add(limit),
            None => self.emit(&self.tracer.here.clone(), event),
        }
        self.over = true;
    }

    /// Takes one step, or ends the branch.
    fn advance(&mut self) {
        if self.count >= self.options.points {
            return self.finish(BranchEvent::StepLimit);
        }
        match self.tracer.step() {
            Some(step) => self.go_through(step),
            None => self.finish(BranchEvent::NoConvergence),
        }
    }

    /// Makes `there` the current point.
    pub(crate) fn take(&mut self, there: BranchSolution) {
        let closed = self.count > 3 && self.begin.as_ref().is_some_and(|begin| self.tracer.closes(begin, &there));
        self.add(point(&there, closed.then_some(BranchEvent::Closed)));
        self.tracer.take(there);
        self.over = closed;
    }
}

impl Iterator for ImpactBranch {
    type Item = SolutionPoint;

    fn next(&mut self) -> Option<SolutionPoint> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
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
    let step = StepLength { now: options.first, longest: options.longest, shortest: options.shortest };
    Tracer::new(BranchProblem { equations, tests, range }, w, along, step)
}

/// The point of the branch at a solution.
pub(crate) fn point(at: &BranchSolution, event: Option<BranchEvent>) -> SolutionPoint {
    SolutionPoint { value: value(&at.w), cycle: at.known.cycle.clone(), physical: at.known.physical, event }
}

/// The value of the parameter, the last unknown.
pub(crate) fn value(w: &[f64]) -> f64 {
    w.last().copied().unwrap_or(f64::NAN)
}

/// The value of the parameter, or the place on the line through two parameters, that belongs to an oscillator.
pub(crate) fn place(osc: &Oscillator, varying: ParameterPath) -> Result<f64, BranchError> {
    varying.get(osc).map_err(|error| match error {
        SystemError::NoSecondStop(name) => BranchError::NoSuchParameter(name),
        _ => BranchError::NoCycle,
    })
}

/// The change of the parameter that has the same length as a change of all phases by one radian: a quarter of the
/// range. An error if the range is invalid or does not contain `value`.
pub(crate) fn scale(range: &RangeInclusive<f64>, value: f64) -> Result<f64, BranchError> {
    let (low, high) = (*range.start(), *range.end());
    if !(low.is_finite() && high.is_finite() && low < high && range.contains(&value)) {
        return Err(BranchError::OutOfRange { value, low, high });
    }
    Ok(0.25 * (high - low))
}
