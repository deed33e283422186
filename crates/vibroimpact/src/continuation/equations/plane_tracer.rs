//! Tracing curves in a plane of parameters: the equations with one condition, and other conditions as test functions.

use super::plane_equations::{Condition, Plane};
use crate::continuation::trace::equations::{Equations, correct, tangent, unit};
use crate::continuation::trace::step_length::StepLength;
use crate::continuation::trace::tracer::{Problem, Solution, StepRules, Tracer};

/// The equations of a curve, and the test functions whose zeros on it are located.
#[derive(Clone, Debug)]
pub(crate) struct PlaneProblem {
    pub(crate) plane: Plane,
    pub(crate) watched: Vec<Condition>,
}

/// The tracer of a curve in the plane.
pub(crate) type PlaneTracer = Tracer<PlaneProblem>;

/// A solution on such a curve.
pub(crate) type PlaneSolution = Solution<()>;

impl PlaneTracer {
    /// Begins at a solution `w` of the equations of `plane`, in the direction of the tangent whose product with `row`
    /// is positive.
    pub(crate) fn along(
        mut plane: Plane,
        watched: Vec<Condition>,
        w: Vec<f64>,
        row: &[f64],
        longest: f64,
    ) -> Option<Self> {
        plane.weigh(&w);
        let along = tangent(&plane, &w, row)?;
        Self::new(PlaneProblem { plane, watched }, w, along, first_step(longest))
    }
}

/// Where a curve through the solution near `w` begins, on the curve itself, and the row that gives its direction: that in
/// which one of both numbers, the last unknowns, increases (`way` 1) or decreases (-1).
pub(crate) fn beginning<E: Equations>(equations: &E, w: &[f64], way: f64) -> Option<(Vec<f64>, Vec<f64>)> {
    let row = |at: usize| unit(w.len(), at, way);
    // a number that changes only by rounding determines no direction
    let usable = |least: f64| {
        let pace = |at: usize| Some(equations.weights()[at].sqrt() * tangent(equations, w, &row(at))?[at].abs());
        let changes = |at: &usize| pace(*at).is_some_and(|pace| pace > least && pace.is_finite());
        [w.len() - 2, w.len() - 1].into_iter().find(changes)
    };
    let row = row(usable(SLOWEST).or_else(|| usable(0.0))?);
    // onto the curve, perpendicular to its direction
    let fix = equations.row(&tangent(equations, w, &row)?);
    let level = fix.iter().zip(w).map(|(r, w)| r * w).sum();
    let (w, _) = correct(equations, w, &fix, level)?;
    Some((w, row))
}

/// A number that changes by less than this along a curve, in quarters of its range over the arclength, changes by
/// rounding.
const SLOWEST: f64 = 1e-9;

/// The length of the first step of a curve whose steps have at most this length.
pub(crate) fn first_step(longest: f64) -> StepLength {
    StepLength { now: (0.1 * longest).min(FIRST), longest, shortest: SHORTEST }
}

/// The rules for steps along curves in a plane.
pub(crate) const PLANE_RULES: StepRules = StepRules {
    stray: 0.2,
    rounding: 0.0,
    bend: 0.98,
    straight: 0.998,
    few: 4,
    many: u32::MAX,
    zero: 1e-9,
    beside: 0.0,
};

impl Problem for PlaneProblem {
    type Known = ();
    type Equations = Plane;

    fn equations(&self) -> &Plane {
        &self.plane
    }

    fn rules(&self) -> StepRules {
        PLANE_RULES
    }

    fn tests(&self) -> usize {
        self.watched.len()
    }

    fn look(&self, w: &[f64], _tangent: &[f64]) -> Option<(Vec<f64>, ())> {
        let values: Option<_> = self.watched.iter().map(|&condition| self.plane.value(condition, w)).collect();
        Some((values?, ()))
    }

    fn test(&self, j: usize, w: &[f64], _tangent: impl Fn() -> Option<Vec<f64>>) -> Option<f64> {
        self.plane.value(self.watched[j], w)
    }

    fn resolution(&self, _j: usize) -> f64 {
        RESOLUTION
    }

    fn phases(&self) -> usize {
        self.plane.weights().len() - 2
    }

    fn weigh(&mut self, w: &[f64]) -> bool {
        self.plane.weigh(w);
        self.plane.relative
    }
}

/// The resolution to which zeros of test functions are located along the step.
const RESOLUTION: f64 = 1e-14;
/// The largest length of the first step.
const FIRST: f64 = 1e-3;
/// The smallest length of a step.
const SHORTEST: f64 = 1e-10;
