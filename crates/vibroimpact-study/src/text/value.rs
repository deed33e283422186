//! A value of TOML or JSON, with names in the order in which they are written and numbers with all their bits.

use super::reader::Step;
use core::fmt;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};

/// A value.
#[derive(Debug)]
pub(crate) enum Value {
    /// The null of JSON.
    Null,
    /// True or false.
    Bool(bool),
    /// A whole number.
    Signed(i64),
    /// A whole number that may be larger.
    Unsigned(u64),
    /// A number with a fraction or an exponent, or one that is not finite.
    Float(f64),
    /// A string.
    Text(String),
    /// A list.
    List(Vec<Value>),
    /// A table.
    Table(Table),
}

/// Names with values. JSON may have a name twice.
pub(crate) type Table = Vec<(String, Value)>;

impl Value {
    /// The value of a plan, by its JSON. Its numbers are finite.
    pub(crate) fn of(plan: &impl Serialize) -> Self {
        // finite numbers and texts can always be written as JSON and read again
        let json = serde_json::to_string(plan).unwrap_or_default();
        serde_json::from_str(&json).unwrap_or(Self::Null)
    }

    /// The value of a name in a table.
    pub(crate) fn get(&self, name: &str) -> Option<&Self> {
        let Self::Table(table) = self else { return None };
        table.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }
}

impl Value {
    /// The value of a name in a table, to be changed.
    pub(super) fn get_mut(&mut self, name: &str) -> Option<&mut Self> {
        let Self::Table(table) = self else { return None };
        table.iter_mut().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    /// The steps to the first value that is this text.
    pub(super) fn way_to(&self, text: &str) -> Option<Vec<Step>> {
        let within = |step: Step, value: &Self| {
            let rest = value.way_to(text)?;
            Some([step].into_iter().chain(rest).collect())
        };
        match self {
            Self::Text(own) => (own == text).then(Vec::new),
            Self::List(list) => list.iter().enumerate().find_map(|(k, value)| within(Step::Item(k), value)),
            Self::Table(table) => table.iter().find_map(|(name, value)| within(Step::Name(name.clone()), value)),
            _ => None,
        }
    }
}

/// For TOML, which has no null: a name without a value is left out.
impl Serialize for Value {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Null => to.serialize_none(),
            Self::Bool(value) => to.serialize_bool(*value),
            Self::Signed(value) => to.serialize_i64(*value),
            Self::Unsigned(value) => to.serialize_u64(*value),
            Self::Float(value) => to.serialize_f64(*value),
            Self::Text(text) => to.serialize_str(text),
            Self::List(list) => to.collect_seq(list),
            Self::Table(table) => {
                let entries = table.iter().filter(|(_, value)| !matches!(value, Self::Null));
                to.collect_map(entries.map(|(name, value)| (name, value)))
            }
        }
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(Any)
    }
}

struct Any;

impl<'de> Visitor<'de> for Any {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a whole number of 64 bits")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(Value::Signed(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(Value::Unsigned(value))
    }

    fn visit_i128<E: Error>(self, value: i128) -> Result<Value, E> {
        Err(E::custom(format_args!("the whole number {value} does not fit in 64 bits")))
    }

    fn visit_u128<E: Error>(self, value: u128) -> Result<Value, E> {
        Err(E::custom(format_args!("the whole number {value} does not fit in 64 bits")))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Value::Float(value))
    }

    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::Text(text.to_owned()))
    }

    fn visit_string<E>(self, text: String) -> Result<Value, E> {
        Ok(Value::Text(text))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = items.next_element()? {
            list.push(value);
        }
        Ok(Value::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut table = Vec::new();
        while let Some(entry) = entries.next_entry()? {
            table.push(entry);
        }
        Ok(Value::Table(table))
    }
}
