//! One vocabulary for every system: the answers to a command have the same fields for an oscillator, for a body in SI units and for
//! a machine of two coordinates, and are as `vibro schema COMMAND` says.

use crate::{Folder, has, json, list, printed, refused};
use serde_json::Value;
use std::collections::BTreeSet;

const OSCILLATOR: &str = "--inverse-beta 1.3 --gap 0.75 --restitution 0.5";
const BODY: &str = "--units si --mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --omega-rad-per-s 15.4 --gap-m 0.00375 \
                    --restitution 0.5";
const MACHINE: &str = "--machine two-mass-hammer";

/// The commands, and what each asks of the oscillator, of the body and of the machine.
const COMMANDS: [(&str, [&str; 3]); 11] = [
    ("simulate --impacts 3", ["", "", ""]),
    ("settle", ["", "", ""]),
    ("attractors --starts 4", ["", "", ""]),
    ("orbit --label 1/1", ["", "", ""]),
    ("branch --label 1/1", ["--vary gap --to 0.8", "--vary gap-m --to 0.004", "--vary frequency --to 1.19"]),
    (
        "curve --label 1/1 --kind grazing",
        [
            "--vary gap=0.1:3 --and restitution=0.4:0.6",
            "--vary gap-m=0.0005:0.015 --and restitution=0.4:0.6",
            "--set frequency=1.06 --vary frequency=1:1.1 --and b=0.45:0.55",
        ],
    ),
    ("lyapunov --impacts 1000", ["", "", ""]),
    ("margins", ["--vary gap --lines 2", "--vary gap-m --lines 2", "--vary frequency"]),
    ("response", ["", "", "--axis frequency=0.9:1.2:3"]),
    (
        "diagram",
        [
            "--vary damping --over 0.01:0.02:2",
            "--vary damping-ratio --over 0.01:0.02:2",
            "--vary frequency --over 1.1:1.2:2",
        ],
    ),
    ("basin", ["--x -1:0:2 --v 0:1:2", "--x -0.01:0:2 --v 0:0.1:2", "--axis q.head=-1:0:2 --axis qdot.head=0:1:2"]),
];

/// Fields that only some systems or motions have; each says so in the schema.
const OF_SOME: &str = "units scales harmonics transient box sum identity grounds measures residual touch of orbit phase impact also \
                       appears turns stop stops chatter contacts exact horizon why lyapunov";

/// Checks a value against a schema: the types, that nothing that is required is missing, and that nothing is there of which it
/// does not know.
fn check(value: &Value, schema: &Value, root: &Value, path: &str) {
    if let Some(name) = schema["$ref"].as_str() {
        return check(value, &root["$defs"][name.trim_start_matches("#/$defs/")], root, path);
    }
    if let Some(any) = schema["anyOf"].as_array() {
        if let Some(some) = any.iter().find(|one| one["type"] != "null").filter(|_| !value.is_null()) {
            check(value, some, root, path);
        }
        return;
    }
    // of several kinds of objects
    if schema.get("oneOf").is_some() {
        return;
    }
    match value {
        Value::Object(fields) => {
            let known = &schema["properties"];
            for name in schema["required"].as_array().into_iter().flatten() {
                assert!(fields.contains_key(name.as_str().unwrap_or_default()), "{path} has no {name}");
            }
            for (name, value) in fields {
                match known.get(name) {
                    Some(schema) => check(value, schema, root, &format!("{path}.{name}")),
                    None => assert_eq!(schema.get("additionalProperties"), Some(&true.into()), "{path}.{name}"),
                }
            }
        }
        Value::Array(values) => {
            if schema["items"].is_object() {
                values.iter().for_each(|value| check(value, &schema["items"], root, path));
            }
        }
        _ => {
            let kind = match value {
                Value::Null => "null",
                Value::Bool(_) => "boolean",
                Value::Number(_) => "number",
                _ => "string",
            };
            let types = &schema["type"];
            let allowed = |of: &Value| of == kind || kind == "number" && of == "integer";
            // a number that is not finite is null
            let number = |of: &Value| value.is_null() && (of == "number" || of == "integer");
            let fits = types.as_array().map_or_else(|| allowed(types) || number(types), |all| all.iter().any(allowed));
            assert!(fits || types.is_null(), "{path} is {value}, not {types}");
        }
    }
}

/// The paths of all fields but those of quantities, numbers of systems and plans, which have the names of their parts.
fn fields(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(own) => {
            for (name, value) in own.iter().filter(|(name, _)| !OF_SOME.split(' ').any(|of| of == *name)) {
                let path = format!("{path}.{name}");
                if !["plan", "quantities", "counts", "system", "event"].contains(&name.as_str()) {
                    fields(value, &path, found);
                }
                found.insert(path);
            }
        }
        Value::Array(all) => all.iter().for_each(|value| fields(value, path, found)),
        _ => {}
    }
}

#[test]
fn every_answer_is_as_its_schema_says_and_the_same_for_every_system() {
    for (command, flags) in COMMANDS {
        let verb = command.split(' ').next().unwrap();
        let schema: Value = serde_json::from_str(&printed(&format!("schema {verb}"))).expect("a schema");
        let answers: Vec<BTreeSet<String>> = [OSCILLATOR, BODY, MACHINE]
            .into_iter()
            .zip(flags)
            .map(|(system, more)| {
                // a response takes a range of a parameter
                let range = system.replace("--restitution 0.5", "--restitution 0.4:0.6:3").replace("--units si ", "");
                let system = if verb == "response" { &*range } else { system };
                // every command has a table and a figure too, for every system
                let folder = Folder::new();
                let answer = folder.json(&format!("{command} {system} {more} --csv a.csv --plot a.svg"));
                let (table, drawn) = (folder.read("a.csv"), folder.read("a.svg"));
                assert!(table.lines().count() > 1 && drawn.starts_with("<svg"), "{command} {system}");
                check(&answer, &schema, &schema, verb);
                let of = &answer["system"];
                assert!(of["kind"].is_string() && of["stops"].is_array(), "{command} {system}");
                let mut found = BTreeSet::new();
                fields(&answer, verb, &mut found);
                found
            })
            .collect();
        for other in &answers[1..] {
            let differ: Vec<_> = answers[0].symmetric_difference(other).collect();
            assert!(differ.is_empty(), "{command}: {differ:?}");
        }
    }
}

/// Maps, whose points have the numbers that vary by path, and what is asked of oscillators only.
#[test]
fn further_answers_are_as_their_schemas_say() {
    for line in [
        "map --restitution 0.5 --beta 0.8:0.9:2 --gap 0.5:1:2 --starts 3",
        "map --machine two-mass-hammer --axis frequency=0.8:1.2:2 --starts 2",
        "settle-many --sample sobol:8 --beta 1 --gap 0.5:1 --restitution 0.5 --fields power",
        "settle-many --machine two-mass-hammer --sample sobol:4 --over frequency=0.9:1.3 --fields power",
        "region --label 1/1 --inverse-beta 1.05:1.2 --gap 1:2.5 --restitution 0.5 --grid 4",
        "margins --machine two-mass-hammer --vary stop.anvil.gap,stop.anvil.restitution",
        "settle --inverse-beta 1.11 --gap 3 --restitution 0.5",
        "settle --inverse-beta 1.11 --gap -0.5 --restitution 0.5",
        "settle --beta 0.9 --gap -1.5 --restitution 0.5 --x -3",
        "settle --inverse-beta 0.7 --gap 4 --restitution 0.5",
        "settle --machine stick-slip",
    ] {
        let verb = line.split(' ').next().unwrap();
        let schema: Value = serde_json::from_str(&printed(&format!("schema {verb}"))).unwrap();
        check(&json(line), &schema, &schema, line);
    }
    let map = json("map --restitution 0.5 --beta 0.8:0.9:2 --gap 0.5:1:2 --starts 3");
    let points = list(&map["points"]);
    assert!(points.len() == 4 && points[1]["beta"] == 0.9 && points[1]["gap"] == 0.5, "{map}");
    assert!(points.iter().all(|point| point["motions"][0]["label"].is_string()), "{map}");
}

/// The columns of the tables of both kinds of system have the names of the JSON.
#[test]
fn tables_have_the_names_of_the_json() {
    let head = |line: &str| printed(&format!("{line} --csv -")).lines().next().unwrap_or_default().to_owned();
    let branch = "branch --label 1/1 --vary";
    assert_eq!(
        head(&format!("{branch} gap --to 0.8 {OSCILLATOR}")),
        "branch,gap,label,admissible,stable,stability,event,stop,fastest,multiplier_1_re,multiplier_1_im,multiplier_2_re,\
         multiplier_2_im,phases,speeds,stops"
    );
    let begin = "branch,frequency,label,admissible,stable,stability,event,stop,fastest,multiplier_1_re,";
    assert!(head(&format!("{branch} frequency --to 1.19 {MACHINE}")).starts_with(begin));
    for orbit in [format!("orbit --label 2/1 {OSCILLATOR}"), format!("orbit --label 1/1 {MACHINE}")] {
        let head = head(&orbit);
        assert!(head.starts_with("orbit,label,admissible,stable,stability,fastest,multiplier_1_re,"), "{head}");
        assert!(head.ends_with("phases,speeds,stops"), "{head}");
    }
    let diagram = |vary: &str, system: &str| head(&format!("diagram --vary {vary} {system}"));
    assert_eq!(diagram("damping --over 0.01:0.02:2", OSCILLATOR), "damping,sweep,kind,stop,phase,speed");
    assert_eq!(diagram("frequency --over 1.1:1.2:2", MACHINE), "frequency,sweep,kind,stop,phase,speed");
}

#[test]
fn a_command_without_an_answer_has_no_schema() {
    has(&refused("schema bench"), &["`bench` has no schema", "settle"]);
}
