//! The position of a part of a text, which is looked up only when an error is shown.

use super::reader::Step;
use core::fmt;
use core::ops::Range;
use serde_json::value::RawValue;
use std::collections::BTreeMap;
use toml::de::{DeTable, DeValue};

/// A position in a text, with the line that is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextPlace {
    /// The line, from 1.
    pub line: usize,
    /// The column, in characters from 1.
    pub column: usize,
    /// The line of the text, and a mark below what is wrong.
    pub lines: String,
}

impl fmt::Display for TextPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// Characters of a line that are shown.
const WIDTH: usize = 100;
/// The largest number of them before the position.
const BEFORE: usize = 60;

impl TextPlace {
    /// The place of these bytes.
    pub(super) fn of(text: &str, bytes: &Range<usize>) -> Self {
        let before = text.get(..bytes.start).unwrap_or(text);
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let (line, column) = (before.matches('\n').count() + 1, before[start..].chars().count() + 1);
        let skipped = (column - 1).saturating_sub(BEFORE);
        let whole = text[start..].lines().next().unwrap_or_default();
        let part: String =
            whole.chars().skip(skipped).take(WIDTH).map(|c| if c.is_control() { ' ' } else { c }).collect();
        let wrong = text.get(bytes.clone()).and_then(|wrong| wrong.lines().next()).unwrap_or_default();
        let indent = column - 1 - skipped;
        let marks = "^".repeat(wrong.chars().count().clamp(1, WIDTH - indent));
        let margin = " ".repeat(line.to_string().len());
        let lines = format!("{margin} |\n{line} | {part}\n{margin} | {}{marks}", " ".repeat(indent));
        Self { line, column, lines }
    }

    /// The place of line and column, both from 1; parsers count bytes of the line.
    pub(super) fn at(text: &str, line: usize, column: usize) -> Self {
        let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
        let byte = start + column.saturating_sub(1);
        let byte = (0..=byte.min(text.len())).rev().find(|byte| text.is_char_boundary(*byte)).unwrap_or(0);
        Self::of(text, &(byte..byte))
    }
}

/// The bytes of the value to which the steps lead in a TOML text, or of its name.
pub(super) fn in_toml(text: &str, steps: &[Step], of_name: bool) -> Option<Range<usize>> {
    let whole = DeTable::parse(text).ok()?;
    let mut bytes = whole.span();
    let mut here = &DeValue::Table(whole.into_inner());
    for step in steps {
        let value = match (step, here) {
            (Step::Name(name), DeValue::Table(table)) => {
                let (key, value) = table.get_key_value(name.as_str())?;
                bytes = if of_name { key.span() } else { value.span() };
                value
            }
            (Step::Item(index), DeValue::Array(list)) => {
                let value = list.get(*index)?;
                bytes = value.span();
                value
            }
            _ => return None,
        };
        here = value.get_ref();
    }
    Some(bytes)
}

/// The same in a JSON text.
pub(super) fn in_json(text: &str, steps: &[Step], of_name: bool) -> Option<Range<usize>> {
    let mut here: &RawValue = serde_json::from_str(text).ok()?;
    for step in steps {
        here = match step {
            Step::Name(name) => serde_json::from_str::<BTreeMap<String, &RawValue>>(here.get()).ok()?.remove(name)?,
            Step::Item(index) => serde_json::from_str::<Vec<&RawValue>>(here.get()).ok()?.get(*index)?,
        };
    }
    // the value is a part of the text
    let start = here.get().as_ptr().addr() - text.as_ptr().addr();
    if let (true, Some(Step::Name(name))) = (of_name, steps.last()) {
        let end = text[..start].trim_end().strip_suffix(':')?.trim_end().len();
        let name = serde_json::to_string(name).ok()?;
        return Some(end.checked_sub(name.len()).filter(|start| text[..end].ends_with(&name) && *start < end)?..end);
    }
    Some(start..start + here.get().len())
}
