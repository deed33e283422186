//! A machine file as TOML, with one line for each number, vector, matrix and small table.

use super::source::MachineSource;
use crate::text::{Table, Value};
use serde::Serialize;

impl MachineSource {
    /// The file as TOML. Numbers have all their digits.
    #[must_use]
    pub fn to_toml(&self) -> String {
        headed_toml(self)
    }
}

/// The same for all that has a machine in it.
pub(crate) fn headed_toml(of: &impl Serialize) -> String {
    let mut text = String::new();
    if let Value::Table(table) = Value::of(of) {
        write(&mut text, "", &table);
    }
    text
}

/// Writes a table: first what fits on a line, then tables and lists of tables with headings of their own.
fn write(text: &mut String, path: &str, table: &Table) {
    let headed = |(key, value): &&(String, Value)| match value {
        Value::Table(_) => path.is_empty() || path == "task",
        Value::List(list) => {
            path == "machine"
                && key != "motion"
                && !list.is_empty()
                && list.iter().all(|item| matches!(item, Value::Table(_)))
        }
        _ => false,
    };
    let (below, here): (Vec<_>, Vec<_>) = table.iter().partition(headed);
    for (key, value) in here {
        text.push_str(&format!("{} = {}\n", spelt(key), on_one_line(value)));
    }
    for (key, value) in below {
        let key = if path.is_empty() { spelt(key) } else { format!("{path}.{}", spelt(key)) };
        let mut part = |heading: String, table: &Table| {
            let gap = if text.is_empty() { "" } else { "\n" };
            // a task has one table, which is named in its heading
            if key != "task" {
                text.push_str(&format!("{gap}{heading}\n"));
            }
            write(text, &key, table);
        };
        match value {
            Value::Table(table) => part(format!("[{key}]"), table),
            Value::List(list) => {
                for item in list {
                    if let Value::Table(table) = item {
                        part(format!("[[{key}]]"), table);
                    }
                }
            }
            _ => {}
        }
    }
}

/// A value on one line.
fn on_one_line(value: &Value) -> String {
    let mut text = String::new();
    // numbers, texts, and lists and tables of them can always be written as TOML
    let _ = value.serialize(toml::ser::ValueSerializer::new(&mut text));
    text
}

/// A key, in quotes where it needs them.
fn spelt(key: &str) -> String {
    let bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { key.to_owned() } else { toml::Value::from(key).to_string() }
}
