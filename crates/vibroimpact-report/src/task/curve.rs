//! Curves of events in a plane of two parameters: their points, and their points of codimension two.

use crate::Table;
use crate::answer::CurveOf;
use crate::json::branch::ChosenObject;
use crate::json::event::{self, EventObject};
use crate::json::motion::multipliers;
use crate::number::Number;
use crate::number::precise;
use crate::table::cycles::Columns;
use crate::task::diagram::over;
use crate::text::branch::chosen;
use crate::text::words::aligned;
use crate::{AnswerOf, Asked, Told, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::continuation::{CurvePoint, machine};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Stability, System as _};
use vibroimpact_study::{CurvePlan, Solution as _, counted};

/// The answer to `vibro curve`. Pairs of values are in the order of `parameters`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct CurveAnswer<'a> {
    /// The label of the orbit on whose branch the event is.
    pub label: String,
    /// `fold`, `flip` or `grazing`; of a machine also `torus`, `corner`, `sticking` or `holding`.
    kind: &'static str,
    /// The stop or joint of a curve of grazing, sticking or holding of a machine, or the stops and joints of a corner.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    of: Vec<&'a str>,
    /// The two numbers that vary.
    parameters: [String; 2],
    /// Absent for the motion from the start of a machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orbit: Option<ChosenObject>,
    /// Values of the first parameter at the events of this kind on the branch.
    pub found_at: Vec<f64>,
    /// The number, counted from 1, of the event through which the curve passes, and its index among the points.
    pub through: Through,
    /// The points from one end to the other.
    pub points: Vec<PointObject<'a>>,
    /// The events among them.
    pub events: Vec<CurveEventObject<'a>>,
    /// The stability of the orbit; none of a solution that is not admissible.
    #[serde(skip)]
    pub stability: Option<Stability>,
}

/// An event of a branch on a curve.
#[derive(JsonSchema, Serialize)]
pub(crate) struct Through {
    /// Its number among those of this kind on the branch.
    pub event: usize,
    /// Its index among the points of the curve.
    pub point: usize,
}

/// A point of a curve.
#[derive(JsonSchema, Serialize)]
pub struct PointObject<'a> {
    /// Values of both parameters.
    pub(crate) values: [f64; 2],
    /// The label of the cycle.
    pub label: String,
    /// Whether it is a motion.
    pub admissible: bool,
    /// The time of one period.
    pub(crate) period: f64,
    /// The events; on a grazing curve of an oscillator including the impact of speed zero, on one of a machine without the touch.
    pub(crate) cycle: Vec<EventObject<'a>>,
    /// Floquet multipliers; on a curve of grazing of a machine those of the cycle without the contact.
    pub(crate) multipliers: Vec<[f64; 2]>,
    /// By how much the condition of the curve of a machine fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) residual: Option<f64>,
    /// The phase of the touch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) touch: Option<f64>,
}

/// An event of a curve.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub(crate) struct CurveEventObject<'a> {
    /// `cusp`, `resonant grazing`, `double grazing`, `1:1`, `1:2`, `fold-flip`, `end of box` and others.
    pub kind: &'static str,
    /// The values of both parameters.
    pub values: [f64; 2],
    /// Index among the points.
    pub point: usize,
    /// The stop or joint of a machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop: Option<&'a str>,
    /// The other stop or joint of a corner, if it is another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub also: Option<&'a str>,
}

impl<'a> CurveAnswer<'a> {
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a CurveOf<D>, plan: &CurvePlan<D::Name>) -> Self {
        let name = |place: usize| Some(D::machine(of)?.name_of(place));
        let points: Vec<PointObject<'_>> = found.points.iter().map(|point| D::curve_point(of, point, plan)).collect();
        let event = |(k, point): (usize, &D::CurvePoint)| {
            let event = D::curve_event(point)?;
            let (stop, also) = (event.place().and_then(name), event.also().and_then(name));
            Some(CurveEventObject { kind: event.name(), values: points[k].values, point: k, stop, also })
        };
        Self {
            label: D::System::label(&found.chosen.cycle).to_string(),
            kind: plan.kind.name(),
            of: found.places.iter().filter_map(|place| name(*place)).collect(),
            parameters: [&plan.vary, &plan.and].map(|stretch| stretch.parameter.field(&of.units).to_owned()),
            orbit: ChosenObject::new(&found.chosen),
            found_at: found.events.iter().map(|event| event.value() * plan.vary.parameter.unit(&of.units)).collect(),
            through: Through { event: found.through + 1, point: found.begin },
            events: found.points.iter().enumerate().filter_map(event).collect(),
            points,
            stability: found.chosen.stability,
        }
    }

    /// The event at a point.
    pub(crate) fn event_at(&self, point: usize) -> Option<&CurveEventObject<'a>> {
        let place = self.events.binary_search_by_key(&point, |event| event.point).ok()?;
        Some(&self.events[place])
    }
}

impl<'a> PointObject<'a> {
    pub(crate) fn of_oscillator(point: &CurvePoint, plan: &CurvePlan, Asked { system, units }: &Asked) -> Self {
        let (of, (p, q)) = ([plan.vary.parameter, plan.and.parameter], point.values);
        let there = units.at(of[0], p).at(of[1], q);
        let osc = system.with_all(of.into_iter().zip([p, q]));
        let osc = osc.and_then(|system| system.oscillator()).ok();
        let periods = f64::from(point.cycle.label.periods);
        PointObject {
            values: [p * units.of(of[0]), q * units.of(of[1])],
            label: point.cycle.label.to_string(),
            admissible: point.physical,
            period: osc.map_or(f64::NAN, |osc| periods * osc.period() * there.time()),
            cycle: osc.map_or_else(Vec::new, |osc| event::of_cycle(&osc, &point.cycle, &there)),
            multipliers: multipliers(&point.cycle.multipliers),
            residual: None,
            touch: None,
        }
    }

    pub(crate) fn of_machine(machine: &'a Machine, point: &'a machine::CurvePoint) -> Self {
        PointObject {
            values: point.values.into(),
            label: point.cycle.label.to_string(),
            admissible: true,
            period: point.cycle.period,
            cycle: point.cycle.events.iter().map(|event| event::of_machine(machine, event)).collect(),
            multipliers: multipliers(&point.cycle.multipliers),
            residual: Some(point.residual),
            touch: point.touch,
        }
    }
}

/// The table of `vibro curve`. Of a machine with the stop of an event, the residual of the condition and the phase of the touch,
/// which is none of the closings, and without forcing with the period.
pub(crate) fn table<'a, V: Varied>(
    answer: CurveAnswer<'a>,
    machine: Option<&Machine>,
    (plan, units): (&CurvePlan<V>, &Units),
) -> Table<'a> {
    let columns = Columns::new(machine, units, false);
    let (p, q) = (plan.vary.parameter.column(units), plan.and.parameter.column(units));
    let more = machine.is_some();
    let names = if more { ",stop,residual,touch" } else { "" };
    let header = format!("{p},{q},label,admissible,event{names},{}", columns.names());
    Table::new(header, (0..answer.points.len()).map(move |k| row_of_table(&answer, k, &columns, more)))
}

fn row_of_table(answer: &CurveAnswer<'_>, k: usize, columns: &Columns, more: bool) -> String {
    let (point, event) = (&answer.points[k], answer.event_at(k));
    let cell = |x: Option<f64>| x.map_or_else(String::new, |x| Number(x).to_string());
    let more = more.then(|| {
        let stop = event.and_then(|event| event.stop).unwrap_or_default();
        format!(",{stop},{},{}", cell(point.residual), cell(point.touch))
    });
    let cycle = columns.cells((&point.cycle, point.period), &point.multipliers, None);
    let ([p, q], kind) = (point.values.map(Number), event.map_or("", |event| event.kind));
    format!("{p},{q},{},{},{kind}{}{cycle}", point.label, point.admissible, more.unwrap_or_default())
}

/// The description of a curve, and the events on it from one end to the other.
pub(crate) fn text<V: Varied>(answer: &CurveAnswer<'_>, (plan, units): (&CurvePlan<V>, &Units)) -> String {
    let [p, q] = [&plan.vary, &plan.and].map(|side| side.parameter.words(units));
    let at: Vec<String> = answer.found_at.iter().map(|value| precise(*value)).collect();
    let which =
        if at.len() > 1 { format!(", the curve is that of number {}", answer.through.event) } else { String::new() };
    let text = format!(
        "{} of {} ({})\n  found at {p} {}{which}\n  followed over {}, {}: {}\n",
        plan.kind.name(),
        answer.label,
        chosen(answer.orbit, answer.stability),
        at.join(", "),
        over(&plan.vary, units),
        over(&plan.and, units),
        counted(answer.points.len() as u64, "point")
    );
    let rows: Vec<Vec<String>> = answer.events.iter().map(|event| row(answer, event)).collect();
    text + &aligned(&["<event".to_owned(), p, q, "<motion".into()], &rows)
}

fn row(answer: &CurveAnswer<'_>, event: &CurveEventObject<'_>) -> Vec<String> {
    let CurveEventObject { kind, values: [p, q], point, stop, also } = *event;
    let mut at = stop.map_or_else(String::new, |stop| format!(" at {stop}"));
    if let Some(other) = also {
        at += &format!(" and {other}");
    }
    // at an event itself rounding decides, so the neighbouring points are used
    let around = &answer.points[point.saturating_sub(1)..answer.points.len().min(point + 2)];
    let admissible = around.iter().any(|point| point.admissible);
    let motion = if admissible { &answer.points[point].label } else { "inadmissible" };
    vec![format!("{kind}{at}"), precise(p), precise(q), motion.to_owned()]
}
