//! Metres and seconds: every command gives the same numbers converted, in JSON and in its table, or a refusal.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{json, vibro};
use serde_json::Value;
use std::collections::BTreeSet;
use vibroimpact::QuantityKind;
use vibroimpact::quantities::Quantity;

/// A system in physical units: omega_n = 8 rad/s, F/k = 0.5 m. Its units are powers of two, so that conversion is
/// exact.
const MACHINE: &str =
    "--mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --omega-rad-per-s 7.2 --gap-m 0.75 --restitution 0.5";
const LENGTH: f64 = 0.5;
const TIME: f64 = 0.125;
const VELOCITY: f64 = 4.0;

/// Every command with units: its ranges and starts in F/k and in metres, and whether it has a store and a table.
const COMMANDS: [(&str, &str, &str, bool, bool); 10] = [
    ("simulate", "--x -1 --v 0.5 --impacts 5", "--x -0.5 --v 2 --impacts 5", false, true),
    ("settle", "--x -1 --v 0.5", "--x -0.5 --v 2", false, true),
    ("attractors", "--starts 20", "--starts 20", true, true),
    ("orbit", "--label 1/1", "--label 1/1", false, false),
    ("basin", "--x -2:1.5:6 --v -1:1:5", "--x -1:0.75:6 --v -4:4:5", true, true),
    ("diagram", "--vary gap --over 0.5:1.5:5 --keep 8", "--vary gap --over 0.25:0.75:5 --keep 8", true, true),
    ("branch", "--label 1/1 --vary gap --to 2.25", "--label 1/1 --vary gap --to 1.125", false, true),
    (
        "curve",
        "--label 1/1 --kind flip --vary gap=1:2.5 --and restitution=0.45:0.55",
        "--label 1/1 --kind flip --vary gap=0.5:1.25 --and restitution=0.45:0.55",
        false,
        true,
    ),
    (
        "region",
        "--label 1/1 --beta 0.85:0.95 --gap 1:2.5 --grid 3",
        "--label 1/1 --beta 0.85:0.95 --gap 0.5:1.25 --grid 3",
        false,
        true,
    ),
    ("lyapunov", "--impacts 1000 --x -1", "--impacts 1000 --x -0.5", false, true),
];

/// The command line.
fn line(name: &str, rest: &str, si: bool) -> String {
    format!("{name} {MACHINE} {rest}{}", if si { " --units si" } else { "" })
}

/// The unit of the numbers under a key, if the key determines it.
fn unit(key: &str) -> Option<f64> {
    match key {
        "x" | "gap" => Some(LENGTH),
        "v" | "velocity" | "velocity_before" | "velocity_after" => Some(VELOCITY),
        "t" | "time" | "interval" => Some(TIME),
        // the columns of quantities end in their units
        _ => Quantity::ALL.into_iter().find(|quantity| key == quantity.name()).map(|quantity| {
            let mass = 1.0;
            match quantity.kind() {
                QuantityKind::Number => 1.0,
                QuantityKind::Length => LENGTH,
                QuantityKind::Velocity => VELOCITY,
                QuantityKind::Acceleration => VELOCITY / TIME,
                QuantityKind::Impulse => mass * VELOCITY,
                QuantityKind::Energy => mass * VELOCITY * VELOCITY,
                QuantityKind::Power => mass * VELOCITY * VELOCITY / TIME,
                QuantityKind::Rate => 1.0 / TIME,
            }
        }),
    }
}

const UNITS: [f64; 5] = [1.0, LENGTH, TIME, VELOCITY, 1.0 / TIME];

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs()) + 1e-14
}

/// Compares two results, and collects the factors by which numbers differ.
fn compare(path: &str, key: &str, plain: &Value, si: &Value, factors: &mut BTreeSet<String>) {
    match (plain, si) {
        (Value::Object(a), Value::Object(b)) => {
            assert!(a.keys().eq(b.keys()), "{path}: {a:?} {b:?}");
            for (name, value) in a {
                compare(&format!("{path}.{name}"), name, value, &b[name], factors);
            }
        }
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len(), "{path}");
            for (k, (a, b)) in a.iter().zip(b).enumerate() {
                compare(&format!("{path}[{k}]"), key, a, b, factors);
            }
        }
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            number(path, key, a, b, factors);
        }
        (a, b) => assert_eq!(a, b, "{path}"),
    }
}

fn number(path: &str, key: &str, a: f64, b: f64, factors: &mut BTreeSet<String>) {
    let units = unit(key).map_or_else(|| UNITS.to_vec(), |unit| vec![unit]);
    let Some(unit) = units.iter().find(|unit| near(a * **unit, b)) else { panic!("{path}: {a} and {b}") };
    factors.insert(unit.to_string());
}

#[test]
fn f08_every_command_converts_its_json() {
    for (name, plain, si, ..) in COMMANDS {
        let (a, b) = (json(&line(name, plain, false)), json(&line(name, si, true)));
        assert_eq!((a["units"].as_str(), b["units"].as_str()), (Some("nondimensional"), Some("si")), "{name}");
        let mut factors = BTreeSet::new();
        for (key, value) in a.as_object().unwrap() {
            // the plan is nondimensional in both results, and the system is reported as it was given
            if !["units", "plan", "system"].contains(&key.as_str()) {
                compare(key, key, value, &b[key], &mut factors);
            }
        }
        assert!(factors.len() > 1 || name == "attractors", "{name}: nothing is converted");
        assert_eq!(a["plan"], b["plan"], "{name}");
    }
}

#[test]
fn f08_every_command_converts_its_table() {
    let rows = |line: &str| {
        let output = vibro(line).output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).unwrap();
        text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect::<Vec<Vec<_>>>()
    };
    for (name, plain, si, _, table) in COMMANDS {
        if !table {
            continue;
        }
        let flag = if name == "lyapunov" { " --points 20 --section -" } else { " --csv -" };
        let (a, b) = (rows(&(line(name, plain, false) + flag)), rows(&(line(name, si, true) + flag)));
        assert!(a.len() == b.len() && a.len() > 1 && a[0] == b[0], "{name}");
        let mut factors = BTreeSet::new();
        for (left, right) in a.iter().zip(&b).skip(1) {
            for ((head, left), right) in a[0].iter().zip(left).zip(right) {
                for (left, right) in left.split(' ').zip(right.split(' ')) {
                    match (left.parse::<f64>(), right.parse::<f64>()) {
                        (Ok(left), Ok(right)) => number(&format!("{name} {head}"), head, left, right, &mut factors),
                        _ => assert_eq!(left, right, "{name} {head}"),
                    }
                }
            }
        }
        assert!(factors.len() > 1 || name == "attractors", "{name}: nothing is converted");
    }
}

/// A store has no units: every command that fills one refuses physical units, whatever its other outputs.
#[test]
fn f08_no_command_fills_a_store_in_metres() {
    let mut stores = 0;
    for (name, plain, si, store, _) in COMMANDS {
        let folder = tempfile::tempdir().unwrap();
        for more in ["", " --csv t.csv", " --csv -", " --json", " --tile 4"] {
            let output =
                vibro(&(line(name, si, true) + " --store s.zarr" + more)).current_dir(&folder).output().unwrap();
            let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{name}{more}: {complaint}");
            assert!(output.stdout.is_empty() && folder.path().read_dir().unwrap().count() == 0, "{name}{more}");
            assert_eq!(complaint.contains("--units si cannot go together with --store"), store, "{name}: {complaint}");
        }
        if store {
            stores += 1;
            let output = vibro(&(line(name, plain, false) + " --store s.zarr --quiet")).current_dir(&folder).output();
            assert!(output.unwrap().status.success(), "{name}");
            if name == "attractors" {
                continue;
            }
            // the exported table is equal to that of the command without a store
            let exported = vibro("export s.zarr --csv -").current_dir(&folder).output().unwrap().stdout;
            let printed = vibro(&(line(name, plain, false) + " --csv -")).output().unwrap().stdout;
            let (exported, printed) = (String::from_utf8(exported).unwrap(), String::from_utf8(printed).unwrap());
            let first = |text: &str| text.lines().nth(1).unwrap().split(',').next().unwrap().to_owned();
            assert_eq!(first(&exported), first(&printed), "{name}");
        }
    }
    assert_eq!(stores, 3, "attractors, basin and diagram; a map takes no units");
}
