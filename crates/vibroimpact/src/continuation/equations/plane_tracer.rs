//! Curves in a plane of parameters: the equations with one condition, traced, and other conditions watched on the way.

use super::plane_equations::{Condition, Plane};
use crate::continuation::trace::equations::{Equations, tangent};
use crate::continuation::trace::step_length::StepLength;
use crate::continuation::trace::tracer::{Problem, Solution, StepRules, Tracer};

/// The equations of a curve, and the conditions whose zeros on it are looked for.
#[derive(Clone, Debug)]
pub(crate) struct PlaneProblem {
    pub(crate) plane: Plane,
    pub(crate) watched: Vec<Condition>,
}

/// A trace of a curve in the plane.
pub(crate) type PlaneTracer = Tracer<PlaneProblem>;

/// A solution on such a curve.
pub(crate) type PlaneSolution = Solution<()>;

impl PlaneTracer {
    /// From a solution `w` of the plane's equations along the side of the curve that `row` is positive on.
    pub(crate) fn along(
        mut plane: Plane,
        watched: Vec<Condition>,
        w: Vec<f64>,
        row: &[f64],
        longest: f64,
    ) -> Option<Self> {
        plane.weigh(&w);
        let along = tangent(&plane, &w, row)?;
        let step = StepLength { now: (0.1 * longest).min(FIRST), longest, shortest: SHORTEST };
        Self::new(PlaneProblem { plane, watched }, w, along, step)
    }
}

impl Equations for PlaneProblem {
    fn weights(&self) -> &[f64] {
        self.plane.weights()
    }

    fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        self.plane.at(w)
    }
}

impl Problem for PlaneProblem {
    type Known = ();

    fn rules(&self) -> StepRules {
        StepRules {
            stray: 0.2,
            rounding: 0.0,
            bend: 0.98,
            straight: 0.998,
            few: 4,
            many: u32::MAX,
            zero: 1e-9,
            beside: 0.0,
        }
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

/// Crossings are located to this along the step.
const RESOLUTION: f64 = 1e-14;
/// The first step, at most.
const FIRST: f64 = 1e-3;
/// Steps never become shorter.
const SHORTEST: f64 = 1e-10;
