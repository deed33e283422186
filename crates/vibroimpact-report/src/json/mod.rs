//! The JSON objects, one file for each command. Numbers that are not finite are `null`.

mod answer;
pub mod attractors;
pub mod basin;
pub mod branch;
mod certainty;
pub mod curve;
pub mod diagram;
pub(crate) mod edge;
pub mod event;
pub mod lyapunov;
pub mod map;
pub mod margins;
pub mod motion;
pub mod orbit;
pub(crate) mod quantities;
pub mod region;
pub mod response;
mod schema;
pub mod settle;
pub mod simulate;
pub(crate) mod system;

use crate::units::given;
use crate::{Asked, PROGRAM, Units, Varied};
use event::StateObject;
use schemars::JsonSchema;
use serde::Serialize;
use system::SystemObject;
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{Axis, Cut, Parameter, Plan, Span, Stretch, Values};

/// The object that a command prints: the system, the start, the fields of the command, and the plan.
#[derive(JsonSchema, Serialize)]
struct Document<'a, T, P> {
    system: SystemObject<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StateObject<'a>>,
    /// Whether numbers are nondimensional or in SI units; absent for machines, whose units are those of their numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    units: Option<&'static str>,
    #[serde(flatten)]
    result: T,
    /// The plan, which gives the same answer again (`vibro run`); `vibro schema` prints its fields.
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    plan: &'a P,
    program: &'static str,
}

impl<'a, T: Serialize> Document<'a, T, Plan> {
    /// An object of an oscillator with the fields of the command, over parameters that vary.
    fn over(asked: &Asked, osc: &Oscillator, varied: &[Parameter], plan: &'a Plan, result: T) -> Self {
        let system = SystemObject::of_oscillator(asked, osc, varied);
        Self { system, start: None, result, units: Some(asked.units.name()), plan, program: PROGRAM }
    }

    /// Adds the start of the motion.
    fn start(self, start: &Start, units: &Units) -> Self {
        Self { start: Some(StateObject::of_oscillator(start, units)), ..self }
    }
}

/// `A:B:N` as an object, in the units of the results.
#[derive(Clone, Copy, JsonSchema, Serialize)]
struct Range {
    from: f64,
    to: f64,
    count: u32,
    #[serde(skip_serializing_if = "core::ops::Not::not")]
    logarithmic: bool,
}

impl Range {
    fn new(span: &Span, unit: f64) -> Self {
        let (from, to) = span.ends();
        let logarithmic = span.is_logarithmic();
        Self { from: given(from, unit), to: given(to, unit), count: span.count(), logarithmic }
    }
}

/// The second parameter of a line, with its values at both ends.
#[derive(JsonSchema, Serialize)]
struct Pair {
    parameter: String,
    from: f64,
    to: f64,
}

impl Pair {
    /// In the units of the results.
    fn of<V: Varied>(cut: &Cut<V>, units: &Units) -> Option<Self> {
        let Stretch { parameter, from, to } = cut.also.as_ref()?;
        let unit = parameter.unit(units);
        Some(Self { parameter: parameter.field(units).to_owned(), from: given(*from, unit), to: given(*to, unit) })
    }
}

/// The values of an axis.
#[derive(JsonSchema, Serialize)]
#[serde(untagged)]
enum Place {
    Over(Range),
    Listed(Vec<f64>),
}

/// An axis: the path of what varies, and its values.
#[derive(JsonSchema, Serialize)]
struct AxisObject {
    vary: String,
    over: Place,
}

impl AxisObject {
    /// All axes, in the units of the results.
    fn all<V: Varied>(axes: &[Axis<V>], units: &Units) -> Vec<Self> {
        let object = |axis: &Axis<V>| Self {
            vary: axis.vary.field(units).to_owned(),
            over: Place::over(&axis.over, axis.vary.unit(units)),
        };
        axes.iter().map(object).collect()
    }
}

impl Place {
    fn over(values: &Values, unit: f64) -> Self {
        match values {
            Values::Span(span) => Self::Over(Range::new(span, unit)),
            Values::Listed(list) => Self::Listed(list.iter().map(|value| given(*value, unit)).collect()),
        }
    }
}

pub use motion::undecided;
pub use schema::{schema, verbs};
