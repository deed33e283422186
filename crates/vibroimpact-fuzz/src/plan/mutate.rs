//! Mutated plans: values replaced, fields removed, renamed or added, and texts truncated or changed.

use proptest::prelude::*;
use proptest::sample::Index;
use serde_json::{Map, Value};

/// One change of a tree of values. The index selects the place.
#[derive(Clone, Debug)]
pub(super) enum Change {
    /// Replaces a value.
    Replace(Index, Value),
    /// Removes a field.
    Remove(Index),
    /// Renames a field.
    Rename(Index, String),
    /// Adds a field.
    Add(Index, String, Value),
    /// Nests the value in this number of lists.
    Nest(Index, u16),
    /// Repeats an element of a list.
    Twice(Index),
}

/// One change of a text.
#[derive(Clone, Debug)]
pub(super) enum Edit {
    /// Truncates the text at the place.
    Cut(Index),
    /// Inserts text at the place.
    Insert(Index, String),
    /// Removes this number of characters.
    Remove(Index, u8),
}

/// Values that hardly any field expects.
const GARBAGE: &str = r#"[null, true, 0, -1, -0.0, 1.5, 1e300, -1e300, 1e-300, 5e-324, 18446744073709551615, -9223372036854775808,
    4294967296, 1000000, "", "x", "NaN", "inf", "∞", "1/1", "0:1:3", [], [0.5], [0.5, 0.5], {}, {"scatter": {}}, "\u0000", "gap"]"#;

fn garbage() -> BoxedStrategy<Value> {
    let values: Vec<Value> = serde_json::from_str(GARBAGE).unwrap_or_default();
    prop::sample::select(values).boxed()
}

fn name() -> BoxedStrategy<String> {
    let names = vec![
        "gap",
        "beta",
        "inverse_beta",
        "restituton",
        "",
        "task",
        "version",
        "map",
        "x",
        "é",
        "second_stop",
        "over",
        "impacts",
        "tile",
    ];
    prop::sample::select(names).prop_map(str::to_owned).boxed()
}

/// Changes of a tree; none in more than half of the cases.
pub(super) fn changes() -> BoxedStrategy<Vec<Change>> {
    let place = any::<Index>;
    let change = prop_oneof![
        4 => (place(), garbage()).prop_map(|(at, value)| Change::Replace(at, value)),
        2 => place().prop_map(Change::Remove),
        1 => (place(), name()).prop_map(|(at, name)| Change::Rename(at, name)),
        2 => (place(), name(), garbage()).prop_map(|(at, name, value)| Change::Add(at, name, value)),
        1 => (place(), prop::sample::select(vec![1_u16, 3, 100, 200, 5000])).prop_map(|(at, depth)| Change::Nest(at, depth)),
        1 => place().prop_map(Change::Twice),
    ];
    prop_oneof![3 => Just(Vec::new()), 2 => prop::collection::vec(change, 1..4)].boxed()
}

/// Edits of a text; none in most cases.
pub(super) fn edits() -> BoxedStrategy<Vec<Edit>> {
    let inserted = vec![
        "{", "}", "[", "]", "\"", "'", ":", ",", "=", "\n", "\0", "NaN", "inf", "-", "1e999", "\u{feff}", "\u{202e}",
        "#", "\\", "\\u", "[[", "null", "٣",
    ];
    let inserted = prop::sample::select(inserted).prop_map(str::to_owned);
    let edit = prop_oneof![
        1 => any::<Index>().prop_map(Edit::Cut),
        3 => (any::<Index>(), inserted).prop_map(|(at, text)| Edit::Insert(at, text)),
        2 => (any::<Index>(), 1..20_u8).prop_map(|(at, n)| Edit::Remove(at, n)),
    ];
    prop_oneof![6 => Just(Vec::new()), 1 => prop::collection::vec(edit, 1..4)].boxed()
}

/// The number of nodes of a tree.
fn count(value: &Value) -> usize {
    1 + match value {
        Value::Object(fields) => fields.values().map(count).sum::<usize>(),
        Value::Array(values) => values.iter().map(count).sum(),
        _ => 0,
    }
}

fn at(value: &mut Value, mut k: usize) -> Option<&mut Value> {
    if k == 0 {
        return Some(value);
    }
    k -= 1;
    let children: Vec<&mut Value> = match value {
        Value::Object(fields) => fields.values_mut().collect(),
        Value::Array(values) => values.iter_mut().collect(),
        _ => return None,
    };
    for child in children {
        let size = count(child);
        if k < size {
            return at(child, k);
        }
        k -= size;
    }
    None
}

/// The tree after its changes.
pub(super) fn changed(mut tree: Value, changes: &[Change]) -> Value {
    for change in changes {
        apply(&mut tree, change);
    }
    tree
}

fn apply(tree: &mut Value, change: &Change) {
    let (Change::Replace(place, _)
    | Change::Remove(place)
    | Change::Rename(place, _)
    | Change::Add(place, ..)
    | Change::Nest(place, _)
    | Change::Twice(place)) = change;
    let k = place.index(count(tree));
    let Some(node) = at(tree, k) else { return };
    let field = |fields: &Map<String, Value>| fields.keys().nth(place.index(fields.len().max(1))).cloned();
    match (change, node) {
        (Change::Replace(_, value), node) => *node = value.clone(),
        (Change::Nest(_, depth), node) => {
            let mut value = core::mem::take(node);
            for _ in 0..*depth {
                value = Value::Array(vec![value]);
            }
            *node = value;
        }
        (Change::Remove(_), Value::Object(fields)) => {
            field(fields).into_iter().for_each(|name| drop(fields.remove(&name)));
        }
        (Change::Rename(_, name), Value::Object(fields)) => {
            if let Some(value) = field(fields).and_then(|old| fields.remove(&old)) {
                fields.insert(name.clone(), value);
            }
        }
        (Change::Add(_, name, value), Value::Object(fields)) => drop(fields.insert(name.clone(), value.clone())),
        (Change::Twice(_), Value::Array(values)) => {
            let first = values.first().cloned();
            values.extend(first);
        }
        (Change::Remove(_), Value::Array(values)) => drop(values.pop()),
        _ => {}
    }
}

/// The text after its edits.
pub(super) fn edited(text: &str, edits: &[Edit]) -> String {
    let mut text: Vec<char> = text.chars().collect();
    for edit in edits {
        let place = |at: &Index| at.index(text.len() + 1);
        match edit {
            Edit::Cut(at) => text.truncate(place(at)),
            Edit::Insert(at, more) => {
                let k = place(at);
                text.splice(k..k, more.chars());
            }
            Edit::Remove(at, n) => {
                let k = place(at);
                text.drain(k..(k + usize::from(*n)).min(text.len()));
            }
        }
    }
    text.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn every_node_is_reached() {
        let mut tree = json!({ "a": [1, 2], "b": { "c": 3 } });
        assert_eq!(count(&tree), 6);
        let values: Vec<Value> = (0..6).map(|k| at(&mut tree, k).unwrap().clone()).collect();
        assert_eq!(values[2..4], [json!(1), json!(2)]);
        assert_eq!(values[5], json!(3));
        assert!(at(&mut tree, 6).is_none());
    }
}
