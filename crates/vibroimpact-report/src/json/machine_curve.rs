//! Curves of events of machines in a plane of two numbers: their points, and their points of codimension two.

use super::branch::ChosenObject;
use super::event::{self, EventObject};
use super::motion::multipliers;
use serde::Serialize;
use vibroimpact::continuation::MachineCurveKind;
use vibroimpact::machine::Machine;
use vibroimpact_study::{MachineCurvePlan, MachineEventCurve};

/// The fields of `vibro curve --machine`. Pairs of values are in the order of `parameters`.
#[derive(Serialize)]
pub(super) struct Curved<'a> {
    label: String,
    /// Absent for the motion from the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    orbit: Option<ChosenObject>,
    kind: &'static str,
    /// The stop or joint of a curve of grazing, sticking or holding, or the stops and joints of a corner.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    of: Vec<&'a str>,
    parameters: [&'a str; 2],
    /// Values of the first number at the events of this kind on the branch.
    found_at: Vec<f64>,
    /// The number, counted from 1, of the event through which the curve passes, and its index among the points.
    through: Through,
    points: Vec<PointObject<'a>>,
    events: Vec<CurveEventObject<'a>>,
}

#[derive(Serialize)]
struct Through {
    event: usize,
    point: usize,
}

#[derive(Serialize)]
struct PointObject<'a> {
    values: [f64; 2],
    label: String,
    admissible: bool,
    /// The time of one period.
    period: f64,
    /// The events; on a curve of grazing without the touch.
    cycle: Vec<EventObject<'a>>,
    multipliers: Vec<[f64; 2]>,
    /// By how much the condition of the curve fails.
    residual: f64,
    /// The phase of the touch.
    #[serde(skip_serializing_if = "Option::is_none")]
    touch: Option<f64>,
}

#[derive(Serialize)]
struct CurveEventObject<'a> {
    kind: &'static str,
    values: [f64; 2],
    point: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'a str>,
}

/// The object of a curve.
pub(super) fn curved<'a>(machine: &'a Machine, plan: &'a MachineCurvePlan, found: &'a MachineEventCurve) -> Curved<'a> {
    let points = found.points.iter();
    let pair = |(p, q): (f64, f64)| [p, q];
    Curved {
        label: found.label.to_string(),
        orbit: ChosenObject::of_machine(found.among),
        kind: plan.kind.name(),
        of: match found.kind {
            MachineCurveKind::Grazing { stop } | MachineCurveKind::Sticking { stop } => vec![machine.name_of(stop)],
            MachineCurveKind::Holding { joint } => vec![machine.name_of(joint)],
            MachineCurveKind::Corner { first, second } => vec![machine.name_of(first), machine.name_of(second)],
            _ => Vec::new(),
        },
        parameters: [&plan.vary.path, &plan.and.path],
        found_at: found.events.iter().map(|event| event.value).collect(),
        through: Through { event: found.through + 1, point: found.begin },
        events: points
            .clone()
            .enumerate()
            .filter_map(|(k, point)| {
                let event = point.event?;
                let stop = event.place().map(|place| machine.name_of(place));
                Some(CurveEventObject { kind: event.name(), values: pair(point.values), point: k, stop })
            })
            .collect(),
        points: points
            .map(|point| PointObject {
                values: pair(point.values),
                label: point.cycle.label.to_string(),
                admissible: true,
                period: point.cycle.period,
                cycle: point.cycle.events.iter().map(|event| event::of_machine(machine, event)).collect(),
                multipliers: multipliers(&point.cycle.multipliers),
                residual: point.residual,
                touch: point.touch,
            })
            .collect(),
    }
}
