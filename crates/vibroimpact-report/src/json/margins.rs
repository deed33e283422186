//! The nearest events of a motion in each parameter, and the box of parameters in which the motion was found.

use super::branch::EventFields;
use super::event::Stops;
use super::motion::MotionObject;
use crate::Units;
use crate::answer::{AnswerOf, Told};
use crate::varied::Varied;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::continuation::BranchEvent;
use vibroimpact_study::{MotionBox, MotionMargins, ParameterMargin, PointOf, Scope, Solution};

/// The answer to `vibro margins`.
#[derive(JsonSchema, Serialize)]
pub(super) struct MarginsAnswer<'a> {
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
    pub(super) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a MotionMargins<D::System, D::Name, PointOf<D>>) -> Self {
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
