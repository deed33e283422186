//! Tests of `vibro margins`: distances, boxes, units and refusals.

use crate::{has, json, list, number, printed, refuse, refused, rows, texts};
use serde_json::Value;

/// Below the flip of 1/1 at the gap 1.829.
const ONE: &str = "margins --inverse-beta 1.11 --gap 1.5 --restitution 0.5";
const MACHINE: &str = "--mass-kg 0.8 --stiffness-n-per-m 12000 --force-n 30 --damping-ratio 0.02 --restitution 0.65 \
                       --frequency-hz 20 --gap-m 0.0015";

/// The object of a parameter.
fn of<'a>(answer: &'a Value, name: &str) -> &'a Value {
    list(&answer["parameters"]).iter().find(|one| one["parameter"] == name).expect("it varies")
}

#[test]
fn the_distance_is_that_of_the_branch() {
    let answer = json(&format!("{ONE} --label 1/1"));
    let up = &of(&answer, "gap")["up"];
    assert_eq!((&up["event"]["kind"], &up["event"]["ends"]), (&"flip".into(), &false.into()));
    assert!((number(&up["at"]) - 1.829_006_189_683_6).abs() < 1e-11);
    assert!((number(&up["relative"]) - number(&up["distance"]) / 1.5).abs() < 1e-15);
    let down = &of(&answer, "damping")["down"];
    assert_eq!((&down["event"], &down["limit"], &down["at"]), (&Value::Null, &0.0.into(), &Value::Null));
    assert_eq!(texts(&answer["parameters"], "parameter"), ["inverse_beta", "gap", "restitution", "damping"]);
    let found = &answer["box"];
    assert!(number(&found["size"]) > 0.0 && number(&found["size"]) <= number(&found["largest"]), "{found}");
    assert_eq!((&found["proved"], &answer["nearest"]["parameter"]), (&false.into(), &answer["nearest"]["parameter"]));
    assert_eq!(answer["plan"]["task"]["margins"]["label"], "1/1");
    // the same question gives the same answer
    assert_eq!(json(&format!("{ONE} --label 1/1")), answer);
}

#[test]
fn text_and_table() {
    let label = "1/1: one impact every forcing period, stable";
    has(&printed(ONE), &[label, "flip", "none up to 0.1", "by trying", "not proved"]);
    let table = printed(&format!("{ONE} --csv -"));
    let rows = rows(&table);
    assert_eq!(rows[0].join(","), "parameter,value,direction,limit,at,distance,relative,event,before,after");
    assert!(rows.len() == 9 && rows.iter().all(|row| row.len() == 10), "{table}");
    has(&table, &["\ngap,1.5,up,3,1.829006189683"]);
    has(&printed("margins --inverse-beta 1.11 --gap 3 --restitution 0.5"), &["chaotic", "no margins"]);
    let unstable = printed("margins --inverse-beta 1.11 --gap 2 --restitution 0.5 --label 1/1");
    has(&unstable, &["no box: the motion is unstable"]);
}

/// A machine has its margins in Hz and m; they agree with its branch.
#[test]
fn a_machine_in_si_units() {
    let answer = json(&format!("margins {MACHINE}"));
    let branch = json(&format!("branch {MACHINE} --label 1/1 --vary frequency-hz --to 10"));
    let (down, event) = (&of(&answer, "frequency_hz")["down"], &branch["branches"][0]["events"][0]);
    assert_eq!((&answer["units"], &down["event"]["kind"]), (&"si".into(), &event["kind"]));
    assert!((number(&down["at"]) - number(&event["parameter"])).abs() < 1e-9);
    assert!((number(&of(&answer, "gap_m")["value"]) - 0.0015).abs() < 1e-15);
    // a scale in its units
    let scaled = json(&format!("margins {MACHINE} --vary gap-m,damping-ratio --scale gap-m=0.0003"));
    assert!((number(&of(&scaled, "gap_m")["scale"]) - 0.0003).abs() < 1e-15);
    assert_eq!(list(&scaled["parameters"]).len(), 2);
    // each number of the body varies, and its force depends on the motion of the base
    let base = MACHINE.replace("--force-n 30", "--base-acceleration-m-per-s2 30");
    let moved = json(&format!("margins {base} --lines 0"));
    let body = ["mass_kg", "stiffness_n_per_m", "damping_ratio", "frequency_hz", "gap_m"];
    let names = texts(&moved["parameters"], "parameter");
    assert_eq!((&names[..5], &names[5..]), (&body[..], &["base_acceleration_m_per_s2", "restitution"][..]));
    // twice the acceleration has the motion of half the gap
    let (wider, weaker) = (of(&answer, "gap_m"), of(&answer, "force_n"));
    let events = |of: &Value| [of["down"]["event"]["kind"].clone(), of["up"]["event"]["kind"].clone()];
    let [down, up] = events(wider);
    assert_eq!(events(weaker), [up, down]);
}

#[test]
fn what_is_refused() {
    let cases = [
        ("--label 1/1 --v 1", "--label cannot go together with a start"),
        ("--label 5/7", "no admissible orbit 5/7"),
        ("--scale gap=0", "the scale of gap is 0"),
        ("--vary damping --scale gap=1", "--scale gap has no effect"),
    ];
    refuse(cases.map(|(more, sentence)| (format!("{ONE} {more}"), sentence)));
    has(&refused(&format!("margins {MACHINE} --vary gap")), &["gap is nondimensional", "gap-m"]);
}

/// With two stops a motion is described by its impacts on each of them.
#[test]
fn impacts_on_each_of_two_stops() {
    let both = "--beta 0.8 --gap 0.5 --restitution 0.6 --damping 0.02 --second-gap 1.5";
    let settled = json(&format!("settle {both}"));
    let motion = &settled["motion"];
    let sides = texts(&motion["cycle"], "stop");
    let on = |side: &str| sides.iter().filter(|of| **of == side).count();
    assert!(!sides.is_empty(), "{motion}");
    let counts = (&motion["counts"]["upper"], &motion["counts"]["lower"]);
    assert_eq!(counts, (&on("upper").into(), &on("lower").into()));
    let label = motion["label"].as_str().expect("a label");
    let told = format!("{label} ({} upper, {} lower): ", on("upper"), on("lower"));
    has(&printed(&format!("settle {both}")), &[&told]);
    has(&printed(&format!("orbit {both} --label {label}")), &[&told]);
    for command in ["attractors --starts 20", "basin --x 0:0.4:4 --v 0:1:4"] {
        has(&printed(&format!("{command} {both}")), &[" upper, ", " lower)"]);
    }
    has(&printed(&format!("map {} --starts 2", both.replace("--gap 0.5", "--gap 0.5:0.6:2"))), &[" lower)"]);
    // with one stop nothing is added
    let one = json("settle --beta 0.8 --gap 0.5 --restitution 0.6 --damping 0.02");
    assert_eq!(one["motion"]["counts"].as_object().unwrap().len(), 1);
}
