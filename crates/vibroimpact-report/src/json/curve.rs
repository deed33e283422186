//! Curves of events in a plane of two parameters: their points, and their points of codimension two.

use super::Document;
use super::branch::ChosenObject;
use super::event::{self, EventObject};
use super::motion::multipliers;
use crate::{Asked, Units};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::continuation::{CurveKind, CurvePoint, MachineCurvePoint};
use vibroimpact::machine::Machine;
use vibroimpact_study::{CurvePlan, EventCurve, MachineEventCurve, Name, Plan, Variable};

/// The answer to `vibro curve`. Pairs of values are in the order of `parameters`.
#[derive(JsonSchema, Serialize)]
pub(super) struct CurveAnswer<'a> {
    label: String,
    kind: &'static str,
    /// The stop or joint of a curve of grazing, sticking or holding of a machine, or the stops and joints of a corner.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    of: Vec<&'a str>,
    parameters: [&'a str; 2],
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

/// The object of `vibro curve`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &Oscillator,
    (task, found): (&CurvePlan, &EventCurve),
) -> impl Serialize + use<'a> {
    Document::new(asked, osc, plan, CurveAnswer::of_oscillator(found, task, asked))
}

/// Values of both parameters at a point, in the units of the results.
#[must_use]
pub fn values(point: &CurvePoint, plan: &CurvePlan, units: &Units) -> [f64; 2] {
    [point.values.0 * units.of(plan.vary.parameter), point.values.1 * units.of(plan.and.parameter)]
}

impl<'a> CurveAnswer<'a> {
    fn of_oscillator(found: &EventCurve, plan: &CurvePlan, Asked { system, units }: &Asked) -> Self {
        let points = found.points.iter();
        Self {
            label: plan.label.as_deref().unwrap_or_default().trim().to_owned(),
            kind: plan.kind.name(),
            parameters: [plan.vary.parameter, plan.and.parameter].map(|parameter| units.name_of(parameter)),
            of: Vec::new(),
            orbit: Some(ChosenObject::new(&found.chosen)),
            found_at: found.events.iter().map(|event| event.value * units.of(plan.vary.parameter)).collect(),
            through: Through { event: found.through + 1, point: found.begin },
            events: points
                .clone()
                .enumerate()
                .filter_map(|(k, point)| {
                    let kind = point.event?.name();
                    Some(CurveEventObject { kind, values: values(point, plan, units), point: k, stop: None })
                })
                .collect(),
            points: points
                .map(|point| {
                    let of = [plan.vary.parameter, plan.and.parameter];
                    let there = units.at_both((of[0], of[1]), point.values);
                    let osc = system.with_all(of.into_iter().zip(<[f64; 2]>::from(point.values)));
                    let osc = osc.and_then(|system| system.oscillator()).ok();
                    let periods = f64::from(point.cycle.label.periods);
                    PointObject {
                        values: values(point, plan, units),
                        label: point.cycle.label.to_string(),
                        admissible: point.physical,
                        period: osc.map_or(f64::NAN, |osc| periods * osc.period() * there.time()),
                        cycle: osc.map_or_else(Vec::new, |osc| event::of_cycle(&osc, &point.cycle, &there)),
                        multipliers: multipliers(&point.cycle.multipliers),
                        residual: None,
                        touch: None,
                    }
                })
                .collect(),
        }
    }
    pub(super) fn of_machine(
        machine: &'a Machine,
        plan: &'a CurvePlan<Variable>,
        found: &'a MachineEventCurve,
    ) -> Self {
        let pair = |(p, q): (f64, f64)| [p, q];
        let event = |(k, point): (usize, &MachineCurvePoint)| {
            let event = point.event?;
            let stop = event.place().map(|place| machine.name_of(place));
            Some(CurveEventObject { kind: event.name(), values: pair(point.values), point: k, stop })
        };
        let point = |point: &'a MachineCurvePoint| PointObject {
            values: pair(point.values),
            label: point.cycle.label.to_string(),
            admissible: true,
            period: point.cycle.period,
            cycle: point.cycle.events.iter().map(|event| event::of_machine(machine, event)).collect(),
            multipliers: multipliers(&point.cycle.multipliers),
            residual: Some(point.residual),
            touch: point.touch,
        };
        Self {
            label: found.label.to_string(),
            kind: plan.kind.name(),
            of: match found.kind {
                CurveKind::Grazing { stop } | CurveKind::Sticking { stop } => vec![machine.name_of(stop)],
                CurveKind::Holding { joint } => vec![machine.name_of(joint)],
                CurveKind::Corner { first, second } => vec![machine.name_of(first), machine.name_of(second)],
                _ => Vec::new(),
            },
            parameters: [plan.vary.parameter.text(), plan.and.parameter.text()],
            orbit: ChosenObject::of_machine(found.among),
            found_at: found.events.iter().map(|event| event.value).collect(),
            through: Through { event: found.through + 1, point: found.begin },
            events: found.points.iter().enumerate().filter_map(event).collect(),
            points: found.points.iter().map(point).collect(),
        }
    }
}
