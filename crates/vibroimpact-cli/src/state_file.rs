//! States of machines that a command wrote as JSON.

use crate::failure::Failure;
use serde_json::{Map, Value};
use std::fs;
use vibroimpact_study::machine::StartText;

/// The fields of a state.
const FIELDS: [&str; 5] = ["q", "qdot", "phase", "contacts", "exact"];

/// Reads the state of a file: a state alone, that of the last event of a simulation, or that of a settled motion. After `#` follows
/// the JSON pointer of another part, such as `/events/2`.
pub(crate) fn read(name: &str) -> Result<StartText, Failure> {
    let (file, pointer) = name.split_once('#').map_or((name, None), |(file, pointer)| (file, Some(pointer)));
    let text = fs::read_to_string(file).map_err(|error| Failure::bad(format!("`{file}` cannot be read: {error}")))?;
    let object: Value =
        serde_json::from_str(&text).map_err(|error| Failure::bad(format!("`{file}` is no JSON: {error}")))?;
    let part = match pointer {
        Some(pointer) => object.pointer(pointer),
        None => state_of(&object),
    };
    let state = part.and_then(|part| if part.get("q").is_some() { Some(part) } else { part.get("state") });
    let state = state.and_then(Value::as_object).filter(|state| state.contains_key("q")).ok_or_else(|| {
        Failure::bad(format!(
            "`{name}` has no state of a machine\nhint: `vibro simulate --machine NAME --json` and `vibro settle --machine NAME --json` write states"
        ))
    })?;
    let state: Map<String, Value> =
        FIELDS.iter().filter_map(|field| Some(((*field).to_owned(), state.get(*field)?.clone()))).collect();
    serde_json::from_value(state.into()).map_err(|error| Failure::bad(format!("`{name}` has no state: {error}")))
}

/// Where a file has its state.
fn state_of(object: &Value) -> Option<&Value> {
    if object.get("q").is_some() {
        return Some(object);
    }
    let last = |name: &str| object.get(name)?.as_array()?.last();
    object.get("motion").or_else(|| last("events")).or_else(|| object.get("start"))
}
