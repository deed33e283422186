//! The nearest events of a motion in each parameter, and the box of parameters in which the motion was found.

use super::branch::EventFields;
use super::motion::MotionObject;
use crate::Units;
use crate::solutions::{MarginEndView, MarginView, nearest};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact_study::{MotionBox, ParameterMargin};

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
struct ParameterObject<'a> {
    parameter: &'a str,
    value: f64,
    scale: f64,
    down: EndObject<'a>,
    up: EndObject<'a>,
}

/// The nearest event in one direction. Without one, the last four are `null`.
#[derive(JsonSchema, Serialize)]
struct EndObject<'a> {
    /// The end of the range in which events are looked for.
    limit: f64,
    at: Option<f64>,
    distance: Option<f64>,
    relative: Option<f64>,
    event: Option<MarginEvent<'a>>,
}

#[derive(JsonSchema, Serialize)]
struct MarginEvent<'a> {
    kind: &'static str,
    #[serde(flatten)]
    fields: EventFields<'a>,
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
    /// Of any system; `found_box` is the box around an oscillator's motion.
    pub(super) fn new(
        motion: MotionObject<'a>,
        margins: &[MarginView<'a>],
        found_box: Option<(&MotionBox, &[ParameterMargin], &Units)>,
    ) -> Self {
        let nearest = nearest(margins).map(|(of, end, nearest)| NearestObject {
            parameter: of.field,
            direction: end.direction,
            scaled: nearest.scaled,
        });
        Self {
            motion,
            parameters: margins.iter().map(ParameterObject::new).collect(),
            nearest,
            motion_box: found_box.map(|(found, parameters, units)| BoxObject::new(found, parameters, units)),
        }
    }
}

impl<'a> ParameterObject<'a> {
    fn new(of: &MarginView<'a>) -> Self {
        let [down, up] = of.ends.each_ref().map(EndObject::new);
        Self { parameter: of.field, value: of.value, scale: of.scale, down, up }
    }
}

impl<'a> EndObject<'a> {
    fn new(end: &MarginEndView<'a>) -> Self {
        let nearest = end.nearest.as_ref();
        Self {
            limit: end.limit,
            at: nearest.map(|of| of.at),
            distance: nearest.map(|of| of.distance),
            relative: nearest.and_then(|of| of.relative),
            event: nearest.map(|of| MarginEvent { kind: of.event.name(), fields: EventFields::new(&of.event) }),
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
