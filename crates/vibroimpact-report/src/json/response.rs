//! The response over a parameter: the motions of two sweeps, and the branches on which they lie.

use super::{Document, Place};
use crate::{Asked, Units};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::quantities::{Quantities, Quantity};
use vibroimpact_study::{Plan, ResponseBranch, ResponseCurves, ResponsePlan, SweptMotion};

/// The answer to `vibro response`.
#[derive(JsonSchema, Serialize)]
pub(super) struct ResponseAnswer {
    vary: &'static str,
    over: Place,
    quantity: &'static str,
    sweeps: [SweepObject; 2],
    branches: Vec<BranchObject>,
}

#[derive(JsonSchema, Serialize)]
struct SweepObject {
    direction: &'static str,
    points: Vec<SweptObject>,
}

/// A motion of a sweep.
#[derive(JsonSchema, Serialize)]
struct SweptObject {
    parameter: f64,
    label: String,
    /// The quantity; none where it is not defined.
    value: f64,
}

#[derive(JsonSchema, Serialize)]
struct BranchObject {
    points: Vec<PointObject>,
}

/// A point of a branch.
#[derive(JsonSchema, Serialize)]
struct PointObject {
    parameter: f64,
    label: String,
    value: f64,
    stable: bool,
    stability: &'static str,
    admissible: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    event: Option<&'static str>,
}

/// The object of `vibro response`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &Oscillator,
    (task, found): (&ResponsePlan, &ResponseCurves),
) -> impl Serialize + use<'a> {
    let units = &asked.units;
    let sweep = |direction, motions: &[SweptMotion]| SweepObject {
        direction,
        points: motions.iter().map(|motion| swept(motion, task, units)).collect(),
    };
    let answer = ResponseAnswer {
        vary: units.name_of(task.vary),
        over: Place::over(&task.over, units.of(task.vary)),
        quantity: task.quantity.name(),
        sweeps: [sweep("up", &found.up), sweep("down", &found.down)],
        branches: found.branches.iter().map(|branch| object(branch, task, units)).collect(),
    };
    Document::new(asked, osc, plan, answer)
}

fn swept(motion: &SweptMotion, task: &ResponsePlan, units: &Units) -> SweptObject {
    SweptObject {
        parameter: motion.value * units.of(task.vary),
        label: motion.label.clone(),
        value: value(motion.quantities, task.quantity, &units.at(task.vary, motion.value)),
    }
}

fn object(branch: &ResponseBranch, task: &ResponsePlan, units: &Units) -> BranchObject {
    let point = |point: &vibroimpact_study::ResponsePoint| PointObject {
        parameter: point.solution.value * units.of(task.vary),
        label: point.solution.cycle.label.to_string(),
        value: value(point.quantities, task.quantity, &units.at(task.vary, point.solution.value)),
        stable: point.solution.stable(),
        stability: point.solution.stability().name(),
        admissible: point.solution.physical,
        event: point.solution.event.map(|event| event.name()),
    };
    BranchObject { points: branch.points.iter().map(point).collect() }
}

/// A quantity in these units; not-a-number where it is not defined.
#[must_use]
pub fn value(of: Option<Quantities>, quantity: Quantity, units: &Units) -> f64 {
    of.map_or(f64::NAN, |of| units.value_of(&of, quantity))
}
