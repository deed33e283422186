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

/// The name of a column without its unit.
fn bare(head: &str) -> String {
    let suffixes = QuantityKind::ALL.map(QuantityKind::suffix).into_iter().chain(["_s"]).filter(|end| !end.is_empty());
    suffixes.filter_map(|end| head.strip_suffix(end)).min_by_key(|bare| bare.len()).unwrap_or(head).to_owned()
}

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
        // names of columns end in their units
        (Value::Array(a), Value::Array(b)) if key == "columns" => {
            let bare: Vec<Value> = b.iter().map(|name| Value::from(bare(name.as_str().unwrap()))).collect();
            assert_eq!(a, &bare, "{path}");
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
        // the plans differ in their units alone
        let mut plan = b["plan"].clone();
        let units = plan.as_object_mut().unwrap().remove("units").unwrap();
        assert_eq!((&a["plan"], units["length_m"].as_f64()), (&plan, Some(LENGTH)), "{name}");
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
        assert!(a.len() == b.len() && a.len() > 1, "{name}");
        assert_eq!(a[0], b[0].iter().map(|head| bare(head)).collect::<Vec<_>>(), "{name}");
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

/// A store keeps its units: the table exported from it is that of the command without a store.
#[test]
fn stores_keep_their_units() {
    let mut stores = 0;
    for (name, plain, si, store, _) in COMMANDS {
        if !store {
            continue;
        }
        stores += 1;
        for (place, rest, flag) in [("plain.zarr", plain, false), ("si.zarr", si, true)] {
            let folder = tempfile::tempdir().unwrap();
            let line = line(name, rest, flag);
            let filled = vibro(&format!("{line} --store {place} --quiet")).current_dir(&folder).output().unwrap();
            assert!(filled.status.success(), "{name}: {}", String::from_utf8_lossy(&filled.stderr));
            if name == "attractors" {
                continue;
            }
            let again = vibro(&format!("{line} --store {place} --quiet --csv -")).current_dir(&folder).output();
            let exported = again.unwrap().stdout;
            let printed = vibro(&format!("{line} --csv -")).output().unwrap().stdout;
            assert_eq!(String::from_utf8(exported).unwrap(), String::from_utf8(printed).unwrap(), "{name}");
            // the figure of the store is that of the command
            let draw = |line: &str, file: &str| {
                let drawn = vibro(line).current_dir(&folder).output().unwrap();
                assert!(drawn.status.success(), "{line}: {}", String::from_utf8_lossy(&drawn.stderr));
                std::fs::read_to_string(folder.path().join(file)).unwrap()
            };
            let stored = draw(&format!("plot {place} stored.svg"), "stored.svg");
            assert_eq!(stored, draw(&format!("{line} --plot own.svg"), "own.svg"), "{name}");
        }
    }
    assert_eq!(stores, 3, "attractors, basin and diagram");
}

/// A map in physical units, in memory and in a store: each number is the nondimensional one times its unit.
#[test]
fn a_map_in_hertz() {
    let folder = tempfile::tempdir().unwrap();
    let rows = |line: &str| {
        let output = vibro(line).current_dir(&folder).output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).unwrap();
        text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect::<Vec<Vec<_>>>()
    };
    // omega_n = 8 rad/s
    let hertz = 8.0 / std::f64::consts::TAU;
    let tail = "--restitution 0.5 --starts 4 --fields impact-speed-max,power,displacement-rms,impulse-max";
    let machine = "--mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --damping-ratio 0.05";
    let si = format!("map {machine} --frequency-hz 0.8:1.6:3 --gap-m 0.25:0.75:3 {tail}");
    let (low, high) = (0.8 / hertz, 1.6 / hertz);
    let plain = rows(&format!("map --beta {low:?}:{high:?}:3 --gap 0.5:1.5:3 --damping 0.05 {tail} --csv -"));
    let found = rows(&format!("{si} --csv -"));
    let head = "frequency_hz,gap_m,label,share,impact_speed_max_m_per_s,power_w,displacement_rms_m,impulse_max_n_s";
    assert_eq!(found[0].join(","), head);
    assert_eq!(found[1][0], "0.8");
    assert_eq!(plain.len(), found.len());
    let factors = [hertz, LENGTH, 1.0, 1.0, VELOCITY, VELOCITY * VELOCITY / TIME, LENGTH, VELOCITY];
    for (a, b) in plain.iter().zip(&found).skip(1) {
        for ((a, b), factor) in a.iter().zip(b).zip(factors) {
            match (a.parse::<f64>(), b.parse::<f64>()) {
                (Ok(a), Ok(b)) => assert!(near(a * factor, b), "{a} {b} {factor}"),
                _ => assert_eq!(a, b),
            }
        }
    }
    let filled = vibro(&format!("{si} --store map.zarr --quiet")).current_dir(&folder).output().unwrap();
    assert!(filled.status.success(), "{}", String::from_utf8_lossy(&filled.stderr));
    assert_eq!(rows(&format!("{si} --store map.zarr --csv -")), found);
}

/// A sweep in Hz moves the frequency ratio alone, in every command that varies a parameter.
#[test]
fn frequencies_in_hertz() {
    let hertz = 8.0 / std::f64::consts::TAU;
    let same = |si: &str, plain: &str, head: &str| {
        let text = |line: &str| String::from_utf8(vibro(line).output().unwrap().stdout).unwrap();
        let (a, b) = (text(&format!("{si} --csv -")), text(&format!("{plain} --csv -")));
        assert!(a.starts_with(head), "{si}: {a}");
        assert_eq!(a.lines().count(), b.lines().count(), "{si}");
        assert!(a.lines().count() > 3, "{si}");
    };
    let machine = "--mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --gap-m 0.75 --restitution 0.5";
    let (low, high) = (0.8 / hertz, 1.2 / hertz);
    same(
        &format!("diagram {machine} --vary frequency-hz --over 0.8:1.2:5 --keep 8"),
        &format!("diagram --gap 1.5 --restitution 0.5 --vary beta --over {low:?}:{high:?}:5 --keep 8"),
        "frequency_hz,sweep,kind,side,phase,velocity_m_per_s",
    );
    let begin = 1.146 / hertz;
    same(
        &format!("branch {machine} --frequency-hz 1.146 --label 1/1 --vary frequency-hz --to 1.2"),
        &format!("branch --gap 1.5 --restitution 0.5 --beta {begin:?} --label 1/1 --vary beta --to {high:?}"),
        "branch,frequency_hz,label",
    );
    same(
        "region --mass-kg 1 --stiffness-n-per-m 64 --force-n 32 --restitution 0.5 --label 1/1 --frequency-hz 1.1:1.2 --gap-m 0.5:1.25 --grid 3",
        &format!("region --restitution 0.5 --label 1/1 --beta {:?}:{high:?} --gap 1:2.5 --grid 3", 1.1 / hertz),
        "region,polygon,hole,sheet,frequency_hz,gap_m,bound",
    );
    let refused = vibro("diagram --gap 1 --restitution 0.5 --vary frequency-hz --over 1:2:3").output().unwrap();
    let complaint = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(2) && complaint.contains("physical units"), "{complaint}");
}
