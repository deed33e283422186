//! The range of a parameter in which events are looked for, and its scale in the box.

use crate::name::{Name, Variable, renamed};
use crate::{BodyNumber, Parameter, PlanError, SystemPlan};
use core::fmt;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

/// A number that varies, and its scale in the box. Without a scale, the path of a number of a machine is written alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledParameter<V = Parameter> {
    /// The number.
    pub parameter: V,
    /// The change of the number that counts as 1; its absolute value when absent.
    pub scale: Option<f64>,
}

/// A number with its scale as it is written.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ScaledText {
    #[serde(alias = "path")]
    parameter: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scale: Option<f64>,
}

renamed!(ScaledParameter: names parameter, parts, others scale);

impl<V: Name> Serialize for ScaledParameter<V> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.parameter.key() == "path" && self.scale.is_none() {
            return self.parameter.text().serialize(to);
        }
        ScaledText { parameter: self.parameter.text().to_owned(), scale: self.scale }.serialize(to)
    }
}

impl<'de, V: Name> Deserialize<'de> for ScaledParameter<V> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = ScaledText;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name, or a table with `parameter` and `scale`")
            }

            fn visit_str<E>(self, text: &str) -> Result<ScaledText, E> {
                Ok(ScaledText { parameter: text.to_owned(), scale: None })
            }

            fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<ScaledText, A::Error> {
                ScaledText::deserialize(MapAccessDeserializer::new(table))
            }
        }
        let ScaledText { parameter, scale } = from.deserialize_any(Either)?;
        Ok(Self { parameter: V::of(&parameter).map_err(D::Error::custom)?, scale })
    }
}

impl<V: Name> JsonSchema for ScaledParameter<V> {
    fn schema_name() -> Cow<'static, str> {
        "ScaledParameter".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (name, table) = (Variable::json_schema(generator), generator.subschema_for::<ScaledText>());
        schemars::json_schema!({ "anyOf": [name, table] })
    }
}

/// A number that varies: its value, its range and its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scope<V = Parameter> {
    /// The number.
    pub parameter: V,
    /// Its value in the system.
    pub value: f64,
    /// Lower end of the range.
    pub low: f64,
    /// Upper end of the range.
    pub high: f64,
    /// The change that counts as 1 in the box.
    pub scale: f64,
}

/// Of the distance between two stops, this part remains at the end of the range of a gap.
const ROOM: f64 = 0.01;
/// The smallest and the largest frequency ratio.
const RATIOS: (f64, f64) = (1e-15, 1e15);

impl Scope {
    /// The range and the scale of a parameter. A value 0 has no ratio to other values: a gap of 0 has the scale 1, and
    /// a damping of 0 the scale 0.1; the range then extends by the scale times `within - 1`. A restitution has the
    /// range 0 to 1.
    pub(crate) fn new(system: &SystemPlan, varied: ScaledParameter, within: f64) -> Result<Self, PlanError> {
        let ScaledParameter { parameter, scale } = varied;
        let value = system.value(parameter)?;
        let usual = match parameter {
            _ if value != 0.0 => value.abs(),
            Parameter::Damping | Parameter::Body(BodyNumber::DampingRatio) => 0.1,
            Parameter::Body(of) if of.unit() == "m" => system.scales().map_or(1.0, |scales| scales.length),
            _ => 1.0,
        };
        let (low, high) = match parameter {
            Parameter::Restitution | Parameter::SecondRestitution => (0.0, 1.0),
            _ if value == 0.0 => (-usual * (within - 1.0), usual * (within - 1.0)),
            _ => ((value / within).min(value * within), (value / within).max(value * within)),
        };
        let (low, high) = match parameter {
            Parameter::Damping => (low.max(0.0), high.min(RATIOS.1)),
            Parameter::Beta | Parameter::InverseBeta => (low.max(RATIOS.0), high.min(RATIOS.1)),
            Parameter::Body(BodyNumber::DampingCoefficient | BodyNumber::DampingRatio) => (low.max(0.0), high),
            // the two stops may not touch
            Parameter::Body(BodyNumber::Gap | BodyNumber::SecondGap) => {
                let sum = |of: BodyNumber| system.value(Parameter::Body(of)).ok();
                match sum(BodyNumber::Gap).zip(sum(BodyNumber::SecondGap)) {
                    Some((one, two)) => (low.max(value - (1.0 - ROOM) * (one + two)), high),
                    None => (low, high),
                }
            }
            Parameter::Gap | Parameter::SecondGap => match system.second_stop {
                Some(stop) => (low.max(value - (1.0 - ROOM) * (system.gap + stop.gap)), high),
                None => (low, high),
            },
            _ => (low, high),
        };
        // rounding may move an end past the value
        Ok(Self { parameter, value, low: low.min(value), high: high.max(value), scale: scale.unwrap_or(usual) })
    }

    /// Whether no system has a value beyond this end of the range.
    fn legal_end(&self, end: f64) -> bool {
        match self.parameter {
            Parameter::Restitution | Parameter::SecondRestitution => true,
            Parameter::Damping | Parameter::Body(BodyNumber::DampingCoefficient | BodyNumber::DampingRatio) => {
                end == 0.0
            }
            _ => false,
        }
    }

    /// The largest size of a box, in units of the scale, that stays in the range. A box may extend beyond the values
    /// that a parameter can have; it is cut off there. Infinite if the range has only such ends.
    pub(super) fn largest(&self) -> f64 {
        let room = |end: f64| if self.legal_end(end) { f64::INFINITY } else { (end - self.value).abs() / self.scale };
        room(self.low).min(room(self.high))
    }

    /// The size of a box, in units of the scale, that reaches the end of the range which is farther away.
    pub(super) fn farthest(&self) -> f64 {
        (self.high - self.value).max(self.value - self.low) / self.scale
    }
}

impl<V> Scope<V> {
    /// The value at a distance from the value of the system, in units of the scale, and not beyond the range.
    #[must_use]
    pub fn at(&self, distance: f64) -> f64 {
        (self.value + distance * self.scale).clamp(self.low, self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SecondStop;

    fn scope(system: &SystemPlan, parameter: Parameter) -> Scope {
        Scope::new(system, ScaledParameter { parameter, scale: None }, 2.0).unwrap()
    }

    #[test]
    fn half_to_twice_and_what_is_possible() {
        let stop = SecondStop { gap: 0.25, restitution: 0.0 };
        let system = SystemPlan { beta: Some(0.8), gap: -0.2, restitution: 0.65, ..SystemPlan::default() };
        let beta = scope(&system, Parameter::Beta);
        assert_eq!((beta.low, beta.high, beta.scale, beta.largest()), (0.4, 1.6, 0.8, 0.5));
        let gap = scope(&system, Parameter::Gap);
        assert_eq!((gap.low, gap.high, gap.scale), (-0.4, -0.1, 0.2));
        let damping = scope(&system, Parameter::Damping);
        assert_eq!((damping.low, damping.high, damping.scale, damping.largest()), (0.0, 0.1, 0.1, 1.0));
        let restitution = scope(&system, Parameter::Restitution);
        assert_eq!((restitution.low, restitution.high, restitution.largest()), (0.0, 1.0, f64::INFINITY));
        assert_eq!((restitution.at(1.0), restitution.at(-2.0), restitution.farthest()), (1.0, 0.0, 1.0));
        // both ends are legal systems
        let two = SystemPlan { second_stop: Some(stop), ..system };
        for parameter in [Parameter::Gap, Parameter::SecondGap, Parameter::SecondRestitution, Parameter::Damping] {
            let scope = scope(&two, parameter);
            for end in [scope.low, scope.high] {
                assert!(two.with(parameter, end).unwrap().oscillator().is_ok(), "{scope:?}");
            }
        }
        assert_eq!(scope(&SystemPlan { gap: 0.0, ..system }, Parameter::Gap).low, -1.0);
    }
}
