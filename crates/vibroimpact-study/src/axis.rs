//! An axis of a grid: the quantity that varies and the values that it takes.

use crate::limits::MOST_CELLS;
use crate::name::{Name, Renamed, Variable, renamed};
use crate::{Parameter, PlanError, Span, StartPlan, SystemPlan, Unit, counted};
use core::fmt;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::borrow::Cow;
use vibroimpact::math::sort_by;

/// The quantity that varies along an axis: a parameter of the system or a coordinate of the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinate {
    /// A parameter of the system.
    Parameter(Parameter),
    /// The position of the start.
    X,
    /// The velocity of the start.
    V,
    /// The phase of the force at the start.
    Phase,
}

impl From<Coordinate> for Cow<'static, str> {
    fn from(coordinate: Coordinate) -> Self {
        coordinate.name().into()
    }
}

impl Coordinate {
    /// Gives a coordinate of a start this value; a parameter leaves the start as it is.
    pub(crate) fn place(self, start: &mut StartPlan, value: impl FnOnce() -> f64) {
        match self {
            Self::Parameter(_) => {}
            Self::X => start.x = Some(value()),
            Self::V => start.v = value(),
            Self::Phase => start.phase = value(),
        }
    }

    /// Its name in plans; also the name of the dimension in a store.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parameter(parameter) => parameter.name(),
            Self::X => "x",
            Self::V => "v",
            Self::Phase => "phase",
        }
    }

    /// The coordinate with this name, if there is one.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let own = [Self::X, Self::V, Self::Phase].into_iter().find(|coordinate| coordinate.name() == name);
        own.or_else(|| Parameter::from_name(name).map(Self::Parameter))
    }

    /// One line of text that describes it.
    #[must_use]
    pub const fn long_name(self) -> &'static str {
        match self {
            Self::Parameter(Parameter::Beta) => "frequency ratio beta = omega / omega_n",
            Self::Parameter(Parameter::InverseBeta) => "inverse frequency ratio 1 / beta = omega_n / omega",
            Self::Parameter(Parameter::Gap) => "gap delta of the stop",
            Self::Parameter(Parameter::Restitution) => "coefficient of restitution eps",
            Self::Parameter(Parameter::Damping) => "damping ratio zeta",
            Self::Parameter(Parameter::SecondGap) => "gap of the second stop",
            Self::Parameter(Parameter::SecondRestitution) => "coefficient of restitution of the second stop",
            Self::Parameter(Parameter::Body(number)) => number.description(),
            Self::X => "position of the start",
            Self::V => "velocity of the start",
            Self::Phase => "phase of the force at the start",
        }
    }

    /// Its unit.
    #[must_use]
    pub const fn unit(self) -> Unit {
        match self {
            Self::Parameter(Parameter::Gap | Parameter::SecondGap) | Self::X => Unit::LENGTH,
            Self::V => Unit::VELOCITY,
            Self::Phase => Unit::ANGLE,
            Self::Parameter(Parameter::Body(number)) => Unit::of_body(number),
            Self::Parameter(_) => Unit::NUMBER,
        }
    }

    /// Whether it is a coordinate of the start (as opposed to a parameter of the system).
    pub(crate) const fn is_start(self) -> bool {
        !matches!(self, Self::Parameter(_))
    }
}

/// The values of an axis: a range as text, `A:B:N` or `A:B:N:log`, or a list of numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Values {
    /// A range.
    Span(Span),
    /// A list of values, in the given order.
    Listed(Vec<f64>),
}

/// Maximum number of values in a list.
const MOST_LISTED: u64 = 1_000_000;

impl Values {
    /// Value number `k`, counted from 0.
    ///
    /// # Panics
    /// If there is no such value.
    #[must_use]
    pub fn at(&self, k: usize) -> f64 {
        match self {
            Self::Span(span) => span.at(u32::try_from(k).unwrap_or(u32::MAX)),
            Self::Listed(values) => values[k],
        }
    }

    /// The number of values.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Span(span) => span.count() as usize,
            Self::Listed(values) => values.len(),
        }
    }

    /// All values, in order.
    #[must_use]
    pub fn all(&self) -> Vec<f64> {
        (0..self.count()).map(|k| self.at(k)).collect()
    }

    /// The first and the last value, in the given order; not-a-number for an empty list, which [`Self::check`] refuses.
    #[must_use]
    pub fn ends(&self) -> (f64, f64) {
        match self {
            Self::Span(span) => span.ends(),
            Self::Listed(values) => {
                let end = |value: Option<&f64>| value.copied().unwrap_or(f64::NAN);
                (end(values.first()), end(values.last()))
            }
        }
    }

    /// Whether the values rise or fall, as those of a range do.
    #[must_use]
    pub fn in_order(&self) -> bool {
        match self {
            Self::Span(_) => true,
            Self::Listed(values) => values.is_sorted() || values.is_sorted_by(|a, b| a >= b),
        }
    }

    /// The same values, each divided by `unit`.
    ///
    /// # Errors
    /// As [`Span::scaled`]; a list is checked by [`Self::check`].
    pub fn scaled(&self, unit: f64) -> Result<Self, PlanError> {
        Ok(match self {
            Self::Span(span) => Self::Span(span.scaled(unit)?),
            Self::Listed(values) => Self::Listed(values.iter().map(|value| value / unit).collect()),
        })
    }

    /// The smallest and the largest value.
    #[must_use]
    pub fn extent(&self) -> (f64, f64) {
        match self {
            Self::Span(span) => (span.ends().0.min(span.ends().1), span.ends().0.max(span.ends().1)),
            Self::Listed(values) => {
                values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
            }
        }
    }

    /// Checks a list. A range is checked when it is made.
    ///
    /// # Errors
    /// [`PlanError`] for a list that is empty or too long, or contains a value that is not finite or occurs
    /// twice.
    pub fn check(&self) -> Result<(), PlanError> {
        let Self::Listed(values) = self else { return Ok(()) };
        let bad = |wrong: &str| {
            let given = counted(values.len() as u64, "value");
            let allowed = format!("allowed are 1 to {MOST_LISTED} finite numbers, none of them twice{wrong}");
            PlanError::refused(format!("a list of {given} was given: {allowed}"))
        };
        if values.is_empty() || values.len() as u64 > MOST_LISTED {
            return Err(bad(""));
        }
        let mut sorted = values.clone();
        sort_by(&mut sorted, f64::total_cmp);
        let twice = sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0]);
        match values.iter().copied().find(|v| !v.is_finite()).or(twice) {
            Some(value) => Err(bad(&format!(", not {value}"))),
            None => Ok(()),
        }
    }
}

impl From<Span> for Values {
    fn from(span: Span) -> Self {
        Self::Span(span)
    }
}

impl schemars::JsonSchema for Values {
    fn schema_name() -> Cow<'static, str> {
        "Values".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let span = generator.subschema_for::<Span>();
        schemars::json_schema!({ "anyOf": [span, { "type": "array", "items": { "type": "number" }, "minItems": 1 }] })
    }
}

impl<'de> Deserialize<'de> for Values {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Values;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a range \"A:B:N\" or \"A:B:N:log\", or a list of numbers")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Values, E> {
                text.parse().map(Values::Span).map_err(E::custom)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Values, A::Error> {
                let mut values = Vec::new();
                while let Some(value) = items.next_element::<f64>()? {
                    values.push(value);
                }
                Ok(Values::Listed(values))
            }
        }
        from.deserialize_any(Either)
    }
}

/// What varies over which values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Axis")]
pub struct Axis<V = Coordinate> {
    /// What varies.
    pub vary: V,
    /// Its values.
    pub over: Values,
}

renamed!(Axis: names vary, parts, others over);

impl<V> Axis<V> {
    /// The values of all axes at point number `k` of their grid; the first axis varies fastest.
    #[must_use]
    pub fn at(axes: &[Self], mut k: u64) -> Vec<f64> {
        let value = |axis: &Self| {
            let count = axis.over.count() as u64;
            let value = axis.over.at(usize::try_from(k % count).unwrap_or(0));
            k /= count;
            value
        };
        axes.iter().map(value).collect()
    }
}

impl Axis {
    /// An axis over a range.
    #[must_use]
    pub fn new(vary: Coordinate, over: impl Into<Values>) -> Self {
        Self { vary, over: over.into() }
    }

    /// An axis over the values of a parameter.
    #[must_use]
    pub fn parameter(parameter: Parameter, over: impl Into<Values>) -> Self {
        Self::new(Coordinate::Parameter(parameter), over)
    }
}

/// What can vary in a study, as its coordinates are described.
pub(crate) trait Described: Name {
    /// One line of text that describes it.
    fn described(&self) -> Cow<'static, str>;
    /// Its unit.
    fn in_unit(&self) -> Unit;
}

impl Described for Coordinate {
    fn described(&self) -> Cow<'static, str> {
        self.long_name().into()
    }

    fn in_unit(&self) -> Unit {
        self.unit()
    }
}

impl Described for Parameter {
    fn described(&self) -> Cow<'static, str> {
        Coordinate::Parameter(*self).described()
    }

    fn in_unit(&self) -> Unit {
        Coordinate::Parameter(*self).unit()
    }
}

/// The path of a number of a machine, or of a part of its start.
impl Described for String {
    fn described(&self) -> Cow<'static, str> {
        Cow::Owned(match self.split_once('.') {
            Some(("q", name)) => format!("coordinate {name} of the start"),
            Some(("qdot", name)) => format!("velocity of {name} at the start"),
            None if self == "phase" => "phase of the forcing at the start".to_owned(),
            _ => format!("{self} of the machine"),
        })
    }

    fn in_unit(&self) -> Unit {
        Unit::CONSISTENT
    }
}

/// Axes with the names of a system.
///
/// # Errors
/// [`PlanError::Name`] for a name that the system does not have.
pub fn typed_axes<W: Name>(axes: &[Axis<Variable>]) -> Result<Vec<Axis<W>>, PlanError> {
    axes.iter().map(|axis| axis.named(&|name: &Variable| W::of(name.text()))).collect()
}

/// Checks that one run can keep the results of so many points in memory; a store has no such limit.
pub(crate) fn check_memory<V>(what: &'static str, axes: &[Axis<V>]) -> Result<(), PlanError> {
    if points(axes) <= MOST_CELLS {
        return Ok(());
    }
    let (first, others) = axes.split_at(axes.len().min(1));
    Err(PlanError::Size { what, columns: points(first), rows: points(others), most: MOST_CELLS })
}

/// The system at a point of the axes: values on an axis replace those of `system`. `index(k)` is the place on axis `k`.
pub(crate) fn system_at(
    system: &SystemPlan,
    axes: &[Axis],
    index: impl Fn(usize) -> usize,
) -> Result<SystemPlan, PlanError> {
    let value = |(k, axis): (usize, &Axis)| match axis.vary {
        Coordinate::Parameter(parameter) => Some((parameter, axis.over.at(index(k)))),
        _ => None,
    };
    system.with_all(axes.iter().enumerate().filter_map(value))
}

/// The start at a point of the axes: values on an axis replace those of `start`. `index(k)` is the place on axis `k`.
/// Positions and velocities are in the units of `system`, that of the plan. The result is in the units of `there`, the
/// system at the point: in a body whose force, mass or stiffness varies, the start is held in SI units.
pub(crate) fn start_at(
    (system, there): (&SystemPlan, &SystemPlan),
    start: &StartPlan,
    axes: &[Axis],
    index: impl Fn(usize) -> usize,
) -> StartPlan {
    let mut start = *start;
    for (k, axis) in axes.iter().enumerate() {
        axis.vary.place(&mut start, || axis.over.at(index(k)));
    }
    let (x, v) = system.state_in(there, (start.x.unwrap_or(0.0), start.v));
    StartPlan { x: start.x.map(|_| x), v, ..start }
}

/// Checks the number of the axes and their values, and that none occurs twice.
pub(crate) fn check<V: Name>(
    task: &'static str,
    axes: &[Axis<V>],
    (least, most): (usize, usize),
) -> Result<(), PlanError> {
    if !(least..=most).contains(&axes.len()) {
        return Err(PlanError::Axes { given: axes.len(), task, least, most });
    }
    axes.iter().try_for_each(|axis| axis.over.check())?;
    none_twice(axes.iter().map(|axis| axis.vary.clone()))
}

/// Checks that nothing varies twice.
pub(crate) fn none_twice<V: Name>(varied: impl IntoIterator<Item = V>) -> Result<(), PlanError> {
    let varied: Vec<V> = varied.into_iter().collect();
    for (k, one) in varied.iter().enumerate() {
        if let Some(other) = varied[..k].iter().find(|other| other.same_as(one)) {
            let name = |of: &V| of.text().to_owned().into();
            return Err(PlanError::SameParameter(name(other), name(one)));
        }
    }
    Ok(())
}

/// Number of points of the grid over the axes; `u64::MAX` if it is larger.
pub(crate) fn points<V>(axes: &[Axis<V>]) -> u64 {
    axes.iter().fold(1, |points, axis| u64::saturating_mul(points, axis.over.count() as u64))
}

/// All combinations of the smallest and largest values of the axes, as indices of the values.
pub(crate) fn corners(axes: &[Axis]) -> impl Iterator<Item = Vec<usize>> + '_ {
    let ends = axes.iter().map(|axis| {
        let by = |a: &usize, b: &usize| axis.over.at(*a).total_cmp(&axis.over.at(*b));
        let all = 0..axis.over.count();
        [all.clone().min_by(by).unwrap_or(0), all.max_by(by).unwrap_or(0)]
    });
    let ends: Vec<[usize; 2]> = ends.collect();
    (0..1_u32 << ends.len())
        .map(move |bits| ends.iter().enumerate().map(|(k, e)| e[(bits >> k & 1) as usize]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_axis_is_refused() {
        for (text, word) in [
            (r#"{"vary":"mass","over":"0:1:2"}"#, "`mass` cannot vary; what can is beta"),
            (r#"{"vary":"mass_g","over":"0:1:2"}"#, "second_restitution, mass_kg, stiffness_n_per_m"),
            (r#"{"vary":"v","over":"0:1"}"#, "A:B:N"),
            (r#"{"vary":"v","over":7}"#, "or a list of numbers"),
            (r#"{"vary":"v"}"#, "over"),
        ] {
            let read = serde_json::from_str::<Axis<Variable>>(text).map_err(|error| error.to_string());
            let typed = read.and_then(|axis| typed_axes::<Coordinate>(&[axis]).map_err(|error| error.to_string()));
            let message = typed.unwrap_err();
            assert!(message.contains(word), "{message}");
        }
    }

    #[test]
    fn lists_are_checked_and_the_corners_are_the_extremes() {
        for bad in [vec![], vec![1.0, f64::NAN], vec![2.0, 1.0, 2.0]] {
            assert!(Values::Listed(bad).check().is_err());
        }
        let axes = [
            Axis::new(Coordinate::X, Values::Listed(vec![0.0, 2.0, -1.0])),
            Axis::new(Coordinate::V, "3:1:3".parse::<Span>().unwrap()),
        ];
        let found: Vec<_> = corners(&axes).collect();
        assert_eq!(found, [[2, 2], [1, 2], [2, 0], [1, 0]]);
        assert_eq!(axes[0].over.extent(), (-1.0, 2.0));
    }
}
