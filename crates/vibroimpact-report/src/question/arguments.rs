//! The arguments of a question: the fields of its task as they stand in the plan. The command line and the call in Python are written
//! from these, so a new field of a plan is in both.

use crate::Units;
use crate::question::number;
use crate::units::given;
use serde_json::{Map, Value, json};
use vibroimpact_study::{Body, Plan};

/// An argument of a question.
pub(super) struct Argument {
    pub(super) name: String,
    pub(super) value: Value,
    /// Whether a plan cannot be without it.
    pub(super) required: bool,
}

impl Argument {
    /// The numbers with values or ranges, if it has some.
    pub(super) fn pairs(&self) -> Option<&Map<String, Value>> {
        self.value.as_object().filter(|_| ends(&self.value).is_none())
    }
}

/// The name of the task of a plan and the arguments that are not the usual ones. Positions, velocities and times are in these units.
pub(super) fn arguments(plan: &Plan, units: &Units) -> Option<(String, Vec<Argument>)> {
    let text = serde_json::to_value(plan).ok()?;
    let (verb, fields) = text["task"].as_object()?.iter().next()?;
    let hash = plan.canonical().ok()?.hash();
    let without = |name: &str| {
        let mut less = text.clone();
        less["task"][verb].as_object_mut()?.shift_remove(name);
        serde_json::from_value::<Plan>(less).ok()
    };
    let mut all = Vec::new();
    for (name, value) in fields.as_object()?.iter().filter(|(name, _)| *name != "back") {
        let less = without(name);
        let same = |less: &Plan| less.canonical().is_ok_and(|less| less.hash() == hash);
        // without a seed, plans have other ones than the command and Python, which have 1
        let usual = if name == "seed" { *value == 1 } else { less.as_ref().is_some_and(same) };
        if usual {
            continue;
        }
        let value = match fields.get("back").filter(|_| name == "to") {
            Some(back) => json!([back, value]),
            None => value.clone(),
        };
        let spelled = spelled(name, &value, units).into_iter();
        all.extend(spelled.map(|(name, value)| Argument { name, value, required: less.is_none() }));
    }
    Some((verb.clone(), all))
}

/// A field of a task as one or more arguments: numbers, texts, lists of these, or values by name.
fn spelled(name: &str, value: &Value, units: &Units) -> Vec<(String, Value)> {
    let argument = |name: &str, value: Value| (name.to_owned(), value);
    let scaled = |name: &str, value: &Value| match (name, value.as_f64()) {
        ("x", Some(x)) => json!(given(x, units.length())),
        ("v", Some(v)) => json!(given(v, units.velocity())),
        ("time", Some(time)) => json!(given(time, units.time())),
        _ => value.clone(),
    };
    match (name, value) {
        ("start", Value::Object(start)) => {
            // minus zero is a different value and is written
            let zero = |value: &Value| value.as_f64().is_some_and(|value| value.to_bits() == 0);
            let written = start.iter().filter(|(name, value)| *name == "x" || !zero(value));
            written.map(|(name, value)| argument(name, scaled(name, value))).collect()
        }
        ("direction", Value::Object(scatter)) => {
            let (way, of) = scatter.iter().next().map_or(("", None), |(way, of)| (way.as_str(), of.as_object()));
            let of = of.into_iter().flatten().map(|(name, value)| argument(name, value.clone()));
            core::iter::once(argument(name, json!(way))).chain(of).collect()
        }
        ("show", Value::Object(shown)) => shown.values().map(|of| argument(name, of.clone())).collect(),
        ("other", Value::Array(places)) => vec![(
            name.to_owned(),
            by_name(places, "coordinate", |place, name| Some(scaled(name, place.get("value")?))),
        )],
        ("vary", Value::Array(all)) => {
            let scales = by_name(all, "parameter", |one, _| one.get("scale").filter(|scale| !scale.is_null()).cloned());
            let names = all.iter().map(|one| one["parameter"].clone()).collect();
            let scales = Some(scales).filter(|scales| scales.as_object().is_some_and(|scales| !scales.is_empty()));
            core::iter::once(argument(name, names)).chain(scales.map(|scales| argument("scale", scales))).collect()
        }
        ("axes", Value::Array(axes)) => {
            vec![argument(name, by_name(axes, "vary", |axis, _| axis.get("over").cloned()))]
        }
        (_, Value::Object(one)) if one.contains_key("parameter") => {
            let over = |one: &Map<String, Value>, _: &str| match (one.get("from"), one.get("to")) {
                (Some(from), Some(to)) => Some(json!({ "from": from, "to": to })),
                (_, to) => to.cloned(),
            };
            vec![argument(name, by_name(core::slice::from_ref(value), "parameter", over))]
        }
        _ => vec![argument(name, scaled(name, value))],
    }
}

/// What objects say of the numbers that they name under this key.
fn by_name(all: &[Value], key: &str, of: impl Fn(&Map<String, Value>, &str) -> Option<Value>) -> Value {
    let pair = |one: &Value| {
        let (one, name) = (one.as_object()?, one.get(key)?.as_str()?);
        Some((name.to_owned(), of(one, name)?))
    };
    Value::Object(all.iter().filter_map(pair).collect())
}

/// The ends of a range, if the value is one.
pub(super) fn ends(value: &Value) -> Option<[String; 2]> {
    Some([plain(value.get("from")?), plain(value.get("to")?)])
}

/// A number or a text.
pub(super) fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(x) if x.is_f64() => x.as_f64().map(number).unwrap_or_default(),
        other => other.to_string(),
    }
}

/// The numbers of a body with their names in plans, which are those of the flags too. A damper of 0 is none.
pub(super) fn numbers_of(body: &Body) -> Vec<(String, f64)> {
    let text = serde_json::to_value(body).unwrap_or_default();
    let numbers = text.as_object().into_iter().flatten();
    let numbers = numbers.filter_map(|(name, value)| Some((name.clone(), value.as_f64()?)));
    numbers.filter(|(name, value)| !name.starts_with("damping") || value.to_bits() != 0).collect()
}

/// The units at the ends of names, longer ones before those at their ends.
const UNITS: [&str; 10] =
    ["_kg_m", "_kg", "_ns_per_m", "_n_per_m", "_m_per_s2", "_m_per_s", "_rad_per_s", "_n", "_hz", "_m"];

/// A name without its unit, as Python has it; the angular frequency is `omega`.
pub(super) fn without_unit(name: &str) -> &str {
    UNITS.iter().find_map(|unit| name.strip_suffix(unit)).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_without_units() {
        for (name, short) in [
            ("mass_kg", "mass"),
            ("stiffness_n_per_m", "stiffness"),
            ("damping_ns_per_m", "damping"),
            ("damping_ratio", "damping_ratio"),
            ("force_n", "force"),
            ("frequency_hz", "frequency"),
            ("omega_rad_per_s", "omega"),
            ("base_velocity_m_per_s", "base_velocity"),
            ("base_acceleration_m_per_s2", "base_acceleration"),
            ("unbalance_kg_m", "unbalance"),
            ("restitution", "restitution"),
        ] {
            assert_eq!(without_unit(name), short);
        }
    }
}
