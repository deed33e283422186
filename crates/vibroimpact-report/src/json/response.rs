//! The response over a number: the motions of two sweeps, and the branches on which they lie.

use super::Place;
use crate::response::ResponseView;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact_study::ResponseRow;

/// The answer to `vibro response`.
#[derive(JsonSchema, Serialize)]
pub(super) struct ResponseAnswer<'a> {
    /// The number that varies.
    vary: &'a str,
    /// Its values.
    over: Place,
    /// The quantity that `value` is.
    quantity: String,
    /// The motions of the sweeps with rising and with falling values.
    sweeps: [SweepObject; 2],
    /// The branches on which their cycles lie.
    branches: Vec<BranchObject>,
}

#[derive(JsonSchema, Serialize)]
struct SweepObject {
    direction: &'static str,
    points: Vec<PointObject>,
}

#[derive(JsonSchema, Serialize)]
struct BranchObject {
    points: Vec<PointObject>,
}

/// A motion of a sweep, or an orbit of a branch.
#[derive(JsonSchema, Serialize)]
struct PointObject {
    /// The value of the parameter.
    parameter: f64,
    /// The label of the motion.
    label: String,
    /// The quantity; null where it is not defined.
    value: f64,
    /// Whether it is stable.
    stable: bool,
    /// `stable`, `neutral` or `unstable`.
    stability: Option<&'static str>,
    /// Whether it is admissible. Motions of a sweep are.
    admissible: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    event: Option<&'static str>,
}

impl<'a> ResponseAnswer<'a> {
    pub(super) fn new(view: &ResponseView<'a>) -> Self {
        let points = |rows: &[ResponseRow]| {
            let point = |row: &ResponseRow| PointObject {
                parameter: view.parameter(row),
                label: row.label.clone(),
                value: view.shown(row),
                stable: row.stable(),
                stability: row.stability.map(|stability| stability.name()),
                admissible: row.admissible,
                event: row.event,
            };
            rows.iter().map(point).collect()
        };
        let found = view.found;
        Self {
            vary: view.vary,
            over: Place::over(view.over, view.unit()),
            quantity: found.quantities[found.shown].clone(),
            sweeps: [("up", &found.up), ("down", &found.down)]
                .map(|(direction, rows)| SweepObject { direction, points: points(rows) }),
            branches: found.branches.iter().map(|rows| BranchObject { points: points(rows) }).collect(),
        }
    }
}
