//! Machines that are driven by more than a force, on the command line.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{json, vibro};

const MACHINE: &str = "--mass-kg 0.7 --stiffness-n-per-m 900 --damping-ns-per-m 2.1 --gap-m 0.004 --restitution 0.7 \
                       --omega-rad-per-s 31 --units si";

/// Base motion is a force m omega^2 Y, however its amplitude is given.
#[test]
fn a_shaken_base_is_a_force() {
    let force = 0.7 * 31.0 * 31.0 * 0.002;
    let by_force = json(&format!("settle {MACHINE} --force-n {force:?}"));
    let speed = |answer: &serde_json::Value| answer["motion"]["quantities"]["impact_speed_max"].as_f64().unwrap();
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
    let phase = space["system"]["scales"]["frame"]["phase"].as_f64().unwrap();
    let of = &space["motion"]["quantities"];
    assert!(of["impact_loss_per_period"].as_f64().unwrap() > 0.0 && of["work_per_period"].is_null());
    assert!((phase - (2.1_f64 * 31.0 / 900.0).atan()).abs() < 1e-14);
}

/// A constant force moves the equilibrium, towards one stop and away from the other.
#[test]
fn a_weight_moves_the_equilibrium() {
    let plain = json(&format!("settle {} --force-n 3 --second-gap-m 0.007", MACHINE.replace("0.004", "0.003")));
    let weight = json(&format!("settle {MACHINE} --force-n 3 --constant-force-n 0.9 --second-gap-m 0.006"));
    let near = |key: &str| {
        let (a, b) = (plain["system"][key].as_f64().unwrap(), weight["system"][key].as_f64().unwrap());
        assert!((a - b).abs() < 1e-12, "{key}: {a} {b}");
    };
    near("gap");
    let gap = |answer: &serde_json::Value| answer["system"]["second_stop"]["gap"].as_f64().unwrap();
    assert!((gap(&plain) - gap(&weight)).abs() < 1e-12);
    assert!((weight["system"]["scales"]["frame"]["offset_m"].as_f64().unwrap() - 0.001).abs() < 1e-15);
    let text = String::from_utf8(
        vibro(&format!("settle {MACHINE} --force-n 3 --constant-force-n 0.9")).output().unwrap().stdout,
    );
    assert!(text.unwrap().contains("frame   positions relative to the motion of the stop, from 0.001 m"));
}

/// The equivalent force is computed once, so a sweep over what it depends on would be wrong.
#[test]
fn sweeps_that_would_be_wrong_are_refused() {
    for line in [
        format!("diagram {MACHINE} --base-displacement-m 0.002 --vary frequency-hz --over 4:6:3"),
        format!("diagram {MACHINE} --base-displacement-m 0.002 --stop-in-space --vary damping --over 0:0.1:3"),
        format!("branch {MACHINE} --force-n 3 --constant-force-n 1 --label 1/1 --vary gap-m --to 0.005"),
    ] {
        let refused = vibro(&line).output().unwrap();
        let complaint = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(refused.status.code() == Some(2) && complaint.contains("cannot vary here yet"), "{line}: {complaint}");
    }
    let fine =
        vibro(&format!("diagram {MACHINE} --base-displacement-m 0.002 --vary gap-m --over 0.003:0.005:3")).output();
    assert!(fine.unwrap().status.success());
}
