//! Vectors and matrices as they are written.

use super::named::Named;
use super::number::{NumberText, Reader};
use core::fmt;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;

/// A vector: a list with a number for each coordinate, or a table of numbers for the names of coordinates, bodies and
/// points.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum VectorText {
    /// One number, for the place that another field names.
    One(NumberText),
    /// A number for each coordinate.
    List(Vec<NumberText>),
    /// Numbers for names.
    Named(Named<NumberText>),
}

/// A matrix: its diagonal, or its rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum MatrixText {
    /// The numbers on the diagonal; all others are 0.
    Diagonal(Vec<NumberText>),
    /// The rows.
    Rows(Vec<Vec<NumberText>>),
}

impl<'de> Deserialize<'de> for VectorText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Vector;
        impl<'de> Visitor<'de> for Vector {
            type Value = VectorText;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a number, a list of numbers or a table of names with numbers")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<VectorText, E> {
                Reader.visit_f64(value).map(VectorText::One)
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<VectorText, E> {
                Reader.visit_i64(value).map(VectorText::One)
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<VectorText, E> {
                Reader.visit_u64(value).map(VectorText::One)
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<VectorText, E> {
                Reader.visit_str(text).map(VectorText::One)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<VectorText, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(list)).map(VectorText::List)
            }

            fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<VectorText, A::Error> {
                Named::deserialize(MapAccessDeserializer::new(table)).map(VectorText::Named)
            }
        }
        deserializer.deserialize_any(Vector)
    }
}

/// A number or a row of a matrix.
enum Row {
    Number(NumberText),
    Row(Vec<NumberText>),
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match VectorText::deserialize(deserializer)? {
            VectorText::One(number) => Ok(Self::Number(number)),
            VectorText::List(list) => Ok(Self::Row(list)),
            VectorText::Named(_) => Err(D::Error::custom("a table, expected a number or a row of numbers")),
        }
    }
}

impl<'de> Deserialize<'de> for MatrixText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Matrix;
        impl<'de> Visitor<'de> for Matrix {
            type Value = MatrixText;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a list of rows, or the numbers on the diagonal")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<MatrixText, A::Error> {
                let (mut diagonal, mut rows) = (Vec::new(), Vec::new());
                while let Some(row) = list.next_element()? {
                    match row {
                        Row::Number(number) => diagonal.push(number),
                        Row::Row(row) => rows.push(row),
                    }
                    if !diagonal.is_empty() && !rows.is_empty() {
                        return Err(A::Error::custom("numbers and rows are mixed in one matrix"));
                    }
                }
                Ok(if rows.is_empty() { MatrixText::Diagonal(diagonal) } else { MatrixText::Rows(rows) })
            }
        }
        deserializer.deserialize_seq(Matrix)
    }
}

impl JsonSchema for VectorText {
    fn schema_name() -> Cow<'static, str> {
        "Vector".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let number = generator.subschema_for::<NumberText>();
        json_schema!({
            "description": "A list with a number for each coordinate, or a table of numbers for names; a number alone where `at` names the place",
            "anyOf": [
                number,
                { "type": "array", "items": number },
                { "type": "object", "additionalProperties": number }
            ]
        })
    }
}

impl JsonSchema for MatrixText {
    fn schema_name() -> Cow<'static, str> {
        "Matrix".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let number = generator.subschema_for::<NumberText>();
        json_schema!({
            "description": "The rows of a matrix, or the numbers on its diagonal",
            "anyOf": [
                { "type": "array", "items": { "type": "array", "items": number } },
                { "type": "array", "items": number }
            ]
        })
    }
}
