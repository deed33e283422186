//! Curves of events in a plane of two parameters: their points, and their points of codimension two.

use super::Document;
use super::branch::ChosenObject;
use super::event::{self, EventObject};
use super::motion::multipliers;
use crate::{Asked, Units};
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::continuation::CurvePoint;
use vibroimpact_study::{CurvePlan, EventCurve, Plan};

/// The fields of `vibro curve`. Pairs of values are in the order of `parameters`.
#[derive(Serialize)]
struct CurveFields {
    label: String,
    kind: &'static str,
    parameters: [&'static str; 2],
    orbit: ChosenObject,
    /// Values of the first parameter at the events of this kind on the branch.
    found_at: Vec<f64>,
    /// The number, counted from 1, of the event through which the curve passes, and its index among the points.
    through: Through,
    points: Vec<PointObject>,
    events: Vec<CurveEventObject>,
}

#[derive(Serialize)]
struct Through {
    event: usize,
    point: usize,
}

#[derive(Serialize)]
struct PointObject {
    values: [f64; 2],
    label: String,
    admissible: bool,
    /// The events; on a grazing curve including the impact of speed zero.
    cycle: Vec<EventObject<'static>>,
    multipliers: Vec<[f64; 2]>,
}

#[derive(Serialize)]
struct CurveEventObject {
    kind: &'static str,
    values: [f64; 2],
    point: usize,
}

/// The object of `vibro curve`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &Oscillator,
    (task, found): (&CurvePlan, &EventCurve),
) -> impl Serialize + use<'a> {
    Document::new(asked, osc, plan, CurveFields::new(found, task, asked))
}

/// Values of both parameters at a point, in the units of the results.
#[must_use]
pub fn values(point: &CurvePoint, plan: &CurvePlan, units: &Units) -> [f64; 2] {
    [point.values.0 * units.of(plan.vary.parameter), point.values.1 * units.of(plan.and.parameter)]
}

impl CurveFields {
    fn new(found: &EventCurve, plan: &CurvePlan, Asked { system, units }: &Asked) -> Self {
        let points = found.points.iter();
        Self {
            label: plan.label.trim().to_owned(),
            kind: plan.kind.name(),
            parameters: [plan.vary.parameter, plan.and.parameter].map(|parameter| units.name_of(parameter)),
            orbit: ChosenObject::new(&found.chosen),
            found_at: found.events.iter().map(|event| event.value * units.of(plan.vary.parameter)).collect(),
            through: Through { event: found.through + 1, point: found.begin },
            events: points
                .clone()
                .enumerate()
                .filter_map(|(k, point)| {
                    Some(CurveEventObject { kind: point.event?.name(), values: values(point, plan, units), point: k })
                })
                .collect(),
            points: points
                .map(|point| {
                    let of = [plan.vary.parameter, plan.and.parameter];
                    let there = units.at_both((of[0], of[1]), point.values);
                    let osc = system.with_all(of.into_iter().zip(<[f64; 2]>::from(point.values)));
                    let osc = osc.and_then(|system| system.oscillator());
                    PointObject {
                        values: values(point, plan, units),
                        label: point.cycle.label.to_string(),
                        admissible: point.physical,
                        cycle: osc.map_or_else(|_| Vec::new(), |osc| event::of_cycle(&osc, &point.cycle, &there)),
                        multipliers: multipliers(&point.cycle.multipliers),
                    }
                })
                .collect(),
        }
    }
}
