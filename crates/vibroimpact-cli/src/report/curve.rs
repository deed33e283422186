//! Curves of events in a plane of two parameters as tables, text and JSON.

use crate::args::Units;
use crate::report::branch::{ChosenObject, cells};
use crate::report::branch_text::{chosen, named};
use crate::report::csv::Number;
use crate::report::json::{CyclePoint, impacts, pairs};
use crate::report::text::{precise, short, table};
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::Parameter;
use vibroimpact::continuation::CurvePoint;
use vibroimpact_study::{CurvePlan, EventCurve, Stretch};

/// The command's part of the object. Pairs of values are in the order of `parameters`.
#[derive(Serialize)]
pub(crate) struct Answer {
    label: String,
    kind: &'static str,
    parameters: [&'static str; 2],
    orbit: ChosenObject,
    /// Values of the first parameter at the events of that kind on the branch.
    found_at: Vec<f64>,
    /// The one the curve goes through, counted from 1, and its place among the points.
    through: Through,
    points: Vec<PointObject>,
    events: Vec<EventObject>,
}

#[derive(Serialize)]
struct Through {
    event: usize,
    point: usize,
}

#[derive(Serialize)]
struct PointObject {
    values: [f64; 2],
    physical: bool,
    /// On a grazing curve with the impact of speed zero in it.
    cycle: Vec<CyclePoint>,
    multipliers: [[f64; 2]; 2],
}

#[derive(Serialize)]
struct EventObject {
    kind: &'static str,
    values: [f64; 2],
    point: usize,
}

/// Values in the units of the results.
fn values(point: &CurvePoint, plan: &CurvePlan, units: &Units) -> [f64; 2] {
    [point.values.0 * units.of(plan.vary.parameter), point.values.1 * units.of(plan.and.parameter)]
}

impl Answer {
    pub(crate) fn new(found: &EventCurve, plan: &CurvePlan, units: &Units) -> Self {
        let points = found.points.iter();
        Self {
            label: plan.label.trim().to_owned(),
            kind: plan.kind.name(),
            parameters: [plan.vary.parameter.name(), plan.and.parameter.name()],
            orbit: ChosenObject::new(&found.chosen),
            found_at: found.events.iter().map(|event| event.value * units.of(plan.vary.parameter)).collect(),
            through: Through { event: found.through + 1, point: found.begin },
            events: points
                .clone()
                .enumerate()
                .filter_map(|(k, point)| {
                    Some(EventObject { kind: point.event?.name(), values: values(point, plan, units), point: k })
                })
                .collect(),
            points: points
                .map(|point| PointObject {
                    values: values(point, plan, units),
                    physical: point.physical,
                    cycle: impacts(&point.cycle, units),
                    multipliers: pairs(point.cycle.multipliers),
                })
                .collect(),
        }
    }
}

/// The columns of the table.
pub(crate) fn columns(plan: &CurvePlan) -> String {
    let (p, q) = (plan.vary.parameter.name(), plan.and.parameter.name());
    format!("{p},{q},physical,event,re_1,im_1,re_2,im_2,phases,velocities")
}

/// One row a point, from one end to the other.
pub(crate) fn rows<'a>(
    found: &'a EventCurve,
    plan: &'a CurvePlan,
    units: &'a Units,
) -> impl Iterator<Item = String> + 'a {
    found.points.iter().map(move |point| {
        let [p, q] = values(point, plan, units);
        let event = point.event.map_or("", |event| event.name());
        let head = format!("{},{},{},{event}", Number(p), Number(q), point.physical);
        format!("{head},{}", cells(&point.cycle, units))
    })
}

/// What it is, and the events on it from one end to the other.
pub(crate) fn text(found: &EventCurve, plan: &CurvePlan, units: &Units) -> String {
    let name = |parameter: Parameter| named(parameter, units);
    let over = |stretch: &Stretch| {
        let unit = units.of(stretch.parameter);
        format!("{} from {} to {}", name(stretch.parameter), short(stretch.from * unit), short(stretch.to * unit))
    };
    let (p, kind) = (plan.vary.parameter, plan.kind.name());
    let mut text = format!("{kind} of {} ({})\n", plan.label.trim(), chosen(&found.chosen));
    let found_at: Vec<String> = found.events.iter().map(|event| precise(event.value * units.of(p))).collect();
    let which =
        if found_at.len() > 1 { format!(", the curve is that of number {}", found.through + 1) } else { String::new() };
    let _ = writeln!(text, "  found at {} {}{which}", name(p), found_at.join(", "));
    let _ = writeln!(text, "  followed over {}, {}: {} points", over(&plan.vary), over(&plan.and), found.points.len());
    let heads = ["<event".to_owned(), name(p), name(plan.and.parameter), "<motion".into()];
    let all = &found.points;
    let rows: Vec<Vec<String>> = all
        .iter()
        .enumerate()
        .filter_map(|(k, point)| {
            let [p, q] = values(point, plan, units);
            // at an event itself rounding decides; what lies beside it counts
            let beside = [k.checked_sub(1).and_then(|k| all.get(k)), all.get(k + 1)];
            let physical = point.physical || beside.into_iter().flatten().any(|point| point.physical);
            let motion = if physical { plan.label.trim() } else { "no motion" }.to_owned();
            Some(vec![point.event?.name().into(), precise(p), precise(q), motion])
        })
        .collect();
    text + &table(&heads, &rows)
}
