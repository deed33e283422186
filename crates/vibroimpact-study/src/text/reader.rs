//! From a value to a plan. An error has the path to the part of the value that is wrong.

use super::value::Value;
use core::{fmt, slice};
use serde::de::value::{BorrowedStrDeserializer, MapAccessDeserializer};
use serde::de::{DeserializeSeed, Deserializer, Error, Expected, MapAccess, SeqAccess, Unexpected, Visitor};
use serde::forward_to_deserialize_any;

/// A step from a value into it.
#[derive(Debug)]
pub(crate) enum Step {
    /// To the value of a name.
    Name(String),
    /// To an item of a list, from 0.
    Item(usize),
}

/// What is wrong in a value.
#[derive(Debug)]
pub(crate) struct Wrong {
    /// What is wrong.
    pub(crate) message: String,
    /// The way to it, last step first.
    pub(crate) steps: Vec<Step>,
    /// Whether the last name is wrong, and not its value.
    pub(crate) of_name: bool,
}

impl Wrong {
    /// The same, seen from the table or list that it is in.
    fn within(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }

    fn name(self, name: &str) -> Self {
        Self { of_name: true, ..self }.within(Step::Name(name.to_owned()))
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl core::error::Error for Wrong {}

impl Error for Wrong {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self { message: message.to_string(), steps: Vec::new(), of_name: false }
    }

    fn invalid_type(unexpected: Unexpected<'_>, expected: &dyn Expected) -> Self {
        match unexpected {
            Unexpected::Str(text) if text.chars().count() > 60 => {
                let part: String = text.chars().take(60).collect();
                Self::custom(format_args!("invalid type: string that begins \"{part}\", expected {expected}"))
            }
            Unexpected::Unit => Self::custom(format_args!("invalid type: null, expected {expected}")),
            other => Self::custom(format_args!("invalid type: {other}, expected {expected}")),
        }
    }

    fn duplicate_field(field: &'static str) -> Self {
        Self::custom(format_args!("`{field}` is written twice")).name(field)
    }
}

impl Value {
    fn is_not(&self, expected: &dyn Expected) -> Wrong {
        let unexpected = match self {
            Self::Null => Unexpected::Unit,
            Self::Bool(value) => Unexpected::Bool(*value),
            Self::Signed(value) => Unexpected::Signed(*value),
            Self::Unsigned(value) => Unexpected::Unsigned(*value),
            Self::Float(value) => Unexpected::Float(*value),
            Self::Text(text) => Unexpected::Str(text),
            Self::List(_) => Unexpected::Seq,
            Self::Table(_) => Unexpected::Map,
        };
        Wrong::invalid_type(unexpected, expected)
    }
}

/// The methods know what is wanted, so that a table is not compiled as a list, nor a list as a table.
impl<'de> Deserializer<'de> for &'de Value {
    type Error = Wrong;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Signed(value) => visitor.visit_i64(*value),
            Value::Unsigned(value) => visitor.visit_u64(*value),
            Value::Float(value) => visitor.visit_f64(*value),
            Value::Text(text) => visitor.visit_borrowed_str(text),
            Value::List(_) => self.deserialize_seq(visitor),
            Value::Table(_) => self.deserialize_map(visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        if matches!(self, Value::Null) { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let Value::Text(text) = self else { return Err(self.is_not(&visitor)) };
        visitor.visit_borrowed_str(text)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        self.deserialize_str(visitor)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let Value::List(list) = self else { return Err(self.is_not(&visitor)) };
        let mut items = Items { list, next: 0 };
        let value = visitor.visit_seq(&mut items)?;
        if items.next < list.len() {
            return Err(Wrong::invalid_length(list.len(), &format!("{} items", items.next).as_str()));
        }
        Ok(value)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Wrong> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let Value::Table(table) = self else { return Err(self.is_not(&visitor)) };
        visitor.visit_map(Entries::of(table))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        self.deserialize_map(visitor)
    }

    /// A word alone, or a table with one word and what belongs to it.
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        words: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        match self {
            Value::Text(word) => visitor.visit_enum(BorrowedStrDeserializer::new(word)),
            Value::Table(table) if table.len() == 1 => {
                visitor.visit_enum(MapAccessDeserializer::new(Entries::of(table)))
            }
            Value::Table(table) => Err(Wrong::custom(format_args!(
                "{} names are in this table, and one is needed: {}",
                table.len(),
                words.join(", ")
            ))),
            _ => Err(self.is_not(&visitor)),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char bytes byte_buf unit unit_struct tuple_struct identifier
        ignored_any
    }
}

/// The items of a list.
struct Items<'de> {
    list: &'de [Value],
    next: usize,
}

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Wrong;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Wrong> {
        let Some(value) = self.list.get(self.next) else { return Ok(None) };
        self.next += 1;
        seed.deserialize(value).map(Some).map_err(|wrong| wrong.within(Step::Item(self.next - 1)))
    }
}

/// The names and values of a table.
struct Entries<'de> {
    rest: slice::Iter<'de, (String, Value)>,
    entry: Option<&'de (String, Value)>,
}

impl<'de> Entries<'de> {
    fn of(table: &'de [(String, Value)]) -> Self {
        Self { rest: table.iter(), entry: None }
    }
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = Wrong;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Wrong> {
        self.entry = self.rest.next();
        let Some((name, _)) = self.entry else { return Ok(None) };
        seed.deserialize(BorrowedStrDeserializer::new(name)).map(Some).map_err(|wrong: Wrong| wrong.name(name))
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Wrong> {
        let Some((name, value)) = self.entry else { return Err(Wrong::custom("a value without a name")) };
        seed.deserialize(value).map_err(|wrong| wrong.within(Step::Name(name.clone())))
    }
}
