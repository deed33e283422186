//! Curves of events in a plane of two parameters: their points, and their points of codimension two.

use super::branch::ChosenObject;
use super::event::EventObject;
use super::motion::multipliers;
use crate::Varied;
use crate::solutions::{CurvePointView, CurveView};
use schemars::JsonSchema;
use serde::Serialize;

/// The answer to `vibro curve`. Pairs of values are in the order of `parameters`.
#[derive(JsonSchema, Serialize)]
pub(super) struct CurveAnswer<'a> {
    label: String,
    kind: &'static str,
    /// The stop or joint of a curve of grazing, sticking or holding of a machine, or the stops and joints of a corner.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    of: Vec<&'a str>,
    parameters: [String; 2],
    /// Absent for the motion from the start of a machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    orbit: Option<ChosenObject>,
    /// Values of the first parameter at the events of this kind on the branch.
    found_at: Vec<f64>,
    /// The number, counted from 1, of the event through which the curve passes, and its index among the points.
    through: Through,
    points: Vec<PointObject<'a>>,
    events: Vec<CurveEventObject<'a>>,
}

#[derive(JsonSchema, Serialize)]
struct Through {
    event: usize,
    point: usize,
}

#[derive(JsonSchema, Serialize)]
struct PointObject<'a> {
    values: [f64; 2],
    label: String,
    admissible: bool,
    /// The time of one period.
    period: f64,
    /// The events; on a grazing curve of an oscillator including the impact of speed zero, on one of a machine without the touch.
    cycle: Vec<EventObject<'a>>,
    multipliers: Vec<[f64; 2]>,
    /// By how much the condition of the curve of a machine fails, and the phase of the touch.
    #[serde(skip_serializing_if = "Option::is_none")]
    residual: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    touch: Option<f64>,
}

#[derive(JsonSchema, Serialize)]
struct CurveEventObject<'a> {
    kind: &'static str,
    values: [f64; 2],
    point: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'a str>,
}

impl<'a> CurveAnswer<'a> {
    pub(super) fn new<V: Varied>(view: &CurveView<'a, V>) -> Self {
        let event = |(k, point): (usize, &CurvePointView<'a>)| {
            let (kind, stop) = point.event?;
            Some(CurveEventObject { kind, values: point.values, point: k, stop })
        };
        Self {
            label: view.label.to_string(),
            kind: view.plan.kind.name(),
            of: view.of.clone(),
            parameters: view.sides().map(|side| side.parameter.field(&view.units).to_owned()),
            orbit: view.number.map(Into::into),
            found_at: view.found_at.clone(),
            through: Through { event: view.through + 1, point: view.begin },
            points: view.points.iter().map(PointObject::new).collect(),
            events: view.points.iter().enumerate().filter_map(event).collect(),
        }
    }
}

impl<'a> PointObject<'a> {
    fn new(point: &CurvePointView<'a>) -> Self {
        let cycle = &point.cycle;
        Self {
            values: point.values,
            label: cycle.label().to_string(),
            admissible: point.admissible,
            period: cycle.period(),
            cycle: cycle.events(),
            multipliers: multipliers(cycle.multipliers()),
            residual: point.residual,
            touch: point.touch,
        }
    }
}
