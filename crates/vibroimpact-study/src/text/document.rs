//! A text with its value. Each error has the path of the part or the position in the text.

use super::error::TextError;
use super::place::{TextPlace, in_json, in_toml};
use super::reader::{Step, Wrong};
use super::value::Value;
use serde::de::DeserializeOwned;

/// A text that is TOML or JSON, and its value.
pub(crate) struct Document<'t> {
    text: &'t str,
    is_json: bool,
    value: Value,
}

impl<'t> Document<'t> {
    /// Parses TOML or, where the text begins with a brace, JSON.
    pub(crate) fn parse(text: &'t str) -> Result<Self, TextError> {
        if text.trim_start().starts_with('{') { Self::json(text) } else { Self::toml(text) }
    }

    /// A value whose text is not known, so that errors have a path only.
    pub(crate) const fn of(value: Value) -> Self {
        Self { text: "", is_json: true, value }
    }

    /// Parses JSON.
    pub(crate) fn json(text: &'t str) -> Result<Self, TextError> {
        let value = serde_json::from_str(text).map_err(|error| {
            let message = error.to_string();
            let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(message, _)| message);
            let message = if message == "trailing characters" { "the text does not end here" } else { message };
            TextError::new(String::new(), message, Some(TextPlace::at(text, error.line(), error.column())))
        })?;
        Ok(Self { text, is_json: true, value })
    }

    fn toml(text: &'t str) -> Result<Self, TextError> {
        let value = toml::from_str(text).map_err(|error| {
            let place = error.span().map(|bytes| TextPlace::of(text, &bytes));
            TextError::new(String::new(), error.message(), place)
        })?;
        Ok(Self { text, is_json: false, value })
    }

    /// Whether it has a table `machine`, as the plan of a machine.
    pub(crate) fn has_machine(&self) -> bool {
        self.has("machine")
    }

    fn has(&self, name: &str) -> bool {
        self.value.get(name).is_some_and(|value| !matches!(value, Value::Null))
    }

    /// Refuses names in the outermost table, with the position of the first one that is there.
    pub(crate) fn refuse(&self, names: &[&str], why: &str) -> Result<(), TextError> {
        let Some(name) = names.iter().find(|name| self.has(name)) else { return Ok(()) };
        Err(self.error(Wrong { message: why.to_owned(), steps: vec![Step::Name((*name).to_owned())], of_name: true }))
    }

    /// What the text describes.
    pub(crate) fn read<T: DeserializeOwned>(&self) -> Result<T, TextError> {
        T::deserialize(&self.value).map_err(|wrong| self.error(wrong))
    }

    /// Gives a table a value if it has none of this name.
    pub(crate) fn fill(&mut self, table: &[&str], name: &str, value: Value) {
        let mut here = Some(&mut self.value);
        for step in table {
            here = here.and_then(|value| value.get_mut(step));
        }
        if let Some(Value::Table(entries)) = here
            && !entries.iter().any(|(known, _)| known == name)
        {
            entries.push((name.to_owned(), value));
        }
    }

    /// The error of a text of the task, with its position.
    pub(crate) fn wrong_text(&self, text: &str, why: &str) -> TextError {
        let mut steps = self.value.way_to(text).unwrap_or_default();
        steps.reverse();
        self.error(Wrong { message: why.to_owned(), steps, of_name: false })
    }

    fn error(&self, mut wrong: Wrong) -> TextError {
        wrong.steps.reverse();
        let bytes = if self.is_json { in_json } else { in_toml };
        let place = bytes(self.text, &wrong.steps, wrong.of_name).map(|bytes| TextPlace::of(self.text, &bytes));
        TextError::new(path(&wrong.steps, &self.value), &wrong.message, place)
    }
}

/// The path with names of stops, joints and links, and orders of forces, instead of their places in lists.
fn path(steps: &[Step], whole: &Value) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut here = Some(whole);
    for step in steps {
        match step {
            Step::Item(index) => {
                here = here.and_then(|value| if let Value::List(list) = value { list.get(*index) } else { None });
                let of = |name: &str| here.and_then(|value| value.get(name));
                let word = match (of("name"), words.last().map(String::as_str), of("order")) {
                    (Some(Value::Text(name)), _, _) => name.clone(),
                    (_, Some("force" | "motion"), Some(Value::Signed(order @ 0..))) => order.to_string(),
                    (_, Some("force" | "motion"), Some(Value::Unsigned(order))) => order.to_string(),
                    (_, Some("force" | "motion"), _) => "1".to_owned(),
                    _ => (index + 1).to_string(),
                };
                words.push(word);
            }
            Step::Name(name) => {
                here = here.and_then(|value| value.get(name));
                words.push(name.clone());
            }
        }
    }
    if words.len() > 1 && words[0] == "machine" {
        words.remove(0);
    }
    // names of the file may have any characters
    words.join(".").chars().map(|c| if c.is_control() || c.is_whitespace() { '_' } else { c }).take(120).collect()
}
