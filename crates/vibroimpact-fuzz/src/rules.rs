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
///
/// # Errors
/// A description of the fault.
pub fn sentence(text: &str) -> Result<(), String> {
    if text.trim().is_empty() {
        return Err("no sentence says why".to_owned());
    }
    match INSIDE.into_iter().find(|word| text.contains(word)) {
        Some(word) => Err(format!("a message says `{word}`: {text}")),
        None => Ok(()),
    }
}

/// Checks that the bytes are one JSON object, which also excludes `NaN` and `Infinity`.
///
/// # Errors
/// The position at which it cannot be parsed.
pub fn object(bytes: &[u8]) -> Result<Value, String> {
    match serde_json::from_slice::<Value>(bytes) {
        Ok(value) if value.is_object() => Ok(value),
        Ok(_) => Err("the JSON is no object".to_owned()),
        Err(why) => Err(format!("the JSON does not read: {why}")),
    }
}

/// Checks the fields that programs need in the answer to a task.
///
/// # Errors
/// The name of a missing field.
pub fn answer(task: &str, answer: &Value) -> Result<(), String> {
    let fields: &[&str] = match task {
        "settle" => &["system", "start", "motion", "plan"],
        "simulate" => &["system", "start", "events", "end", "plan"],
        "attractors" => &["system", "motions", "starts", "plan"],
        "orbit" => &["system", "orbits", "plan"],
        "branch" => &["system", "points", "events", "plan"],
        "lyapunov" => &["system", "exponents", "impacts_per_period", "plan"],
        "basin" | "map" | "diagram" | "region" | "curve" => &["system", "plan"],
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
        "simulate" => events(answer),
        _ => Ok(()),
    }
}

/// Checks the fields that programs need in the answer to a task about a machine.
///
/// # Errors
/// The name of a missing field.
pub fn machine_answer(task: &str, answer: &Value) -> Result<(), String> {
    let fields: &[&str] = match task {
        "settle" => &["start", "motion", "plan"],
        "simulate" => &["start", "events", "end", "plan"],
        "attractors" => &["motions", "starts", "plan"],
        "orbit" => &["orbits", "plan"],
        "branch" => &["points", "events", "plan"],
        "basin" | "map" => &["axes", "plan"],
        "diagram" => &["sweeps", "plan"],
        _ => &[],
    };
    if let Some(field) = fields.iter().find(|field| answer.get(field).is_none_or(Value::is_null)) {
        return Err(format!("the answer to {task} about a machine has no `{field}`"));
    }
    if task == "simulate" { in_order(answer) } else { Ok(()) }
}

/// Checks that all rows of a table have the same number of cells, and no cell is `NaN`.
///
/// # Errors
/// The first row with a fault.
pub fn table(bytes: &[u8]) -> Result<(), String> {
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
///
/// # Errors
/// A description of the fault.
pub fn figure(svg: &str) -> Result<(), String> {
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
            let cycle = motion["cycle"].as_array();
            // a motion without impacts has none in its cycle
            (label.contains('/') || label == "0")
                && cycle.is_some_and(|cycle| cycle.is_empty() == (label == "0") || label.starts_with("inf"))
        }
        "no_impact" => label == "0",
        "transient" => !label.is_empty(),
        "chaotic" | "stuck" | "undecided" => label == kind,
        _ => false,
    };
    if !agrees {
        return Err(format!("a motion of the kind `{kind}` with the label `{label}`: {motion}"));
    }
    for impact in motion["cycle"].as_array().into_iter().flatten() {
        let phase = impact["phase"].as_f64();
        if !phase.is_some_and(|phase| (0.0..core::f64::consts::TAU).contains(&phase)) {
            return Err(format!("a phase outside [0, 2 pi): {impact}"));
        }
        if impact["velocity_before"].as_f64().is_none_or(|v| v < 0.0) {
            return Err(format!("an arrival that is not positive: {impact}"));
        }
    }
    Ok(())
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
    if !REASONS.contains(&reason) {
        return Err(format!("a simulation ends for the reason `{reason}`"));
    }
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
