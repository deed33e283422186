//! Machines that are driven by more than a force, on the command line.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{has, json, list, number, printed, refuse, refused, rows};

const MACHINE: &str = "--mass-kg 0.7 --stiffness-n-per-m 900 --damping-ns-per-m 2.1 --gap-m 0.004 --restitution 0.7 \
                       --omega-rad-per-s 31 --units si";

/// Base motion is a force m omega^2 Y, however its amplitude is given.
#[test]
fn a_shaken_base_is_a_force() {
    let force = 0.7 * 31.0 * 31.0 * 0.002;
    let by_force = json(&format!("settle {MACHINE} --force-n {force:?}"));
    let speed = |answer: &serde_json::Value| number(&answer["motion"]["quantities"]["impact_speed_max"]);
    for base in [
        "--base-displacement-m 0.002".to_owned(),
        format!("--base-velocity-m-per-s {:?}", 31.0 * 0.002),
        format!("--base-acceleration-m-per-s2 {:?}", 31.0 * 31.0 * 0.002),
        format!("--unbalance-kg-m {:?}", 0.7 * 0.002),
    ] {
        let answer = json(&format!("settle {MACHINE} {base}"));
        assert_eq!(answer["motion"]["label"], by_force["motion"]["label"], "{base}");
        assert!((speed(&answer) / speed(&by_force) - 1.0).abs() < 1e-12, "{base}");
        assert_eq!(answer["system"]["scales"]["frame"]["offset_m"], 0.0, "{base}");
    }
    // a stop fixed in space is another machine
    let space = json(&format!("settle {MACHINE} --base-displacement-m 0.002 --stop-in-space"));
    assert!((speed(&space) / speed(&by_force) - 1.0).abs() > 1e-3);
    let phase = number(&space["system"]["scales"]["frame"]["phase"]);
    let of = &space["motion"]["quantities"];
    assert!(number(&of["impact_loss_per_period"]) > 0.0 && of["work_per_period"].is_null());
    assert!((phase - (2.1_f64 * 31.0 / 900.0).atan()).abs() < 1e-14);
}

/// A constant force moves the equilibrium, towards one stop and away from the other.
#[test]
fn a_weight_moves_the_equilibrium() {
    let plain = json(&format!("settle {} --force-n 3 --second-gap-m 0.007", MACHINE.replace("0.004", "0.003")));
    let weight = json(&format!("settle {MACHINE} --force-n 3 --constant-force-n 0.9 --second-gap-m 0.006"));
    let gap = |answer: &serde_json::Value| number(&answer["system"]["second_gap"]);
    assert!((gap(&plain) - gap(&weight)).abs() < 1e-12);
    assert!((number(&plain["system"]["gap"]) - number(&weight["system"]["gap"])).abs() < 1e-12);
    assert!((number(&weight["system"]["scales"]["frame"]["offset_m"]) - 0.001).abs() < 1e-15);
    // 0.9 N as the weight of 0.7 kg, the same to rounding
    let gravity = format!("settle {MACHINE} --force-n 3 --gravity {:?} --second-gap-m 0.006", 0.9 / 0.7);
    assert!((gap(&json(&gravity)) - gap(&weight)).abs() < 1e-12);
    let text = printed(&format!("settle {MACHINE} --force-n 3 --constant-force-n 0.9"));
    has(&text, &["frame   positions relative to the motion of the stop, from 0.001 m"]);
}

#[test]
fn curves_over_numbers_that_change_several_parameters() {
    let base = format!("{MACHINE} --base-displacement-m 0.002");
    let curve = format!("curve {base} --label 1/1 --kind flip --vary gap=1:2 --and force-n=4:6");
    refuse([(curve, "hint: take frequency_hz, gap_m")]);
    printed(&format!("diagram {base} --vary gap-m --over 0.003:0.005:3"));
}

/// Each value of a sweep is the machine with that value: map, response and diagram against `settle` and `attractors` at
/// single values, over numbers that change the units and the equivalent force.
#[test]
fn each_value_of_a_sweep_is_a_machine() {
    let system = "--mass-kg 0.7 --stiffness-n-per-m 900 --damping-ns-per-m 2.1 --restitution 0.7";
    for (flag, values, rest) in [
        ("force-n", [2.0, 3.5, 5.0], "--gap-m 0.004 --frequency-hz 4.5"),
        ("mass-kg", [0.5, 0.75, 1.0], "--gap-m 0.004 --frequency-hz 4.5 --force-n 3"),
        ("stiffness-n-per-m", [600.0, 900.0, 1200.0], "--gap-m 0.004 --frequency-hz 4.5 --force-n 3"),
        ("damping-ns-per-m", [1.0, 2.5, 4.0], "--gap-m 0.004 --frequency-hz 4.5 --force-n 3"),
        ("frequency-hz", [4.0, 5.0, 6.0], "--gap-m 0.004 --unbalance-kg-m 0.004"),
        ("frequency-hz", [4.0, 5.0, 6.0], "--gap-m 0.004 --base-displacement-m 0.002 --stop-in-space"),
        ("base-acceleration-m-per-s2", [1.0, 2.0, 3.0], "--gap-m 0.004 --frequency-hz 4.5"),
        ("gap-m", [0.002, 0.004, 0.006], "--force-n 3 --constant-force-n -0.9 --frequency-hz 4.5"),
        ("constant-force-n", [-1.0, 0.5, 2.0], "--force-n 3 --gap-m 0.004 --frequency-hz 4.5"),
        ("gravity-m-per-s2", [-4.0, -1.25, 1.5], "--force-n 3 --gap-m 0.004 --frequency-hz 4.5"),
        ("mass-kg", [0.5, 0.75, 1.0], "--gap-m 0.004 --frequency-hz 4.5 --force-n 3 --gravity -1m/s^2"),
        ("gaps-m", [0.002, 0.004, 0.006], "--force-n 3 --frequency-hz 4.5"),
    ] {
        // the number that varies has no value of its own
        let own = system.split(" --").map(|own| own.trim_start_matches("--")).filter(|own| !own.starts_with(flag));
        let system = own.map(|own| format!("--{own} ")).collect::<String>();
        let range = format!("{}:{}:3", values[0], values[2]);
        let names = ["impact_speed_max", "displacement_max", "work_per_period", "impulse_max"];
        let fields = names.join(",");
        let map = format!("map {system} {rest} --{flag} {range} --starts 1 --fields {fields} --csv -");
        let table = printed(&map);
        let mapped = rows(&table);
        assert_eq!(mapped[0][0], flag.replace('-', "_"));
        // a store has the same table, each point in the units of its machine
        assert_eq!(printed(&format!("{map} --store m.zarr --quiet")), table);
        let swept = json(&format!("response {system} {rest} --{flag} {range} --quantity impact-speed-max"));
        for value in values {
            let alone = json(&format!("settle {system} {rest} --{flag} {value} --units si"));
            let of = |name: &str| alone["motion"]["quantities"][name].as_f64();
            let row = mapped.iter().find(|row| row[0].parse() == Ok(value)).unwrap();
            assert_eq!(row[1], alone["motion"]["label"].as_str().unwrap(), "{flag} {value}");
            for (cell, name) in row[3..].iter().zip(names) {
                assert_eq!(cell.parse::<f64>().ok(), of(name), "{flag} {value} {name}");
            }
            // a motion of a sweep is the one from rest, or another one at the same value
            let points = list(&swept["sweeps"][0]["points"]);
            let point = points.iter().find(|point| point["parameter"].as_f64() == Some(value)).unwrap();
            if point["label"] == alone["motion"]["label"] {
                let (a, b) = (point["value"].as_f64(), of("impact_speed_max"));
                let near = a.zip(b).is_none_or(|(a, b)| (a - b).abs() <= 1e-9 * b);
                assert!(near || row[1] == "chaos", "{flag} {value}: {a:?} {b:?}");
            }
        }
    }
}

/// The spectrum and the transient of `settle`: the largest values on the way are at least those of the motion, and the
/// harmonics have the mean square of the positions (Parseval).
#[test]
fn harmonics_and_transient() {
    let answer = json("settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --v 5");
    let motion = |name: &str| number(&answer["motion"]["quantities"][name]);
    let way = |name: &str| number(&answer["transient"]["quantities"][name]);
    assert!(way("velocity_max") >= 5.0 && way("displacement_min") <= motion("displacement_min"));
    assert_eq!(answer["transient"]["events"], answer["events_followed"]);
    let all = list(&answer["harmonics"]);
    let power: f64 = all.iter().map(|of| 0.5 * number(&of["amplitude"]).powi(2)).sum();
    let square = motion("displacement_rms").powi(2) - motion("displacement_mean").powi(2);
    assert!(power <= square * (1.0 + 1e-12) && power > 0.999 * square, "{power} {square}");
    // chaos has neither
    let chaos = json("settle --inverse-beta 1.11 --gap 3 --restitution 0.5");
    assert!(chaos.get("harmonics").is_none() && chaos.get("transient").is_none());
}

/// Along a line through both gaps, the stops of a machine may leave no room after the first change alone. And a map over
/// any number of a body has its range.
#[test]
fn both_gaps_of_a_machine_move_together() {
    let machine = "--mass-kg 0.7 --stiffness-n-per-m 900 --force-n 3 --frequency-hz 4.5 --restitution 0.7";
    let line = format!(
        "diagram {machine} --gap-m 0.001 --second-gap-m 0.002 --vary gap-m --over 0.001:-0.003:3 --also second-gap-m=0.002:0.006 --keep 2 --transient 20 --csv -"
    );
    let text = printed(&line);
    assert!(text.lines().any(|row| row.starts_with("-0.003,0.006,")), "{text}");
    let complaint = refused(&format!("map {} --force-n 1:3:3 --gap-m 0.004", machine.replace("--force-n 3 ", "")));
    assert!(complaint.contains("--starts") && !complaint.contains("a range A:B:N"), "{complaint}");
}
