//! Lists of quantities, as they are written in plans.

use crate::field::{Extra, Field, NumberType};
use crate::unit::Unit;
use serde::{Deserialize, Deserializer, Serializer};
pub use vibroimpact::quantities::{Quantities, Quantity};

/// In a plan a list of quantities is a list of their names.
pub(crate) fn serialize<S: Serializer>(list: &[Quantity], to: S) -> Result<S::Ok, S::Error> {
    to.collect_seq(list.iter().map(|quantity| quantity.name()))
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Quantity>, D::Error> {
    let names = Vec::<String>::deserialize(from)?;
    let quantity = |name: &String| Quantity::from_name(name).ok_or_else(|| serde::de::Error::custom(unknown(name)));
    names.iter().map(quantity).collect()
}

/// The message about a name that is no quantity.
#[must_use]
pub fn unknown(name: &str) -> String {
    let name: String = name.chars().take(60).collect();
    format!("`{name}` is no quantity; there are {}", Quantity::ALL.map(Quantity::name).join(", "))
}

/// One quantity in a plan.
pub(crate) mod one {
    use super::{Quantity, unknown};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// It is written as its name.
    pub(crate) fn serialize<S: Serializer>(quantity: &Quantity, to: S) -> Result<S::Ok, S::Error> {
        quantity.name().serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Quantity, D::Error> {
        let name = String::deserialize(from)?;
        Quantity::from_name(&name).ok_or_else(|| serde::de::Error::custom(unknown(&name)))
    }
}

/// One name, for the schema of plans.
pub(crate) struct Name;

impl schemars::JsonSchema for Name {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "string", "enum": Quantity::ALL.map(Quantity::name) })
    }
}

/// A list of names, for the schema of plans.
pub(crate) struct Names;

impl schemars::JsonSchema for Names {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Quantities".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let names = Quantity::ALL.map(Quantity::name);
        schemars::json_schema!({ "type": "array", "items": { "type": "string", "enum": names } })
    }
}

/// The field of a quantity, with these dimensions in addition to those of the grid.
pub(crate) fn field(quantity: Quantity, extra: Vec<Extra>) -> Field {
    Field {
        name: quantity.name().into(),
        long_name: quantity.description().into(),
        unit: Unit::nondimensional(quantity.kind()),
        kind: NumberType::F64,
        fill: 0,
        extra,
        flags: Vec::new(),
        comment: "",
    }
}

/// The values of a list of quantities; not-a-number where they are not defined.
pub(crate) fn values(list: &[Quantity], of: Option<Quantities>) -> impl Iterator<Item = f64> {
    list.iter().map(move |quantity| of.map_or(f64::NAN, |of| of.get(*quantity)))
}
