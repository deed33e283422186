//! The nearest events of a motion in each parameter, and the box of parameters in which the motion was found.

use super::Document;
use super::branch::EventFields;
use super::motion::MotionObject;
use crate::{Asked, Units};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact_study::{
    EventRecord, MachineMargins, MarginEnd, MotionBox, MotionMargins, NumberMargin, ParameterMargin, Plan,
};

/// The answer to `vibro margins`.
#[derive(JsonSchema, Serialize)]
pub(super) struct MarginsAnswer<'a> {
    motion: MotionObject<'a>,
    parameters: Vec<ParameterObject<'a>>,
    nearest: Option<NearestObject<'a>>,
    #[serde(rename = "box")]
    motion_box: Option<BoxObject>,
}

#[derive(JsonSchema, Serialize)]
pub(crate) struct ParameterObject<'a> {
    pub(crate) parameter: &'a str,
    pub(crate) value: f64,
    pub(crate) scale: f64,
    pub(crate) down: EndObject<'a>,
    pub(crate) up: EndObject<'a>,
}

/// The nearest event in one direction. Without one, the last four are `null`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct EndObject<'a> {
    /// The end of the range in which events are looked for.
    pub(crate) limit: f64,
    pub(crate) at: Option<f64>,
    pub(crate) distance: Option<f64>,
    pub(crate) relative: Option<f64>,
    pub(crate) event: Option<MarginEvent<'a>>,
}

#[derive(JsonSchema, Serialize)]
pub(crate) struct MarginEvent<'a> {
    pub(crate) kind: &'static str,
    #[serde(flatten)]
    pub(crate) fields: EventFields<'a>,
}

impl MarginEvent<'static> {
    fn new(record: EventRecord) -> Self {
        Self { kind: record.kind, fields: EventFields::of_oscillator(record) }
    }
}

/// The event with the smallest change in units of the scale of its parameter.
#[derive(JsonSchema, Serialize)]
struct NearestObject<'a> {
    parameter: &'a str,
    direction: &'static str,
    /// The change in units of the scale.
    scaled: f64,
}

#[derive(JsonSchema, Serialize)]
struct BoxObject {
    /// Each parameter lies within this multiple of its scale from its value.
    size: f64,
    /// The largest size that was allowed.
    largest: f64,
    parameters: Vec<RangeObject>,
    /// Number of points in the box at which the motion was found, and of the lines on which they lie.
    points: u64,
    lines: u64,
    /// Whether it is proved that the motion exists in the whole box.
    proved: bool,
    edge: Option<EdgeObject>,
}

#[derive(JsonSchema, Serialize)]
struct RangeObject {
    parameter: &'static str,
    from: f64,
    to: f64,
}

/// A point next to the box at which the motion was not found.
#[derive(JsonSchema, Serialize)]
struct EdgeObject {
    loss: &'static str,
    parameters: Vec<ValueObject>,
}

#[derive(JsonSchema, Serialize)]
struct ValueObject {
    parameter: &'static str,
    value: f64,
}

/// The object of `vibro margins`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &Oscillator,
    found: &MotionMargins,
) -> impl Serialize + use<'a> {
    let units = &asked.units;
    let fields = MarginsAnswer {
        motion: MotionObject::of_oscillator(&found.motion, osc, units),
        parameters: found.parameters.iter().map(|margin| ParameterObject::new(margin, units)).collect(),
        nearest: found.nearest().map(|(margin, end)| {
            let distance = end.distance(&margin.scope);
            NearestObject {
                parameter: units.name_of(margin.scope.parameter),
                direction: if distance < 0.0 { "down" } else { "up" },
                scaled: distance.abs() / margin.scope.scale,
            }
        }),
        motion_box: found.motion_box.as_ref().map(|found_box| BoxObject::new(found_box, &found.parameters, units)),
    };
    let document = Document::new(asked, osc, plan, fields);
    match &found.start {
        Some(start) => document.start(start, units),
        None => document,
    }
}

impl<'a> MarginsAnswer<'a> {
    pub(super) fn of_machine(machine: &'a Machine, found: &'a MachineMargins) -> Self {
        let nearest =
            found.nearest().map(|(of, direction, scaled)| NearestObject { parameter: &of.path, direction, scaled });
        Self {
            motion: MotionObject::of_machine(machine, &found.motion),
            parameters: found.numbers.iter().map(|number| ParameterObject::of_machine(machine, number)).collect(),
            nearest,
            motion_box: None,
        }
    }
}

impl<'a> ParameterObject<'a> {
    pub(crate) fn of_machine(machine: &'a Machine, number: &'a NumberMargin) -> Self {
        let [down, up] = number.ends().map(|(_, limit, event)| {
            let at = event.map(|event| event.point.value);
            let told = event.and_then(|event| Some((event, event.point.event?)));
            EndObject {
                limit,
                at,
                distance: at.map(|at| at - number.value),
                relative: at.filter(|_| number.value != 0.0).map(|at| (at - number.value) / number.value.abs()),
                event: told.map(|(event, kind)| MarginEvent {
                    kind: kind.name(),
                    fields: EventFields::of_machine(kind, (event.point.cycle.label, event.after.clone()), machine),
                }),
            }
        });
        Self { parameter: &number.path, value: number.value, scale: number.scale(), down, up }
    }
}

impl ParameterObject<'static> {
    pub(crate) fn new(margin: &ParameterMargin, units: &Units) -> Self {
        let scope = &margin.scope;
        let unit = units.of(scope.parameter);
        let end = |end: &MarginEnd, limit: f64| {
            let at = end.point.as_ref().and_then(|point| Some((point, point.event?)));
            EndObject {
                limit: limit * unit,
                at: at.map(|_| end.value * unit),
                distance: at.map(|_| end.distance(scope) * unit),
                relative: at.and_then(|_| end.relative(scope)),
                event: at.map(|(point, event)| MarginEvent::new(EventRecord::of(point, &event))),
            }
        };
        Self {
            parameter: units.name_of(scope.parameter),
            value: scope.value * unit,
            scale: scope.scale * unit,
            down: end(&margin.down, scope.low),
            up: end(&margin.up, scope.high),
        }
    }
}

impl BoxObject {
    fn new(found: &MotionBox, parameters: &[ParameterMargin], units: &Units) -> Self {
        let names = || parameters.iter().map(|margin| (margin, units.of(margin.scope.parameter)));
        let range = |(margin, unit): (&ParameterMargin, f64)| RangeObject {
            parameter: units.name_of(margin.scope.parameter),
            from: margin.scope.at(-found.size) * unit,
            to: margin.scope.at(found.size) * unit,
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
                parameters: names()
                    .zip(&edge.values)
                    .map(|((margin, unit), value)| ValueObject {
                        parameter: units.name_of(margin.scope.parameter),
                        value: value * unit,
                    })
                    .collect(),
            }),
        }
    }
}
