//! Names in plans: of what varies, and of quantities. A plan has them as they are written; a task reads them as names of the
//! numbers of its system, an oscillator or a machine.

use crate::{Coordinate, Parameter, PlanError, Quantity, parameter_names};
use core::fmt;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

/// What varies in a plan, as its name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Variable {
    /// A parameter of an oscillator, or a coordinate of its start.
    Coordinate(Coordinate),
    /// The path of a number of a machine, or of its start.
    Path(String),
}

/// The name of something in a plan.
pub trait Name: Clone + PartialEq + fmt::Debug {
    /// The name as text.
    fn text(&self) -> &str;

    /// What has this name.
    ///
    /// # Errors
    /// [`PlanError::Name`] if nothing has.
    fn of(name: &str) -> Result<Self, PlanError>;

    /// Whether both are names of one number.
    fn same_as(&self, other: &Self) -> bool {
        self == other
    }

    /// The key of the name in a table of a range.
    #[must_use]
    fn key(&self) -> &'static str {
        "parameter"
    }
}

/// A part of a plan that has names of what varies.
pub(crate) trait Renamed<V> {
    /// The same with other names.
    type With<W>;

    /// The same with the names that `name` gives instead of its own.
    fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<Self::With<W>, E>;
}

impl<V, T: Renamed<V>> Renamed<V> for Vec<T> {
    type With<W> = Vec<T::With<W>>;

    fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<Self::With<W>, E> {
        self.iter().map(|part| part.named(name)).collect()
    }
}

impl<V, T: Renamed<V>> Renamed<V> for Option<T> {
    type With<W> = Option<T::With<W>>;

    fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<Self::With<W>, E> {
        self.as_ref().map(|part| part.named(name)).transpose()
    }
}

/// Says which fields of a part of a plan are names of what varies, which fields are parts with such names, and which have none.
macro_rules! renamed {
    ($part:ident: names $($name:ident)*, parts $($within:ident)*, others $($other:ident)*) => {
        impl<V> $crate::name::Renamed<V> for $part<V> {
            type With<W> = $part<W>;

            #[allow(clippy::clone_on_copy, reason = "some fields are texts or lists")]
            fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<$part<W>, E> {
                Ok($part {
                    $($name: name(&self.$name)?,)*
                    $($within: self.$within.named(name)?,)*
                    $($other: self.$other.clone(),)*
                })
            }
        }
    };
}
pub(crate) use renamed;

impl Name for Parameter {
    fn text(&self) -> &str {
        self.name()
    }

    fn of(name: &str) -> Result<Self, PlanError> {
        Self::from_name(name).ok_or_else(|| {
            PlanError::Name(format!("`{}` is no parameter; there are {}", short(name), parameter_names().join(", ")))
        })
    }
}

impl Name for Coordinate {
    fn text(&self) -> &str {
        self.name()
    }

    fn of(name: &str) -> Result<Self, PlanError> {
        Self::named(name).ok_or_else(|| {
            let known = parameter_names().join(", ");
            PlanError::Name(format!("`{}` cannot vary; what can is {known}, x, v and phase", short(name)))
        })
    }

    fn same_as(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Parameter(a), Self::Parameter(b)) => a.same_number(*b),
            (a, b) => a == b,
        }
    }
}

impl Name for Quantity {
    fn text(&self) -> &str {
        self.name()
    }

    fn of(name: &str) -> Result<Self, PlanError> {
        Self::from_name(name).ok_or_else(|| PlanError::Name(crate::quantity::unknown(name)))
    }
}

impl Name for String {
    fn text(&self) -> &str {
        self
    }

    fn of(name: &str) -> Result<Self, PlanError> {
        Ok(name.to_owned())
    }

    fn key(&self) -> &'static str {
        "path"
    }
}

/// It is read as a parameter or a coordinate where there is one with this name.
impl Name for Variable {
    fn text(&self) -> &str {
        match self {
            Self::Coordinate(coordinate) => coordinate.name(),
            Self::Path(path) => path,
        }
    }

    fn of(name: &str) -> Result<Self, PlanError> {
        Ok(Coordinate::named(name).map_or_else(|| Self::Path(name.to_owned()), Self::Coordinate))
    }

    fn key(&self) -> &'static str {
        if let Self::Path(_) = self { "path" } else { "parameter" }
    }
}

impl From<Parameter> for Variable {
    fn from(parameter: Parameter) -> Self {
        Self::Coordinate(Coordinate::Parameter(parameter))
    }
}

impl From<Coordinate> for Variable {
    fn from(coordinate: Coordinate) -> Self {
        Self::Coordinate(coordinate)
    }
}

impl From<String> for Variable {
    fn from(path: String) -> Self {
        Self::Path(path)
    }
}

impl From<Variable> for Cow<'static, str> {
    fn from(variable: Variable) -> Self {
        match variable {
            Variable::Coordinate(coordinate) => coordinate.name().into(),
            Variable::Path(path) => path.into(),
        }
    }
}

impl Serialize for Variable {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        serialize(self, to)
    }
}

impl<'de> Deserialize<'de> for Variable {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        deserialize(from)
    }
}

impl JsonSchema for Variable {
    fn schema_name() -> Cow<'static, str> {
        "Variable".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let known: Vec<&str> = parameter_names().into_iter().chain(["x", "v", "phase"]).collect();
        json_schema!({
            "description": "A parameter of an oscillator or a coordinate of its start, or the path of a number of a machine or of its start.",
            "anyOf": [{ "type": "string", "enum": known }, { "type": "string" }],
        })
    }
}

fn short(name: &str) -> String {
    name.chars().take(60).collect()
}

/// A name is written as text.
pub(crate) fn serialize<N: Name, S: Serializer>(name: &N, to: S) -> Result<S::Ok, S::Error> {
    name.text().serialize(to)
}

pub(crate) fn deserialize<'de, N: Name, D: Deserializer<'de>>(from: D) -> Result<N, D::Error> {
    N::of(&String::deserialize(from)?).map_err(D::Error::custom)
}

/// A name for the schema of plans, where it is written out at each place.
pub(crate) struct Written;

impl JsonSchema for Written {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Name".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Variable::json_schema(generator)
    }
}
