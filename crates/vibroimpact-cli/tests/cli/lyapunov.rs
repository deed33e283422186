//! Tests of `vibro lyapunov`: exponents with errors or the reason for their absence, and the points of both sections.

use crate::{Folder, S, has, json, list, number, printed, refuse, rows};
use serde_json::Value;

/// U of the 1971 paper, where the motion is chaotic.
const U: &str = "--inverse-beta 1.11 --gap 3 --restitution 0.5";

/// Value and error.
fn measured(object: &Value) -> (f64, f64) {
    (number(&object["value"]), number(&object["error"]))
}

#[test]
fn chaos_at_u_with_the_identity_and_the_dimension() {
    let answer = json(&format!("lyapunov {U} --impacts 20000"));
    assert_eq!((&answer["system"]["gap"], &answer["start"]["phase"]), (&3.0.into(), &0.0.into()));
    assert_eq!((&answer["motion"]["kind"], &answer["motion"]["lyapunov"]), (&"chaotic".into(), &Value::Null));
    let [(one, error), (two, _)] = [0, 1].map(|k| measured(&answer["exponents"][k]));
    assert!(error > 0.0 && one > 10.0 * error && error < 0.05 * one);
    let period = core::f64::consts::TAU * 1.11;
    assert!((measured(&answer["exponents_per_period"][0]).0 - one * period).abs() < 1e-14);
    assert!(one + two < 0.0 && answer["sum"]["value"].is_f64() && answer["identity"].is_f64());
    let dimension = measured(&answer["dimension"]["section"]).0;
    assert!((measured(&answer["dimension"]["flow"]).0 - dimension - 1.0).abs() < 1e-12);
    let grounds = &answer["grounds"];
    assert_eq!((&grounds["kind"], &grounds["impacts"]), (&"measured".into(), &20_000.into()));
    assert_eq!((&grounds["transient"], &grounds["blocks"]), (&1000.into(), &128.into()));
    let task = &answer["plan"]["task"]["lyapunov"];
    assert_eq!((&task["impacts"], &task["transient"], &task["points"]), (&20_000.into(), &1000.into(), &Value::Null));
}

#[test]
fn where_there_is_nothing_to_measure() {
    let why = |answer: &Value| [0, 1].map(|k| answer["exponents"][k]["why"].clone());
    let sticks = json("lyapunov --beta 0.9 --gap -0.5 --restitution 0.5");
    assert_eq!((&sticks["grounds"]["kind"], &sticks["motion"]["label"]), (&"sticks".into(), &"inf/1".into()));
    assert_eq!(why(&sticks), ["minus_infinity", "minus_infinity"]);
    assert_eq!((&sticks["exponents"][0]["value"], &sticks["exponents"][0]["error"]), (&Value::Null, &Value::Null));
    assert_eq!((&sticks["impacts_per_period"]["why"], &sticks["identity"]), (&"infinity".into(), &Value::Null));

    let stuck = json("lyapunov --beta 0.9 --gap -1.5 --restitution 0.5 --x -3");
    assert_eq!((&stuck["grounds"]["kind"], &stuck["grounds"]["stop"]), (&"stuck".into(), &"upper".into()));

    let plastic = json("lyapunov --inverse-beta 1.11 --gap 3 --restitution 0 --impacts 2000");
    assert_eq!(why(&plastic), [Value::Null, "minus_infinity".into()]);
    assert_eq!(measured(&plastic["dimension"]["section"]), (0.0, 0.0));

    let free = json("lyapunov --inverse-beta 0.7 --gap 4 --restitution 0.5 --damping 0.2");
    assert!(free["grounds"]["kind"] == "no_impact" && free["grounds"]["horizon"]["kind"] == "forever", "{free}");
    assert_eq!([0, 1].map(|k| measured(&free["exponents"][k])), [(-0.2, 0.0); 2]);

    let touches = json("lyapunov --inverse-beta 0.7 --gap 2.5 --restitution 0.5 --x 0.25 --v 0.8");
    assert_eq!((&touches["grounds"]["kind"], &touches["dimension"]["section"]), (&"touches".into(), &Value::Null));
    assert_eq!(why(&touches), ["undefined", "undefined"]);
}

#[test]
fn both_sections_as_a_table() {
    let table = printed(&format!("lyapunov {S} --impacts 1000 --section - --points 4"));
    let rows = rows(&table);
    assert_eq!(rows[0], ["section", "stop", "phase", "speed", "x", "v"]);
    assert_eq!(rows.len(), 9, "{table}");
    assert!(rows[1..5].iter().all(|row| (row[0], row[1], row[4]) == ("closing", "upper", "0.75")), "{table}");
    // one state in each period, equal to rounding
    let state = |row: &[&str]| [4, 5].map(|k| row[k].parse::<f64>().unwrap());
    for row in &rows[5..9] {
        assert_eq!((row[0], row[1], row[2], row[3]), ("strobe", "", "0", ""));
        let (now, first) = (state(row), state(&rows[5]));
        assert!((now[0] - first[0]).abs() < 1e-9 && (now[1] - first[1]).abs() < 1e-9, "{row:?}");
    }
    // after an impact on the lower stop the velocity is positive
    let line = "lyapunov --beta 0.7 --gap 0.6 --restitution 0.7 --second-gap 0.8 --impacts 1000 --csv - --points 50";
    let table = printed(line);
    let lower: Vec<&str> = table.lines().filter(|row| row.starts_with("closing,lower,")).collect();
    assert!(!lower.is_empty() && lower.iter().all(|row| row.contains(",-0.8,") && !row.contains(",-0.8,-")), "{table}");
}

#[test]
fn text_for_people() {
    let chaos = printed(&format!("lyapunov {U} --impacts 5000"));
    let label = "chaotic: no repetition in 6000 impacts";
    has(&chaos, &[label, "larger exponent   0.01", "Kaplan-Yorke dimension 1.1", "5000 impacts"]);
    let sticks = printed("lyapunov --beta 0.9 --gap -0.5 --restitution 0.5");
    has(&sticks, &["larger exponent   minus infinity", "forgets all before it"]);
}

/// Over axes, each row has the exponents of its point alone; of a machine likewise.
#[test]
fn exponents_over_axes_are_those_of_each_point() {
    let (length, pair) = ("--impacts 1000 --transient 100", "--machine impact-pair");
    for (study, alone, axis, last) in [
        (format!("{U} --axis gap=2.9,3"), U, "gap", "3"),
        (format!("{pair} --axis stop.right.gap=0.45,0.5"), pair, "stop.right.gap", "0.5"),
    ] {
        let study = printed(&format!("lyapunov {study} {length} --csv -"));
        let table = rows(&study);
        // a row for each exponent of a point, the second point last
        let alone = json(&format!("lyapunov {alone} {length}"));
        let exponents = list(&alone["exponents"]);
        assert_eq!(table.len(), 1 + 2 * exponents.len());
        assert_eq!(table[0][..4], [axis, "direction", "exponent", "exponent_error"]);
        for (row, of) in table[1 + exponents.len()..].iter().zip(exponents) {
            let (value, error) = measured(of);
            assert_eq!((row[0], row[2].parse(), row[3].parse()), (last, Ok(value), Ok(error)), "{row:?}");
        }
    }
    // in SI units per second, as of one motion
    let si = "lyapunov --mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --frequency-hz 4 --gap-m 0.01 --restitution 0.5 --damping-ns-per-m 1 \
              --units si --impacts 1000";
    let (study, alone) = (printed(&format!("{si} --axis gap-m=0.01,0.011 --csv -")), json(si));
    let table = rows(&study);
    assert_eq!((table[0][0], table[0][2]), ("gap_m", "exponent_per_s"));
    assert_eq!(table[1][2].parse::<f64>().unwrap(), measured(&alone["exponents"][0]).0);
    // and the figure: the smaller exponent at gap 0 is -5.03 per second, -0.25 per unit of nondimensional time
    let svg = Folder::new().drawn(&format!("{si} --axis gap-m=0:0.02:3"), "a.svg");
    has(&svg, &["gap (m)<", "Lyapunov exponents (1/s)<", ">\u{2212}5<"]);
    refuse([
        (format!("lyapunov {U} --axis gap=1:2:3 --axis x=0,0.5 --plot a.png"), "drawn over one axis"),
        (format!("lyapunov {U} --axis size=0:1:3 --csv -"), "`size` cannot vary"),
        (format!("lyapunov {U} --axis gap=0:1:3"), "would be lost"),
        (format!("lyapunov {U} --store s.zarr"), "one motion needs no store"),
        (format!("lyapunov {U} --axis gap=1:2:3 --points 5 --plot a.png"), "without --axis"),
    ]);
}
