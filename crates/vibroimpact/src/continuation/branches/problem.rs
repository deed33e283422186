//! The problem that the tracer solves along a branch: the equations of the impacts, and test functions.

use super::free::hides;
use crate::continuation::equations::cycle_equations::CycleEquations;
use crate::continuation::equations::test_functions::{Place, TestFunction};
use crate::continuation::trace::tracer::{Problem, Solution, StepRules, Tracer};
use crate::orbit::{Orbit, ring_cycle};

/// The equations of a cycle with one free parameter, and the test functions of its events.
#[derive(Clone, Debug)]
pub(crate) struct BranchProblem {
    pub(crate) equations: CycleEquations,
    pub(crate) tests: Vec<TestFunction>,
    /// The range of the parameter.
    pub(crate) range: (f64, f64),
}

/// The tracer of a branch.
pub(crate) type BranchTracer = Tracer<BranchProblem>;

/// A solution on a branch, with its cycle and whether it is admissible.
pub(crate) type BranchSolution = Solution<Orbit>;

impl Problem for BranchProblem {
    type Known = Orbit;
    type Equations = CycleEquations;

    fn equations(&self) -> &CycleEquations {
        &self.equations
    }

    fn rules(&self) -> StepRules {
        RULES
    }

    fn tests(&self) -> usize {
        self.tests.len()
    }

    fn look(&self, w: &[f64], tangent: &[f64]) -> Option<(Vec<f64>, Orbit)> {
        let (osc, ring, flights) = self.equations.flights(w)?;
        let place = Place { osc: &osc, ring: &ring, flights: &flights };
        let values = self.tests.iter().map(|test| test.value(&self.equations, tangent, &place)).collect();
        Some((values, Orbit::judged(&osc, ring_cycle(&osc, &ring, &flights))))
    }

    fn test(&self, j: usize, w: &[f64], tangent: impl Fn() -> Option<Vec<f64>>) -> Option<f64> {
        let along = if self.tests[j] == TestFunction::Pace { tangent()? } else { Vec::new() };
        let (osc, ring, flights) = self.equations.flights(w)?;
        Some(self.tests[j].value(&self.equations, &along, &Place { osc: &osc, ring: &ring, flights: &flights }))
    }

    fn resolution(&self, j: usize) -> f64 {
        // folds and branch points are located more precisely later
        if self.tests[j].critical() { COARSE } else { RESOLUTION }
    }

    fn phases(&self) -> usize {
        2 * self.equations.impacts()
    }

    fn range(&self) -> Option<(f64, f64)> {
        Some(self.range)
    }

    /// A step must not pass the end of admissibility unnoticed: neither an inadmissible solution without an event
    /// before it nor, without impacts, a resonance between two frequencies at which the mass clears the stops.
    fn admits(&self, here: &BranchSolution, there: &BranchSolution, crossed: &[usize]) -> bool {
        // nothing that is watched tells why it has become inadmissible: the step is too long
        if here.known.physical && !there.known.physical && !crossed.iter().any(|&j| self.tests[j].needed()) {
            return false;
        }
        if self.equations.impacts() > 0 || !there.known.physical {
            return true;
        }
        match (self.equations.split(&here.w), self.equations.split(&there.w)) {
            (Some((from, _)), Some((to, _))) => !hides(&from, &to),
            _ => false,
        }
    }
}

/// When a step along a branch is accepted, of an oscillator or of a machine.
pub(crate) const RULES: StepRules = StepRules {
    stray: 0.3,
    rounding: 1e-9,
    bend: 0.95,
    straight: 0.995,
    few: 3,
    many: 5,
    zero: 1e-11,
    // at a branch point itself Newton's method does not converge
    beside: COARSE,
};
/// The resolution to which events are located along the step.
pub(crate) const RESOLUTION: f64 = 1e-15;
/// The resolution to which folds and branch points are located at first.
pub(crate) const COARSE: f64 = 3e-5;
