//! Plans as JSON, small enough to be answered at once: every task, with values chosen to be difficult.

use crate::system::{SystemValues, parameter, start, system, without};
use crate::values::{ProptestText, interval, label, number, range};
use proptest::prelude::*;
use serde_json::{Map, Value, json};

/// A value in a plan: a number if the text is one.
fn value(text: &str) -> Value {
    let parsed = text.parse::<f64>().ok();
    parsed.and_then(serde_json::Number::from_f64).map_or_else(|| Value::String(text.to_owned()), Value::Number)
}

/// The system of a plan.
#[must_use]
pub fn of(values: &SystemValues) -> Value {
    let (mut system, mut second) = (Map::new(), Map::new());
    for (name, text) in values {
        match name.strip_prefix("second_") {
            Some(name) => second.insert(name.to_owned(), value(text)),
            None => system.insert((*name).to_owned(), value(text)),
        };
    }
    if second.contains_key("gap") && !second.contains_key("restitution") {
        second.extend(system.get("restitution").map(|eps| ("restitution".to_owned(), eps.clone())));
    }
    if !second.is_empty() {
        system.insert("second_stop".to_owned(), Value::Object(second));
    }
    Value::Object(system)
}

fn object(values: &SystemValues) -> Value {
    values.iter().map(|(name, text)| ((*name).to_owned(), value(text))).collect::<Map<_, _>>().into()
}

type Tasks = BoxedStrategy<(Value, SystemValues)>;

/// A task that uses the system unchanged.
fn alone(task: BoxedStrategy<Value>) -> Tasks {
    (task, system()).boxed()
}

fn one_start() -> Tasks {
    let few = prop::option::of(1..30_u64);
    let length = || {
        prop::option::of(
            prop_oneof![4 => (0.0..20.0_f64).prop_map(|n| json!(n)), 1 => number().prop_map(|text| value(&text))],
        )
    };
    let begin = || start().prop_map(|values| object(&values));
    let budget = || prop::option::weighted(0.2, 1..400_u32);
    alone(
        prop_oneof![
            3 => (begin(), budget()).prop_map(|(start, impacts)| json!({ "settle": { "start": start, "impacts": impacts } })),
            3 => (begin(), few, length(), length()).prop_map(|(start, impacts, periods, time)| {
                json!({ "simulate": { "start": start, "impacts": impacts, "periods": periods, "time": time } })
            }),
            2 => (1..20_u64, any::<u64>(), budget()).prop_map(
                |(starts, seed, impacts)| json!({ "attractors": { "starts": starts, "seed": seed, "impacts": impacts } }),
            ),
            2 => label().prop_map(|label| json!({ "orbit": { "label": label } })),
            1 => (begin(), prop::option::of(1..60_u64)).prop_map(|(start, points)| {
                let mut task = json!({ "start": start, "impacts": 1000, "transient": 100 });
                task.as_object_mut().into_iter().for_each(|task| task.extend(points.map(|n| ("points".to_owned(), json!(n)))));
                json!({ "lyapunov": task })
            }),
        ]
        .boxed(),
    )
}

fn axis(name: &str, over: &str, listed: bool) -> Value {
    let ends: Vec<Value> = over.split(':').take(2).map(value).collect();
    json!({ "vary": name, "over": if listed { Value::Array(ends) } else { json!(over) } })
}

fn basin() -> Tasks {
    let over: (ProptestText, ProptestText) = (range(-4.0, -0.5), range(-4.0, 4.0));
    (over, start(), prop::option::of(1..400_u32), any::<bool>(), system())
        .prop_map(|((x, v), start, impacts, listed, system)| {
            let axes = [axis("x", &x, false), axis("v", &v, listed)];
            let start = start.into_iter().filter(|(name, _)| *name == "phase").collect();
            (json!({ "basin": { "axes": axes, "start": object(&start), "impacts": impacts } }), system)
        })
        .boxed()
}

fn map() -> Tasks {
    let over = || parameter().prop_flat_map(|(name, low, high)| (Just(name), range(low, high), any::<bool>()));
    let refine = prop::option::weighted(0.2, 2..9_u32);
    (
        prop::collection::vec(over(), 1..3),
        1..4_u64,
        prop::option::weighted(0.7, 1..400_u32),
        (refine, fields()),
        system(),
    )
        .prop_map(|(over, starts, impacts, (refine, fields), system)| {
            let axes: Vec<Value> = over.iter().map(|(name, range, listed)| axis(name, range, *listed)).collect();
            let names: Vec<&str> = over.iter().map(|(name, ..)| *name).collect();
            let task =
                json!({ "axes": axes, "starts": starts, "impacts": impacts, "refine": refine, "fields": fields });
            (json!({ "map": task }), without(system, &names))
        })
        .boxed()
}

/// Quantities to report.
fn fields() -> BoxedStrategy<Option<Vec<&'static str>>> {
    let names = prop::sample::select(vec!["power", "impact_speed_max", "displacement_rms", "sticking_fraction"]);
    prop::option::weighted(0.3, prop::collection::vec(names, 0..3)).boxed()
}

fn response() -> Tasks {
    let over = parameter().prop_flat_map(|(name, low, high)| (Just(name), range(low, high)));
    let quantity = prop::sample::select(vec![json!(null), json!("power"), json!("velocity-max")]);
    (over, quantity, system())
        .prop_map(|((name, over), quantity, system)| {
            // most systems have no second stop
            let name = if name.starts_with("second") { "gap" } else { name };
            let task = json!({ "vary": name, "over": over, "quantity": quantity });
            (json!({ "response": task }), without(system, &[name]))
        })
        .boxed()
}

/// The physical units of a plan, most of them valid.
fn units() -> BoxedStrategy<Option<Value>> {
    let scale =
        prop::sample::select(vec![json!(0.005), json!(1e-300), json!(2.0), json!(0.1), json!(30), json!(1), json!(0)]);
    let units = (scale, any::<bool>())
        .prop_map(|(scale, hertz)| json!({ "length_m": scale, "time_s": 0.05, "mass_kg": 2.0, "hertz": hertz }));
    prop::option::weighted(0.06, units).boxed()
}

fn diagram() -> Tasks {
    let listed = prop::bool::weighted(0.15);
    let over = (parameter(), listed)
        .prop_flat_map(|((name, low, high), listed)| (Just(name), range(low, high), Just(listed)))
        .prop_map(|(name, over, listed)| (name, axis(name, &over, listed)));
    let direction = prop::sample::select(vec![
        json!("up"),
        json!("down"),
        json!("both"),
        json!({ "scatter": { "starts": 2, "seed": 1 } }),
    ]);
    let show = prop::sample::select(vec!["velocity", "strobe"]);
    (over, direction, show, 0..100_u64, 1..20_u64, system())
        .prop_map(|((name, mut task), direction, show, transient, keep, system)| {
            let rest = [
                ("direction", direction),
                ("show", json!(show)),
                ("transient", json!(transient)),
                ("keep", json!(keep)),
            ];
            rest.into_iter().for_each(|(field, value)| task[field] = value);
            (json!({ "diagram": task }), without(system, &[name]))
        })
        .boxed()
}

fn stretch() -> BoxedStrategy<(&'static str, Value, f64)> {
    let over = |(name, low, high)| (Just(name), interval(low, high));
    parameter()
        .prop_flat_map(over)
        .prop_map(|(name, over)| {
            let (from, to) = over.split_once(':').unwrap_or((&over, ""));
            let middle = 0.5 * (from.parse::<f64>().unwrap_or(0.5) + to.parse::<f64>().unwrap_or(0.5));
            (name, json!({ "parameter": name, "from": value(from), "to": value(to) }), middle)
        })
        .boxed()
}

fn continuation() -> Tasks {
    let kind = prop::sample::select(vec!["fold", "flip", "grazing"]);
    let what = (label(), kind, 0..3_u8, (2..120_u32, 0..3_u32, 2..4_u32));
    (stretch(), stretch(), what, system())
        .prop_map(|((p, first, middle), (q, second, _), (label, kind, which, (points, follow, grid)), system)| match which {
            0 => {
                let mut system = without(system, &[p]);
                system.push((p, middle.to_string()));
                (json!({ "branch": { "label": label, "vary": p, "to": first["to"], "follow": follow, "points": points } }), system)
            }
            1 => (json!({ "region": { "label": label, "across": first, "up": second, "grid": grid } }), region(system, p, &first, q, &second)),
            _ => {
                let mut system = without(system, &[p]);
                system.push((p, middle.to_string()));
                (json!({ "curve": { "label": label, "kind": kind, "vary": first, "and": second } }), system)
            }
        })
        .boxed()
}

/// The system with the first values of the parameters that vary over a region.
fn region(system: SystemValues, p: &'static str, first: &Value, q: &'static str, second: &Value) -> SystemValues {
    let mut system = without(system, &[p, q]);
    system.extend([(p, first["from"].to_string()), (q, second["from"].to_string())]);
    system
}

/// A plan, which is valid in most cases.
pub fn plan() -> BoxedStrategy<Value> {
    let task =
        prop_oneof![5 => one_start(), 2 => basin(), 2 => map(), 2 => diagram(), 3 => continuation(), 1 => response()];
    let tile = prop::option::weighted(0.1, prop::sample::select(vec![1, 2, 4096, 0, 4097]));
    (task, tile, units())
        .prop_map(|((task, system), tile, units)| {
            let mut plan = json!({ "version": 1, "system": of(&system), "task": task });
            if let Some(units) = units {
                plan["units"] = units;
            }
            if let Some(tile) = tile {
                plan["tile"] = json!(tile);
            }
            without_nulls(plan)
        })
        .boxed()
}

/// Removes null values, which TOML does not have; an absent field means the same in a plan.
fn without_nulls(value: Value) -> Value {
    match value {
        Value::Object(fields) => {
            let kept = fields.into_iter().filter(|(_, value)| !value.is_null());
            Value::Object(kept.map(|(name, value)| (name, without_nulls(value))).collect())
        }
        Value::Array(values) => Value::Array(values.into_iter().map(without_nulls).collect()),
        other => other,
    }
}
