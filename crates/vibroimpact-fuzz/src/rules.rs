//! Checks of every output: messages for users, JSON for programs.

use serde_json::Value;

/// Terms of the programming language, which must not occur in a message for users.
const INSIDE: [&str; 18] = [
    "called `",
    "unwrap",
    "panicked",
    "Option<",
    "Some(",
    "None)",
    "Err(",
    ".rs:",
    "RUST_BACKTRACE",
    "defect of vibro",
    "assertion",
    "PoisonError",
    "expected struct",
    "expected u32",
    "expected u64",
    "expected f64",
    "expected usize",
    "tuple variant",
];

/// Checks a message for users.
pub(crate) fn sentence(text: &str) -> Result<(), String> {
    if text.trim().is_empty() {
        return Err("no sentence says why".to_owned());
    }
    match INSIDE.into_iter().find(|word| text.contains(word)) {
        Some(word) => Err(format!("a message says `{word}`: {text}")),
        None => Ok(()),
    }
}

/// Checks that the bytes are one JSON object, which also excludes `NaN` and `Infinity`.
pub(crate) fn object(bytes: &[u8]) -> Result<Value, String> {
    match serde_json::from_slice::<Value>(bytes) {
        Ok(value) if value.is_object() => Ok(value),
        Ok(_) => Err("the JSON is no object".to_owned()),
        Err(why) => Err(format!("the JSON does not read: {why}")),
    }
}

/// Checks the fields that programs need in the answer to a task.
pub(crate) fn answer(task: &str, answer: &Value) -> Result<(), String> {
    let fields: &[&str] = match task {
        "settle" => &["system", "start", "motion", "plan"],
        "simulate" => &["system", "start", "events", "end", "plan"],
        "attractors" => &["system", "motions", "starts", "plan"],
        "orbit" => &["system", "orbits", "plan"],
        "branch" => &["system", "vary", "branches", "plan"],
        "lyapunov" => &["system", "exponents", "impacts_per_period", "plan"],
        "basin" => &["system", "axes", "motions", "cells", "plan"],
        "map" => &["system", "axes", "labels", "points", "plan"],
        "curve" => &["system", "points", "events", "plan"],
        "diagram" => &["system", "sweeps", "plan"],
        "region" => &["system", "existence", "stability", "plan"],
        "bench" => &["impacts_per_second", "starts_per_second"],
        _ => &[],
    };
    if let Some(field) = fields.iter().find(|field| answer.get(field).is_none_or(Value::is_null)) {
        return Err(format!("the answer to {task} has no `{field}`"));
    }
    let each = |field: &str, check: fn(&Value) -> Result<(), String>| {
        answer[field].as_array().into_iter().flatten().try_for_each(check)
    };
    match task {
        "settle" => motion(&answer["motion"]),
        "attractors" => each("motions", motion).and_then(|()| shares(&answer["motions"])),
        "orbit" => each("orbits", motion),
        "branch" => each("branches", branch),
        "simulate" => events(answer),
        _ => Ok(()),
    }
}

/// Checks that all rows of a table have the same number of cells, and no cell is `NaN`.
pub(crate) fn table(bytes: &[u8]) -> Result<(), String> {
    let text = core::str::from_utf8(bytes).map_err(|_| "the table is no text".to_owned())?;
    let columns = text.lines().next().map_or(0, |head| head.split(',').count());
    for (k, row) in text.lines().enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        if cells.len() != columns || cells.iter().any(|cell| matches!(*cell, "NaN" | "nan" | "inf" | "-inf")) {
            return Err(format!("row {k} of the table is `{row}`"));
        }
    }
    Ok(())
}

/// Checks that a figure is complete, and that all its coordinates are numbers.
pub(crate) fn figure(svg: &str) -> Result<(), String> {
    if svg.is_empty() {
        return Ok(());
    }
    if !svg.starts_with("<svg") || !svg.trim_end().ends_with("</svg>") {
        return Err("the figure is not whole".to_owned());
    }
    match ["NaN", "\"inf\"", "\"-inf\"", " inf ", " -inf "].into_iter().find(|word| svg.contains(word)) {
        Some(word) => Err(format!("the figure says {word}")),
        None => Ok(()),
    }
}

fn motion(motion: &Value) -> Result<(), String> {
    let (kind, label) = (motion["kind"].as_str().unwrap_or(""), motion["label"].as_str().unwrap_or(""));
    let agrees = match kind {
        "periodic" => {
            // a motion without impacts of an oscillator has no events in its cycle
            let cycle = motion["cycle"].as_array();
            (label.contains('/') || label == "0") && cycle.is_some_and(|cycle| cycle.is_empty() || label != "0")
        }
        "no_impact" => label == "0",
        "transient" => !label.is_empty(),
        "chaotic" | "stuck" | "undecided" => label == kind,
        _ => false,
    };
    if !agrees {
        return Err(format!("a motion of the kind `{kind}` with the label `{label}`: {motion}"));
    }
    motion["cycle"].as_array().into_iter().flatten().try_for_each(event)
}

/// Checks the fields of an event of any system.
fn event(event: &Value) -> Result<(), String> {
    // without forcing there is no phase
    let turn = 0.0..core::f64::consts::TAU;
    if event.get("phase").is_some_and(|phase| !phase.as_f64().is_some_and(|phase| turn.contains(&phase))) {
        return Err(format!("a phase outside [0, 2 pi): {event}"));
    }
    if event["speed"].as_f64().is_none_or(|speed| speed < 0.0) {
        return Err(format!("a speed that is negative: {event}"));
    }
    let lists = ["q", "qdot"].map(|name| event[name].as_array().map_or(0, Vec::len));
    if event["time"].as_f64().is_none() || event["stop"].as_str().is_none() || lists[0] == 0 || lists[0] != lists[1] {
        return Err(format!("an event lacks a field: {event}"));
    }
    Ok(())
}

/// Checks that the events of a branch lie at its points, and that it says how it ends.
fn branch(branch: &Value) -> Result<(), String> {
    let points = branch["points"].as_array().map_or(0, Vec::len) as u64;
    let there = |event: &Value| event["point"].as_u64().is_some_and(|point| point < points);
    let events = branch["events"].as_array();
    match events.filter(|events| events.iter().all(there)).and_then(|events| events.last()) {
        Some(last) if last["kind"] == branch["end"] && last["ends"] == true => Ok(()),
        _ => Err(format!("the events of a branch of {points} points that ends with {}", branch["end"])),
    }
}

fn shares(motions: &Value) -> Result<(), String> {
    let shares: Vec<f64> =
        motions.as_array().into_iter().flatten().filter_map(|motion| motion["share"].as_f64()).collect();
    let sum: f64 = shares.iter().sum();
    if (sum - 1.0).abs() > 1e-9 { Err(format!("the shares {shares:?} add up to {sum}")) } else { Ok(()) }
}

fn events(answer: &Value) -> Result<(), String> {
    const REASONS: [&str; 5] = ["no_more_impacts", "impact_limit", "time_limit", "stuck", "search_limit"];
    let reason = answer["end"]["reason"].as_str().unwrap_or("");
    if answer["system"]["kind"] != "machine" && !REASONS.contains(&reason) {
        return Err(format!("a simulation ends for the reason `{reason}`"));
    }
    answer["events"].as_array().into_iter().flatten().try_for_each(event)?;
    in_order(answer)
}

/// Checks that no event is earlier than the one before it.
fn in_order(answer: &Value) -> Result<(), String> {
    let mut last = 0.0;
    for event in answer["events"].as_array().into_iter().flatten() {
        let Some(time) = event["time"].as_f64().filter(|time| *time >= last) else {
            return Err(format!("an event before the one before it, at {last}: {event}"));
        };
        last = time;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_inside_are_found() {
        assert!(sentence("error: gap = 1 lies outside\n").is_ok());
        for bad in ["", "  \n", "thread 'main' panicked at src/main.rs:3", "called `Option::unwrap()`", "expected u64"]
        {
            assert!(sentence(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn answers_lack_nothing() {
        assert!(object(b"{\"a\":NaN}").is_err() && object(b"[1]").is_err() && object(b"{}").is_ok());
        let stuck = r#"{"system":{},"start":{},"plan":{},"motion":{"kind":"stuck","label":"stuck"}}"#;
        assert!(answer("settle", &object(stuck.as_bytes()).unwrap()).is_ok());
        for (from, to) in [
            ("\"start\"", "\"begin\""),
            ("\"label\":\"stuck\"", "\"label\":\"0\""),
            ("\"kind\":\"stuck\"", "\"kind\":\"\""),
        ] {
            assert!(answer("settle", &object(stuck.replace(from, to).as_bytes()).unwrap()).is_err(), "{to}");
        }
        let late = r#"{"system":{},"start":{},"plan":{},"end":{"reason":"stuck"},"events":[{"time":2},{"time":1}]}"#;
        assert!(answer("simulate", &object(late.as_bytes()).unwrap()).is_err());
    }
}
