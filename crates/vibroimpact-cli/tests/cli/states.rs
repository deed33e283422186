//! Whole states of machines: motions go on from what a command printed; and what is refused of machines.

use crate::{Folder, has, json, list, number, printed, rows};
use serde_json::Value;

/// A mass, 2 kg so that coordinates are rounded, with a damped pad whose surface recovers slowly, and friction.
const PADS: &str = r#"
[machine]
bodies = { mass = 2, other = 3 }
frequency = 0.7
link = [{ between = ["mass", "ground"], stiffness = 1, damping = 0.05 }, { between = ["mass", "other"], stiffness = 2 }]
force = [{ at = "mass", sin = 1 }]
stop = [
    { name = "pad", at = "mass", gap = 0.05, stiffness = 3, damping = 9 },
    { name = "wall", between = ["ground", "other"], gap = 0.2, restitution = 0.4 },
]
friction = [{ name = "guide", at = "other", sliding = 0.1, static = 0.15 }]
"#;

/// The motion from the state of each printed event has the same printed events after it, to the last digit.
#[test]
fn a14_motions_go_on_from_printed_states() {
    let folder = Folder::with("pads.toml", PADS);
    let simulate = "simulate --machine pads.toml";
    let found = folder.json(&format!("{simulate} --impacts 40"));
    folder.write("run.json", found.to_string());
    let events = list(&found["events"]);
    let without_time = |event: &Value| {
        let mut event = event.clone();
        event.as_object_mut().unwrap().remove("time");
        event
    };
    let mut surfaces = 0;
    for k in (0..30).filter(|k| events[*k]["kind"] != "graze") {
        surfaces += u32::from(events[k]["contacts"]["pad"].get("surface").is_some());
        let again = folder.json(&format!("{simulate} --impacts 10 --start run.json#/events/{k}"));
        let state = |event: &Value| (event["q"].clone(), event["exact"].clone());
        let next = events[k + 1..].iter().skip_while(|next| state(next) == state(&events[k]));
        for (again, next) in list(&again["events"]).iter().zip(next.take(9)) {
            let (mut again, mut next) = (without_time(again), without_time(next));
            // times of slow impacts are counted from each state; those before it are rounded as differences of times
            for event in [&mut again, &mut next] {
                event["exact"].as_object_mut().unwrap().remove("instants");
            }
            assert_eq!(again, next, "event {k}");
        }
    }
    assert!(surfaces > 5, "{surfaces}");
    // the last event of a file is the default, and a start that is printed is whole too
    let last = folder.json(&format!("{simulate} --impacts 1 --start run.json"));
    assert_eq!(last["start"]["contacts"], events[39]["contacts"]);
    assert_eq!(last["start"]["exact"], events[39]["exact"]);
}

/// The state of a settled motion is one of the motion: it has the same cycle.
#[test]
fn a14_settled_states_are_whole() {
    let folder = Folder::with("pads.toml", PADS);
    let found = folder.json("settle --machine pads.toml");
    let state = &found["motion"]["state"];
    assert!(state["contacts"]["pad"].is_object() && state["exact"].is_object(), "{state}");
    folder.write("run.json", found.to_string());
    let again = folder.json("simulate --machine pads.toml --impacts 2 --start run.json");
    let cycle = list(&found["motion"]["cycle"]);
    for event in list(&again["events"]) {
        let close = |one: &Value, other: &Value| (number(one) - number(other)).abs() < 1e-9;
        let same = |other: &&Value| other["kind"] == event["kind"] && close(&other["phase"], &event["phase"]);
        assert!(cycle.iter().any(|other| same(&other)), "{event} {cycle:?}");
    }
}

/// Tables say how far surfaces stand back, and what stops and joints do.
#[test]
fn a14_tables_have_states() {
    let table = Folder::with("pads.toml", PADS).printed("simulate --machine pads.toml --impacts 20 --csv -");
    let end = "force.guide,surface.pad,state.pad,state.wall,state.guide,phase,exact\n";
    has(&table, &[end, ",closed,open,", ",forward,"]);
}

/// The rows of a table that are states after events, as starts, with their times.
fn states_of(table: &str, coordinates: &[&str], contacts: &[&str]) -> Vec<(f64, Value)> {
    let mut lines = table.lines();
    let head: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let column = |name: String| head.iter().position(|own| *own == name);
    // the last cell is in quotes, in which quotes are doubled
    let rows = lines.filter_map(|row| row.strip_suffix('"')?.split_once(",\""));
    rows.map(|(row, digits)| {
        let row: Vec<&str> = row.split(',').collect();
        let number = |name: String| row[column(name).expect("a column")].parse::<f64>().expect("a number");
        let vector = |what: &str| coordinates.iter().map(|name| number(format!("{what}.{name}"))).collect::<Vec<_>>();
        let contact = |name: &&str| {
            let mut contact = serde_json::json!({ "state": row[column(format!("state.{name}")).expect("a column")] });
            if let Some(at) = column(format!("surface.{name}"))
                && row[at] != "0"
            {
                contact["surface"] = row[at].parse::<f64>().expect("a number").into();
            }
            ((*name).to_owned(), contact)
        };
        let contacts: serde_json::Map<String, Value> = contacts.iter().map(contact).collect();
        let exact: Value = serde_json::from_str(&digits.replace("\"\"", "\"")).expect("an object");
        let (q, qdot, phase) = (vector("q"), vector("qdot"), number("phase".to_owned()));
        (
            number("time".to_owned()),
            serde_json::json!({ "q": q, "qdot": qdot, "phase": phase, "contacts": contacts, "exact": exact }),
        )
    })
    .collect()
}

/// The rows of a table after events are whole states, from which motions go on to the last bit.
#[test]
fn a14_motions_go_on_from_rows_of_tables() {
    let folder = Folder::with("pads.toml", PADS);
    let simulate = "simulate --machine pads.toml";
    let found = folder.json(&format!("{simulate} --impacts 30"));
    let events: Vec<&Value> = list(&found["events"]).iter().filter(|event| event["kind"] != "graze").collect();
    let table = folder.printed(&format!("{simulate} --impacts 30 --csv -"));
    let states = states_of(&table, &["mass", "other"], &["pad", "wall", "guide"]);
    assert!(states.len() > 20, "{table}");
    for (time, state) in &states[..20] {
        let last = events.iter().rposition(|event| number(&event["time"]) <= *time).unwrap();
        for name in ["q", "qdot", "phase", "contacts", "exact"] {
            assert_eq!(state[name], events[last][name], "{name} at {time}");
        }
    }
    // the same of an oscillator, whose state is its place, velocity and phase
    let line = "simulate --inverse-beta 1.3 --gap 0.2 --restitution 0.6";
    let found = json(&format!("{line} --impacts 20"));
    let table = printed(&format!("{line} --impacts 20 --csv -"));
    let rows = rows(&table);
    for event in list(&found["events"]).iter().take(15).filter(|event| event["kind"] == "impact") {
        let time = number(&event["time"]);
        let row = rows[1..].iter().rfind(|row| row[0].parse::<f64>().unwrap() <= time).unwrap();
        let again = json(&format!("{line} --x {} --v {} --phase {} --impacts 3", row[1], row[2], row[3]));
        let next = list(&found["events"]).iter().skip_while(|next| number(&next["time"]) <= time);
        for (again, next) in list(&again["events"]).iter().zip(next) {
            for name in ["kind", "q", "qdot", "phase", "speed"] {
                assert_eq!(again[name], next[name], "{name} after {time}");
            }
        }
    }
}

/// A fast oscillation beside a slow one: the next impact is farther away than the search goes. What is known is printed, and the
/// exit status is 1; a verdict says how far it looked.
#[test]
fn a13_a_search_limit_is_an_end() {
    let machine = "[machine]\ncoordinates = [\"fast\", \"slow\"]\nmass = [1, 1]\nstiffness = [1e14, 1]\n[[machine.stop]]\n\
        name = \"stop\"\ndirection = [1, 1]\ngap = 0.5\nrestitution = 0.5\n";
    let folder = Folder::with("two.toml", machine);
    let line = |verb: &str| format!("{verb} --machine two.toml --q 0.1,0 --qdot 0,0.45");
    let (code, text, complaint) = folder.ran(&line("simulate --time 10000"));
    assert_eq!(code, Some(1), "{text} {complaint}");
    has(&text, &["ran out of steps"]);
    has(&complaint, &["hint: numbers that lie many orders"]);
    let settled = folder.printed(&line("settle"));
    // 10 000 radians of the mode with stiffness 1e14, beside which a stiffness of 1 is none
    has(&settled, &["no event within a time of 0.001 after the last one"]);
}

/// Contacts that do not agree with a start, states that are none, and machines that are none.
#[test]
fn a13_what_is_refused() {
    let folder = Folder::with("pads.toml", PADS);
    let start = |contacts: &str| format!("[start]\ncontacts = {{ {contacts} }}\n{PADS}");
    folder.write("closed.toml", start("pad = { state = \"closed\" }"));
    folder.write("unknown.toml", start("pat = { state = \"closed\" }"));
    folder.write("none.json", "{\"text\": 1}");
    folder.write("link.toml", "[machine]\nbodies = { a = 1 }\nlink = [{ between = [\"a\", \"ground\"] }]\n");
    let bodies: Vec<String> = (0..3000).map(|k| format!("b{k} = 1")).collect();
    folder.write("large.toml", format!("[machine]\nbodies = {{ {} }}\n", bodies.join(", ")));
    let lyapunov = "lyapunov --machine two-mass-hammer";
    folder.refuse([
        ("simulate --machine closed.toml", "contact.pad: the stop has the gap 0.05"),
        ("simulate --machine unknown.toml", "known names are pad, wall, guide"),
        ("simulate --machine pads.toml --start none.json", "has no state of a machine"),
        ("machine show link.toml", "link.a-ground: a stiffness or a damping is needed"),
        ("machine show large.toml", "a machine has at most 1000 coordinates, and this one has 3000"),
        (&format!("{lyapunov} --impacts 10"), "impacts = 10 lies outside 25 <= impacts <= 10000000"),
        (&format!("{lyapunov} --transient 20000000"), "transient = 20000000 lies outside 0 <= transient <= 1000000"),
    ]);
}

/// A matrix that is symmetric but for rounding is accepted, and is exactly symmetric then.
#[test]
fn a13_rounded_matrices_are_made_symmetric() {
    let text = "[machine]\ncoordinates = [\"a\", \"b\"]\nmass = [1, 1]\nstiffness = [1, 1]\n\
                damping = [[2e-3, 1.6e-20], [0, 3e-3]]\n";
    let folder = Folder::with("matrix.toml", text);
    let shown = folder.json("machine show matrix.toml");
    assert_eq!(shown["machine"]["damping"], serde_json::json!([[2e-3, 8e-21], [8e-21, 3e-3]]));
    folder.write("matrix.toml", text.replace("1.6e-20", "1.6e-10"));
    folder.refuse([("machine show matrix.toml", "the matrix is not symmetric")]);
}
