//! A machine file as TOML, with one line for each number, vector, matrix and small table.

use super::source::MachineSource;
use serde::Serialize;
use toml::{Table, Value};

impl MachineSource {
    /// The file as TOML. Numbers have all their digits.
    #[must_use]
    pub fn to_toml(&self) -> String {
        headed_toml(self)
    }
}

/// The same for all that has a machine in it.
pub(crate) fn headed_toml(of: &impl Serialize) -> String {
    // numbers, texts, and lists and tables of them can always be written as TOML
    let table = Table::try_from(of).unwrap_or_default();
    let mut text = String::new();
    write(&mut text, "", &table);
    text
}

/// Writes a table: first what fits on a line, then tables and lists of tables with headings of their own.
fn write(text: &mut String, path: &str, table: &Table) {
    let headed = |key: &str, value: &Value| match value {
        Value::Table(_) => path.is_empty() || path == "task",
        Value::Array(list) => {
            path == "machine" && key != "motion" && !list.is_empty() && list.iter().all(Value::is_table)
        }
        _ => false,
    };
    let (below, here): (Vec<_>, Vec<_>) = table.iter().partition(|(key, value)| headed(key, value));
    for (key, value) in here {
        text.push_str(&format!("{} = {value}\n", spelt(key)));
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
            Value::Array(list) => {
                list.iter().filter_map(Value::as_table).for_each(|table| part(format!("[[{key}]]"), table));
            }
            _ => {}
        }
    }
}

/// A key, in quotes where it needs them.
fn spelt(key: &str) -> String {
    let bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { key.to_owned() } else { Value::from(key).to_string() }
}
