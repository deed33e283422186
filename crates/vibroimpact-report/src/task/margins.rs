//! The nearest events of a motion in each parameter, and the box of parameters in which the motion was found.

use crate::json::branch::EventFields;
use crate::json::event::Stops;
use crate::json::motion::MotionObject;
use crate::number::{Number, percent, precise, short};
use crate::text::Teller;
use crate::text::words::aligned;
use crate::{AnswerOf, Table, Told, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::Oscillator;
use vibroimpact::continuation::BranchEvent;
use vibroimpact::verdict::System;
use vibroimpact_study::{
    Loss, MarginEnd, MotionBox, MotionMargins, ParameterMargin, PointOf, Scope, Solution, counted,
};

/// The answer to `vibro margins`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct MarginsAnswer<'a> {
    /// The motion.
    motion: MotionObject<'a>,
    /// The nearest events in each parameter; none of a motion that is not periodic.
    parameters: Vec<ParameterObject<'a>>,
    /// The event with the smallest change in units of the scale of its parameter; null if there is none in the ranges.
    nearest: Option<NearestObject<'a>>,
    /// The largest box in which the motion was found; null for a motion that is not periodic or not stable, and of
    /// machines, for which no box is looked for.
    #[serde(rename = "box")]
    motion_box: Option<BoxObject<'a>>,
}

#[derive(JsonSchema, Serialize)]
pub(crate) struct ParameterObject<'a> {
    /// Its name.
    pub(crate) parameter: &'a str,
    /// Its value in the system.
    pub(crate) value: f64,
    /// The change of the parameter that counts as 1 in the box.
    pub(crate) scale: f64,
    /// The nearest event below.
    pub(crate) down: EndObject<'a>,
    /// The nearest event above.
    pub(crate) up: EndObject<'a>,
}

/// The nearest event in one direction. Without one, the last four are `null`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct EndObject<'a> {
    /// The end of the range in which events are looked for.
    pub(crate) limit: f64,
    /// The value of the parameter at the event.
    pub(crate) at: Option<f64>,
    /// Its distance from the value of the system.
    pub(crate) distance: Option<f64>,
    /// That distance relative to the value of the system.
    pub(crate) relative: Option<f64>,
    /// The event.
    pub(crate) event: Option<MarginEvent<'a>>,
}

#[derive(JsonSchema, Serialize)]
pub(crate) struct MarginEvent<'a> {
    pub(crate) kind: &'static str,
    #[serde(flatten)]
    pub(crate) fields: EventFields<'a>,
}

/// The event with the smallest change in units of the scale of its parameter.
#[derive(JsonSchema, Serialize)]
struct NearestObject<'a> {
    parameter: &'a str,
    /// `down` or `up`.
    direction: &'static str,
    /// The change in units of the scale.
    scaled: f64,
}

#[derive(JsonSchema, Serialize)]
struct BoxObject<'a> {
    /// Each parameter lies within this multiple of its scale from its value.
    size: f64,
    /// The largest size that was allowed.
    largest: f64,
    /// The range of each parameter.
    parameters: Vec<RangeObject<'a>>,
    /// Number of points in the box at which the motion was found.
    points: u64,
    /// Number of the lines on which they lie.
    lines: u64,
    /// Whether it is proved that the motion exists in the whole box.
    proved: bool,
    /// Why the motion was not found next to the box, and the values of the parameters there; null if the box ends at
    /// the end of a range.
    edge: Option<EdgeObject<'a>>,
}

#[derive(JsonSchema, Serialize)]
struct RangeObject<'a> {
    parameter: &'a str,
    from: f64,
    to: f64,
}

/// A point next to the box at which the motion was not found.
#[derive(JsonSchema, Serialize)]
struct EdgeObject<'a> {
    loss: &'static str,
    parameters: Vec<ValueObject<'a>>,
}

#[derive(JsonSchema, Serialize)]
struct ValueObject<'a> {
    parameter: &'a str,
    value: f64,
}

impl<'a> MarginsAnswer<'a> {
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a MotionMargins<D::System, D::Name, PointOf<D>>) -> Self {
        let (system, units) = (&of.system, &of.units);
        let nearest = found.nearest().map(|(margin, direction, end)| NearestObject {
            parameter: margin.scope.parameter.field(units),
            direction,
            scaled: end.scaled(&margin.scope),
        });
        Self {
            motion: D::motion(of, &found.motion),
            parameters: found.parameters.iter().map(|margin| ParameterObject::new(margin, system, units)).collect(),
            nearest,
            motion_box: found.motion_box.as_ref().map(|found_box| BoxObject::new(found_box, &found.parameters, units)),
        }
    }
}

impl<'a> ParameterObject<'a> {
    pub(crate) fn new<V: Varied, P: Solution<System: Stops>>(
        margin: &'a ParameterMargin<V, P>,
        system: &'a P::System,
        units: &Units,
    ) -> Self {
        let scope = &margin.scope;
        let unit = scope.parameter.unit(units);
        let [down, up] = margin.ends().map(|(_, limit, end)| {
            let event = end.point.as_ref().and_then(|point| Some((point, point.event()?)));
            let fields = |(point, event): (&P, BranchEvent)| {
                EventFields::of(event, (point.label(), end.after), &|place| system.name_of_stop(place))
            };
            EndObject {
                limit: limit * unit,
                at: event.map(|_| end.value * unit),
                distance: event.map(|_| end.distance(scope) * unit),
                relative: event.and_then(|_| end.relative(scope)),
                event: event.map(|at| MarginEvent { kind: at.1.name(), fields: fields(at) }),
            }
        });
        let (parameter, value, scale) = (scope.parameter.field(units), scope.value * unit, scope.scale * unit);
        Self { parameter, value, scale, down, up }
    }
}

impl<'a> BoxObject<'a> {
    fn new<V: Varied, P>(found: &MotionBox, parameters: &'a [ParameterMargin<V, P>], units: &Units) -> Self {
        let names = || parameters.iter().map(|margin| (&margin.scope, margin.scope.parameter.unit(units)));
        let range = |(scope, unit): (&'a Scope<V>, f64)| RangeObject {
            parameter: scope.parameter.field(units),
            from: scope.at(-found.size) * unit,
            to: scope.at(found.size) * unit,
        };
        let value = |((scope, unit), value): ((&'a Scope<V>, f64), &f64)| ValueObject {
            parameter: scope.parameter.field(units),
            value: value * unit,
        };
        Self {
            size: found.size,
            largest: found.largest,
            parameters: names().map(range).collect(),
            points: found.points,
            lines: found.lines,
            proved: false,
            edge: found.edge.as_ref().map(|edge| EdgeObject {
                loss: edge.loss.name(),
                parameters: names().zip(&edge.values).map(value).collect(),
            }),
        }
    }
}

const HEADER: &str = "parameter,value,direction,limit,at,distance,relative,event,before,after";

/// The table of `vibro margins`.
pub(crate) fn table<'a, S: System + Stops, V: Varied, P: Solution<System = S>>(
    found: &'a MotionMargins<S, V, P>,
    system: &'a S,
    units: Units,
) -> Table<'a> {
    let rows = found.parameters.iter().flat_map(move |margin| {
        both(margin.scope.parameter.column(&units), &ParameterObject::new(margin, system, &units))
    });
    Table::new(HEADER.to_owned(), rows)
}

/// The rows of a parameter. Without an event up to the limit of the range, the last six cells are empty.
fn both(name: &str, of: &ParameterObject<'_>) -> [String; 2] {
    let cell = |value: Option<f64>| value.map_or_else(String::new, |value| Number(value).to_string());
    [("down", &of.down), ("up", &of.up)].map(|(way, end)| {
        let begin = format!("{name},{},{way},{}", Number(of.value), Number(end.limit));
        let Some(event) = &end.event else { return format!("{begin},,,,,,") };
        let (at, distance, relative) = (cell(end.at), cell(end.distance), cell(end.relative));
        let (before, after) = (&event.fields.before, event.fields.after.as_deref().unwrap_or_default());
        format!("{begin},{at},{distance},{relative},{},{before},{after}", event.kind)
    })
}

/// The motion, its nearest events in each number, and what is told beside them.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &MotionMargins<D::System, D::Name, PointOf<D>>) -> String {
    let (units, why) = (&of.units, |point: &PointOf<D>| D::because(of, point));
    let stability = found.motion.stability(&of.system);
    let stable = stability.map_or_else(String::new, |stability| format!(", {stability}"));
    let mut text = format!("{}{stable}\n", D::headline(of, &found.motion));
    if found.parameters.is_empty() {
        text.push_str("  it is no single periodic motion, so it has no branch to follow and no margins\n");
        return text;
    }
    let rows: Vec<Vec<String>> =
        found.parameters.iter().flat_map(|margin| margin.ends().map(|end| row(margin, end, units, &why))).collect();
    text.push_str(&aligned(&HEADS.map(str::to_owned), &rows));
    if let Some((margin, way, end)) = found.nearest() {
        let _ = writeln!(
            text,
            "  nearest: {} at {} {}, {way} by {} of {}",
            end.point.as_ref().and_then(Solution::event_name).unwrap_or_default(),
            margin.scope.parameter.words(units),
            precise(end.value * margin.scope.parameter.unit(units)),
            percent(end.scaled(&margin.scope)),
            whole(core::slice::from_ref(margin))
        );
    }
    text + &D::of_margins(of, found)
}

/// The box of parameters of an oscillator.
pub(crate) fn of_box(found: &MotionMargins, osc: &Oscillator, units: &Units) -> String {
    match &found.motion_box {
        Some(found_box) => told_box(found_box, &found.parameters, &found.motion.label(), units),
        None => {
            let stability = found.motion.stability(osc).map_or("undecided", |stability| stability.name());
            format!("\nno box: the motion is {stability}\n")
        }
    }
}

/// The columns of the events.
const HEADS: [&str; 7] = ["<parameter", "value", "<way", "event at", "distance", "relative", "<event"];

/// What a box is measured in: the values of the parameters, or other scales.
fn whole<V, P>(parameters: &[ParameterMargin<V, P>]) -> &'static str {
    let usual = parameters.iter().all(|margin| margin.scope.scale == margin.scope.value.abs());
    if usual { "its value" } else { "its scale" }
}

/// The nearest event of a number in one direction.
fn row<V: Varied, P: Solution>(
    margin: &ParameterMargin<V, P>,
    (way, limit, end): (&str, f64, &MarginEnd<P>),
    units: &Units,
    why: &impl Fn(&P) -> String,
) -> Vec<String> {
    let (scope, unit) = (&margin.scope, margin.scope.parameter.unit(units));
    let begin = [scope.parameter.words(units), short(scope.value * unit), way.to_owned()];
    let ends = match end.point.as_ref().and_then(|point| Some((point, point.event_name()?))) {
        Some((point, name)) => {
            let relative = end.relative(scope).map_or_else(String::new, |share| format!("{:+.2} %", 100.0 * share));
            let before = point.label();
            let beyond = end.after.as_ref().filter(|after| **after != before);
            let beyond = beyond.map_or_else(String::new, |after| format!(" to {after}"));
            let event = format!("{name}{beyond}{}", why(point));
            [precise(end.value * unit), short(end.distance(scope) * unit), relative, event]
        }
        None => [String::new(), String::new(), String::new(), format!("none up to {}", short(limit * unit))],
    };
    begin.into_iter().chain(ends).collect()
}

/// The box, and where the motion was lost next to it.
fn told_box(found: &MotionBox, parameters: &[ParameterMargin], label: &str, units: &Units) -> String {
    let mut text = format!(
        "\nbox: each parameter within {} of {}; {label} was found by trying {} on {}, not proved\n",
        percent(found.size),
        whole(parameters),
        counted(found.points, "point"),
        counted(found.lines, "line")
    );
    let heads = ["<parameter", "from", "to", "scale"].map(str::to_owned);
    let rows: Vec<Vec<String>> = parameters
        .iter()
        .map(|margin| {
            let (scope, unit) = (&margin.scope, units.of(margin.scope.parameter));
            let ends = [scope.at(-found.size), scope.at(found.size), scope.scale].map(|value| short(value * unit));
            core::iter::once(scope.parameter.words(units)).chain(ends).collect()
        })
        .collect();
    text.push_str(&aligned(&heads, &rows));
    let Some(edge) = &found.edge else {
        text.push_str("  it ends at the end of a range\n");
        return text;
    };
    let values: Vec<String> = parameters
        .iter()
        .zip(&edge.values)
        .map(|(margin, value)| {
            let parameter = margin.scope.parameter;
            format!("{} {}", parameter.words(units), short(value * units.of(parameter)))
        })
        .collect();
    let _ = writeln!(text, "  next to it, at {}: {}", values.join(", "), lost(edge.loss, label));
    text
}

/// Why a motion was not found.
fn lost(loss: Loss, label: &str) -> String {
    match loss {
        Loss::NoSystem => "the two stops leave no room".to_owned(),
        Loss::NoSolution => format!("no {label} was found close by"),
        Loss::Inadmissible => format!("{label} passes through a stop, or loses an impact"),
        Loss::Unstable => format!("{label} is unstable"),
        Loss::Shorter => format!("{label} becomes a motion of a shorter period"),
        Loss::OtherMotion => "another motion follows the release".to_owned(),
    }
}
