//! A number of a machine file: a value, or an expression of the parameters.

use super::expression::{self, ExpressionError};
use super::named::Named;
use core::fmt;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use std::borrow::Cow;

/// A number, or an expression of the parameters of the file such as `"1/(1+mu)"`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum NumberText {
    /// A value.
    Value(f64),
    /// An expression.
    Expression(String),
}

impl Default for NumberText {
    fn default() -> Self {
        Self::Value(0.0)
    }
}

impl From<f64> for NumberText {
    fn from(value: f64) -> Self {
        Self::Value(value)
    }
}

impl NumberText {
    /// The value.
    ///
    /// # Errors
    /// [`ExpressionError`] for an expression without a finite value.
    pub fn value(&self, parameters: &Named<f64>) -> Result<f64, ExpressionError> {
        match self {
            Self::Value(value) => Ok(*value),
            Self::Expression(text) => expression::evaluate(text, parameters),
        }
    }
}

impl<'de> Deserialize<'de> for NumberText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Reader)
    }
}

/// Reads one number.
pub(super) struct Reader;

impl Visitor<'_> for Reader {
    type Value = NumberText;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a number or an expression")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<NumberText, E> {
        Ok(NumberText::Value(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<NumberText, E> {
        Ok(NumberText::Value(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<NumberText, E> {
        Ok(NumberText::Value(value as f64))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<NumberText, E> {
        Ok(NumberText::Expression(text.to_owned()))
    }
}

impl JsonSchema for NumberText {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or an expression of the parameters such as \"1/(1+mu)\"",
            "type": ["number", "string"]
        })
    }
}
