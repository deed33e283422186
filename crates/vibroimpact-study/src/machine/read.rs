//! From the text of a machine file to a source. Each error names the path of the part, or the place in the text.

use super::error::{MachineProblem, MachineTextError};
use super::modes;
use super::source::MachineSource;
use crate::plan_text::plain;
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_path_to_error::{Path, Segment};

/// Reads no files: for machine files that name none.
///
/// # Errors
/// Always.
pub fn no_files(_: &str) -> Result<String, String> {
    Err("cannot be read here".to_owned())
}

impl MachineSource {
    /// Reads a machine file, written as TOML or, where it begins with a brace, as JSON. `files` returns the text of a
    /// file that it names, or says why not.
    ///
    /// # Errors
    /// [`MachineTextError`] with the path of the part, or the line and the column, and what is expected there. What the
    /// numbers mean is checked by [`MachineSource::machine`].
    pub fn from_text(text: &str, files: impl FnOnce(&str) -> Result<String, String>) -> Result<Self, MachineTextError> {
        let mut source: Self = from_either(text)?;
        source.read_modes(files)?;
        Ok(source)
    }

    /// Replaces the name of a table of modes by the modes in it.
    pub(crate) fn read_modes(
        &mut self,
        files: impl FnOnce(&str) -> Result<String, String>,
    ) -> Result<(), MachineTextError> {
        let Some(name) = self.machine.modes.take() else { return Ok(()) };
        if !self.machine.mode.is_empty() {
            return Err(MachineTextError::new("modes", MachineProblem::Several("modes and tables mode")));
        }
        let read = files(&name).and_then(|table| modes::from_csv(&table));
        let wrong = |why| MachineTextError::new("modes", MachineProblem::File { name: name.clone(), why });
        self.machine.mode = read.map_err(wrong)?;
        Ok(())
    }
}

/// Reads TOML or, where the text begins with a brace, JSON.
pub(crate) fn from_either<T: DeserializeOwned>(text: &str) -> Result<T, MachineTextError> {
    if text.trim_start().starts_with('{') { from_json(text) } else { from_toml(text) }
}

fn from_toml<T: DeserializeOwned>(text: &str) -> Result<T, MachineTextError> {
    let place = |error: &toml::de::Error| error.span().map(|span| position(text, span.start));
    let syntax = |error: &toml::de::Error| wrong(String::new(), place(error), error.message());
    let parsed = toml::Deserializer::parse(text).map_err(|error| syntax(&error))?;
    serde_path_to_error::deserialize(parsed).map_err(|error| {
        let whole = toml::from_str::<Value>(text).unwrap_or_default();
        wrong(named(error.path(), &whole), place(error.inner()), error.inner().message())
    })
}

fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, MachineTextError> {
    let mut parsed = serde_json::Deserializer::from_str(text);
    let read = serde_path_to_error::deserialize(&mut parsed).map_err(|error| {
        let whole = serde_json::from_str::<Value>(text).unwrap_or_default();
        let inner = error.inner();
        // what cannot be parsed has a place and no path
        let path = if inner.is_data() { named(error.path(), &whole) } else { String::new() };
        let said = inner.to_string();
        let said = said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said);
        wrong(path, Some((inner.line(), inner.column())), said)
    })?;
    parsed
        .end()
        .map_err(|error| wrong(String::new(), Some((error.line(), error.column())), "the text does not end here"))?;
    Ok(read)
}

/// The error, in one line.
fn wrong(path: String, place: Option<(usize, usize)>, said: &str) -> MachineTextError {
    let said = plain(said).split_whitespace().collect::<Vec<_>>().join(" ");
    let place = place.map(|(line, column)| format!("line {line}, column {column}"));
    let (path, said) = match (path.is_empty(), place) {
        (false, Some(place)) => (path, format!("{said} ({place})")),
        (false, None) => (path, said),
        (true, Some(place)) => (place, said),
        (true, None) => ("machine".to_owned(), said),
    };
    MachineTextError::new(path, MachineProblem::Text(said))
}

/// Line and column of a byte, both from 1.
fn position(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    (line, before.rsplit('\n').next().unwrap_or_default().chars().count() + 1)
}

/// The path with names of stops, joints and links, and orders of forces, instead of their places in lists.
fn named(path: &Path, whole: &Value) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut here = Some(whole);
    for segment in path {
        match segment {
            Segment::Seq { index } => {
                here = here.and_then(|value| value.get(index));
                let name = here.and_then(|value| value.get("name")).and_then(Value::as_str).map(str::to_owned);
                let ordered = matches!(words.last().map(String::as_str), Some("force" | "motion"));
                let order = || {
                    let order = here.and_then(|value| value.get("order")).and_then(Value::as_u64).unwrap_or(1);
                    ordered.then(|| order.to_string())
                };
                words.push(name.or_else(order).unwrap_or_else(|| (index + 1).to_string()));
            }
            Segment::Map { key } => {
                here = here.and_then(|value| value.get(key));
                words.push(key.clone());
            }
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    if words.len() > 1 && words[0] == "machine" {
        words.remove(0);
    }
    // names of the file may have any characters
    words.join(".").chars().map(|c| if c.is_control() || c.is_whitespace() { '_' } else { c }).take(120).collect()
}
