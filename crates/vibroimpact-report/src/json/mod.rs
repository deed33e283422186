//! The JSON objects, one file for each command. Numbers that are not finite are `null`.

mod answer;
pub mod branch;
pub mod event;
pub mod motion;
pub(crate) mod quantities;
pub(crate) mod system;

use crate::units::given;
use crate::{Units, Varied};
use event::StateObject;
use schemars::JsonSchema;
use serde::Serialize;
use system::SystemObject;
use vibroimpact_study::{Axis, Cut, Span, Stretch, Values};

/// The object that a command prints: the system, the start, the fields of the command, and the plan.
#[derive(JsonSchema, Serialize)]
pub(crate) struct Document<'a, T, P> {
    pub(crate) system: SystemObject<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) start: Option<StateObject<'a>>,
    /// Whether numbers are nondimensional or in SI units; absent for machines, whose units are those of their numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) units: Option<&'static str>,
    #[serde(flatten)]
    pub(crate) result: T,
    /// The plan, which gives the same answer again (`vibro run`); `vibro schema` prints its fields.
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub(crate) plan: &'a P,
    pub(crate) program: &'static str,
}

/// `A:B:N` as an object, in the units of the results.
#[derive(Clone, Copy, JsonSchema, Serialize)]
pub(crate) struct Range {
    from: f64,
    to: f64,
    count: u32,
    #[serde(skip_serializing_if = "core::ops::Not::not")]
    logarithmic: bool,
}

impl Range {
    pub(crate) fn new(span: &Span, unit: f64) -> Self {
        let (from, to) = span.ends();
        let logarithmic = span.is_logarithmic();
        Self { from: given(from, unit), to: given(to, unit), count: span.count(), logarithmic }
    }
}

/// The second parameter of a line, with its values at both ends.
#[derive(JsonSchema, Serialize)]
pub(crate) struct Pair {
    parameter: String,
    from: f64,
    to: f64,
}

impl Pair {
    /// In the units of the results.
    pub(crate) fn of<V: Varied>(cut: &Cut<V>, units: &Units) -> Option<Self> {
        let Stretch { parameter, from, to } = cut.also.as_ref()?;
        let unit = parameter.unit(units);
        Some(Self { parameter: parameter.field(units).to_owned(), from: given(*from, unit), to: given(*to, unit) })
    }
}

/// The values of an axis.
#[derive(JsonSchema, Serialize)]
#[serde(untagged)]
pub(crate) enum Place {
    Over(Range),
    Listed(Vec<f64>),
}

/// An axis: the path of what varies, and its values.
#[derive(JsonSchema, Serialize)]
pub(crate) struct AxisObject {
    vary: String,
    over: Place,
}

impl AxisObject {
    /// All axes, in the units of the results.
    pub(crate) fn all<V: Varied>(axes: &[Axis<V>], units: &Units) -> Vec<Self> {
        let object = |axis: &Axis<V>| Self {
            vary: axis.vary.field(units).to_owned(),
            over: Place::over(&axis.over, axis.vary.unit(units)),
        };
        axes.iter().map(object).collect()
    }
}

impl Place {
    pub(crate) fn over(values: &Values, unit: f64) -> Self {
        match values {
            Values::Span(span) => Self::Over(Range::new(span, unit)),
            Values::Listed(list) => Self::Listed(list.iter().map(|value| given(*value, unit)).collect()),
        }
    }
}

pub use answer::{schema, verbs};
