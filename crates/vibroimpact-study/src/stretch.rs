//! A number and its range.

use crate::name::{Name, Written, renamed};
use crate::{BodyNumber, Parameter, PlanError, SystemPlan};
use core::ops::RangeInclusive;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Serialize, Serializer};
use vibroimpact::continuation::Frame;

/// A number from one value to another; as the side of a plane, to a larger one.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound = "V: Name")]
#[schemars(rename = "Stretch", bound = "V: Name", transform = either_key)]
pub struct Stretch<V = Parameter> {
    /// The parameter of an oscillator; `path` is that of a number of a machine.
    #[serde(with = "crate::name", alias = "path")]
    #[schemars(with = "Written")]
    pub parameter: V,
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
}

/// A number that varies from its value in the system to another one.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound = "V: Name")]
#[schemars(rename = "Target", bound = "V: Name", transform = either_key)]
pub struct Target<V = Parameter> {
    /// The parameter of an oscillator; `path` is that of a number of a machine.
    #[serde(with = "crate::name", alias = "path")]
    #[schemars(with = "Written")]
    pub parameter: V,
    /// Where it goes.
    pub to: f64,
}

/// The schema of a table whose number is called `parameter` or `path`.
fn either_key(schema: &mut schemars::Schema) {
    if let Some(properties) = schema.get_mut("properties").and_then(|properties| properties.as_object_mut()) {
        let number = properties.get("parameter").cloned().unwrap_or_default();
        properties.insert("path".to_owned(), number);
    }
    if let Some(required) = schema.get_mut("required").and_then(|required| required.as_array_mut()) {
        required.retain(|name| name != "parameter");
    }
}

impl<V: Name> Serialize for Stretch<V> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut table = to.serialize_struct("Stretch", 3)?;
        table.serialize_field(self.parameter.key(), self.parameter.text())?;
        table.serialize_field("from", &self.from)?;
        table.serialize_field("to", &self.to)?;
        table.end()
    }
}

impl<V: Name> Serialize for Target<V> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut table = to.serialize_struct("Target", 2)?;
        table.serialize_field(self.parameter.key(), self.parameter.text())?;
        table.serialize_field("to", &self.to)?;
        table.end()
    }
}

renamed!(Stretch: names parameter, parts, others from to);
renamed!(Target: names parameter, parts, others to);

impl Stretch {
    /// Its values.
    pub(crate) const fn range(&self) -> RangeInclusive<f64> {
        self.from..=self.to
    }

    /// The plane of this parameter and another one: of a body if one of them is a number of a body.
    pub(crate) fn frame(&self, other: &Self, system: &SystemPlan) -> Result<Frame, PlanError> {
        let (one, two) = (self.parameter, other.parameter);
        let plane = match (one.of_oscillator().zip(two.of_oscillator()), system.body) {
            (Some(parameters), _) => parameters.into(),
            (None, Some(body)) => body.plane((one, two))?,
            (None, None) => {
                return Err(PlanError::NoBody(self.of_body().or(other.of_body()).map_or("", BodyNumber::name)));
            }
        };
        Ok(Frame { plane, ranges: (self.range(), other.range()) })
    }

    /// The number of a body that varies, if it is one.
    pub(crate) const fn of_body(&self) -> Option<BodyNumber> {
        self.parameter.of_body()
    }
}

/// Minimum width of a side of a plane, relative to its values. Such a side holds about 100 000 doubles, and an edge of
/// a polygon, a 200th of it, holds hundreds.
const NARROW: f64 = 2e-11;
/// Minimum absolute width. The square of its inverse does not overflow.
const NARROWEST: f64 = 1e-100;

/// Checks that the ranges of two parameters span a plane of valid systems.
pub(crate) fn check_plane(system: &SystemPlan, one: &Stretch, two: &Stretch) -> Result<(), PlanError> {
    for stretch in [one, two] {
        if !(stretch.from.is_finite() && stretch.to.is_finite() && stretch.from < stretch.to) {
            return Err(PlanError::no_range(stretch.parameter.name(), (stretch.from, stretch.to)));
        }
        let least = (NARROW * stretch.from.abs().max(stretch.to.abs())).max(NARROWEST);
        if stretch.to - stretch.from < least {
            let Stretch { parameter, from, to } = stretch;
            let why = "is too narrow a range to follow curves through: rounding leaves no steps in it";
            // slightly more, because the message prints it with two digits
            let hint = format!("a width of at least {:.1e}", 1.05 * least);
            return Err(PlanError::refused(format!(
                "{} from {from:?} to {to:?} {why}\nhint: {hint}",
                parameter.name()
            )));
        }
    }
    let (p, q) = (one.parameter, two.parameter);
    if p.same_number(q) {
        return Err(PlanError::SameParameter(p.name().into(), q.name().into()));
    }
    for (own, other) in [(p, two), (q, one)] {
        let scaled = matches!(own, Parameter::Beta | Parameter::InverseBeta | Parameter::Gap | Parameter::SecondGap);
        if let (true, Some(number)) = (scaled, other.of_body()) {
            let (own, number) = (own.name(), number.name());
            let why = format!("{own} is measured in units that change with the numbers of the body");
            let hint = format!("take frequency_hz, gap_m or second_gap_m instead of {own}");
            return Err(PlanError::refused(format!("{own} and {number} do not span a plane: {why}\nhint: {hint}")));
        }
    }
    for x in [one.from, one.to] {
        for y in [two.from, two.to] {
            system.with_all([(p, x), (q, y)])?.oscillator()?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_that_make_no_sense() {
        let system = SystemPlan::from_inverse_beta(1.3, 0.0, 0.5);
        let over = |parameter, from, to| Stretch { parameter, from, to };
        let gap = over(Parameter::Gap, -1.0, 5.0);
        assert_eq!(check_plane(&system, &over(Parameter::InverseBeta, 0.4, 2.0), &gap), Ok(()));
        for (one, two, sentence) in [
            (over(Parameter::Beta, 2.0, 1.0), gap, "beta from 2 to 1 is no range"),
            (over(Parameter::Beta, 2.0, f64::NAN), gap, "beta from 2 to NaN is no range"),
            (over(Parameter::Beta, 1.0, 1.0 + 1e-13), gap, "beta from 1.0 to 1.0000000000001 is too narrow a range"),
            (over(Parameter::Gap, 0.0, 1e-300), gap, "gap from 0.0 to 1e-300 is too narrow"),
            (gap, gap, "gap and gap do not span a plane"),
            (over(Parameter::Beta, 1.0, 2.0), over(Parameter::InverseBeta, 1.0, 2.0), "beta and inverse_beta do not"),
            (gap, over(Parameter::Restitution, 0.5, 1.5), "restitution eps = 1.5"),
            (gap, over(Parameter::SecondGap, 0.5, 1.5), "second_gap is to vary, but there is no second stop"),
        ] {
            let message = check_plane(&system, &one, &two).unwrap_err().to_string();
            assert!(message.starts_with(sentence), "{message}");
            if let Some((_, least)) = message.split_once("a width of at least ") {
                let wide = over(one.parameter, one.from, one.from + least.parse::<f64>().unwrap());
                let narrow = check_plane(&system, &wide, &two).is_err_and(|error| error.to_string().contains("narrow"));
                assert!(least.len() < 9 && !narrow, "{message}");
            }
        }
    }
}
