//! The nearest events of a motion in each parameter, and the box of parameters in which the motion was found.

use super::branch::{Event, EventFields};
use super::motion::MotionObject;
use crate::figure::named;
use crate::{Units, Varied as _};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact_plot::plain;
use vibroimpact_study::{
    EventRecord, MachineMargins, MarginEnd, MotionBox, MotionMargins, NumberEvent, NumberMargin, ParameterMargin,
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

/// A number with its nearest events.
#[derive(JsonSchema, Serialize)]
pub struct ParameterObject<'a> {
    parameter: &'a str,
    /// Its value.
    pub value: f64,
    /// The change that counts as 1.
    pub scale: f64,
    down: EndObject<'a>,
    up: EndObject<'a>,
    /// Its name in tables, and in sentences and figures.
    #[serde(skip)]
    pub(crate) column: &'a str,
    /// Its name in sentences.
    #[serde(skip)]
    pub words: String,
    #[serde(skip)]
    pub(crate) axis: String,
}

/// The nearest event in one direction. Without one, the last four are `null`.
#[derive(JsonSchema, Serialize)]
pub struct EndObject<'a> {
    /// The end of the range in which events are looked for.
    pub limit: f64,
    /// The value at the event.
    pub at: Option<f64>,
    /// The change to it.
    pub distance: Option<f64>,
    /// The change relative to the size of the value; also `null` for a value of 0.
    pub relative: Option<f64>,
    /// The event.
    pub event: Option<MarginEvent<'a>>,
    /// The size of the change in units of the scale.
    #[serde(skip)]
    pub scaled: f64,
}

/// The nearest event.
#[derive(JsonSchema, Serialize)]
pub struct MarginEvent<'a> {
    /// Its kind.
    pub kind: &'static str,
    /// What does not depend on the branch.
    #[serde(flatten)]
    pub fields: EventFields<'a>,
    /// The event itself.
    #[serde(skip)]
    pub event: Event<'a>,
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

impl<'a> MarginsAnswer<'a> {
    /// Of any system. An oscillator has a box around its motion.
    pub(super) fn new(motion: MotionObject<'a>, parameters: Vec<ParameterObject<'a>>) -> Self {
        let found = nearest(&parameters).map(|(of, direction, end)| NearestObject {
            parameter: of.parameter,
            direction,
            scaled: end.scaled,
        });
        Self { motion, nearest: found, parameters, motion_box: None }
    }

    pub(super) fn of_oscillator(osc: &Oscillator, found: &'a MotionMargins, units: &Units) -> Self {
        let of_box = |of: &MotionBox| BoxObject::new(of, &found.parameters, units);
        let motion_box = found.motion_box.as_ref().map(of_box);
        Self { motion_box, ..Self::new(MotionObject::of_oscillator(&found.motion, osc, units), margins(found, units)) }
    }

    pub(super) fn of_machine(machine: &'a Machine, found: &'a MachineMargins) -> Self {
        Self::new(MotionObject::of_machine(machine, &found.motion), machine_margins(found, machine))
    }
}

/// The numbers of an oscillator with their nearest events.
#[must_use]
pub fn margins<'a>(found: &'a MotionMargins, units: &Units) -> Vec<ParameterObject<'a>> {
    found.parameters.iter().map(|margin| ParameterObject::of_oscillator(margin, units)).collect()
}

/// The numbers of a machine with their nearest events.
#[must_use]
pub fn machine_margins<'a>(found: &'a MachineMargins, machine: &'a Machine) -> Vec<ParameterObject<'a>> {
    found.numbers.iter().map(|number| ParameterObject::of_machine(machine, number)).collect()
}

/// The number, the direction and the event with the smallest change in units of the scale of its number.
#[must_use]
pub fn nearest<'v, 'a>(
    all: &'v [ParameterObject<'a>],
) -> Option<(&'v ParameterObject<'a>, &'static str, &'v EndObject<'a>)> {
    let ends = all.iter().flat_map(|of| of.ends().map(move |(direction, end)| (of, direction, end)));
    ends.filter(|(.., end)| end.event.is_some()).min_by(|a, b| a.2.scaled.total_cmp(&b.2.scaled))
}

impl<'a> ParameterObject<'a> {
    /// Both directions.
    #[must_use]
    pub const fn ends(&self) -> [(&'static str, &EndObject<'a>); 2] {
        [("down", &self.down), ("up", &self.up)]
    }

    fn of_machine(machine: &'a Machine, number: &'a NumberMargin) -> Self {
        let NumberMargin { path, value, .. } = number;
        let [down, up] = number.ends().map(|(_, limit, event)| {
            let at = event.map(|event| event.point.value);
            let event = event.and_then(|NumberEvent { point, after }| {
                let kind = point.event?;
                let fields = EventFields::of_machine(kind, (point.cycle.label, after.clone()), machine);
                Some(MarginEvent { kind: kind.name(), fields, event: Event::Machine(machine, kind) })
            });
            EndObject {
                limit,
                at,
                distance: at.map(|at| at - value),
                relative: at.filter(|_| *value != 0.0).map(|at| (at - value) / value.abs()),
                event,
                scaled: at.map_or(f64::NAN, |at| (at - value).abs() / number.scale()),
            }
        });
        let (words, axis) = (path.clone(), plain(path));
        Self { parameter: path, value: *value, scale: number.scale(), down, up, column: path, words, axis }
    }

    fn of_oscillator(margin: &'a ParameterMargin, units: &Units) -> Self {
        let scope = &margin.scope;
        let (parameter, unit) = (scope.parameter, units.of(scope.parameter));
        let end = |end: &'a MarginEnd, limit: f64| {
            let at = end.point.as_ref().and_then(|point| Some((point, point.event?)));
            let event = at.map(|(point, event)| MarginEvent {
                kind: event.name(),
                fields: EventFields::of_record(EventRecord::of(point, &event)),
                event: Event::Oscillator(point, event),
            });
            EndObject {
                limit: limit * unit,
                at: at.map(|_| end.value * unit),
                distance: at.map(|_| end.distance(scope) * unit),
                relative: at.and_then(|_| end.relative(scope)),
                event,
                scaled: end.distance(scope).abs() / scope.scale,
            }
        };
        Self {
            parameter: units.name_of(parameter),
            value: scope.value * unit,
            scale: scope.scale * unit,
            down: end(&margin.down, scope.low),
            up: end(&margin.up, scope.high),
            column: units.column_of(parameter),
            words: parameter.words(units),
            axis: named(parameter, units),
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
