//! `vibro edge`: the border between two motions, and the saddle on it.

use crate::{S, has, json, number, printed, refuse};

fn names(of: &serde_json::Value) -> Vec<&String> {
    of.as_object().expect("an object").keys().collect()
}

/// The oscillator, the machine that it is, and that machine beside another body have one saddle, and their answers the same keys.
#[test]
fn one_saddle_for_every_system() {
    let own = json(&format!("edge {S} --other x=-2"));
    let saddle = &own["saddle"];
    assert_eq!((&saddle["label"], &saddle["stability"]), (&"2/1".into(), &"unstable".into()), "{saddle}");
    assert_eq!((&own["sides"][0]["label"], &own["sides"][1]["label"]), (&"2/1".into(), &"1/1".into()));
    let of_machine = json("edge --machine fukaya-irie-1971 --other q.mass=-2");
    let largest = |of: &serde_json::Value| number(&of["saddle"]["multipliers"][0][0]);
    assert!((largest(&own) - largest(&of_machine)).abs() < 1e-8);
    assert!((number(&own["part"]) - number(&of_machine["part"])).abs() < 1e-8);
    assert_eq!(names(&own["track"][0]), names(&of_machine["track"][0]));
    // a machine of two coordinates
    let chain = json("edge --machine chain --other q.first=-1.18,qdot.first=-0.18");
    assert_eq!(chain["saddle"]["stability"], "unstable", "{}", chain["saddle"]);
}

#[test]
fn text_table_and_refusals() {
    let text = printed(&format!("edge {S} --other x=-2"));
    has(&text, &["border between 2/1 and 1/1, at 0.1915768", "2/1: two impacts", "unstable; multipliers 2.0479"]);
    let table = printed(&format!("edge {S} --other x=-2 --csv -"));
    assert!(table.starts_with("time,x,v,phase,apart\n0,-0.38315362"), "{table}");
    refuse([
        (format!("edge {S} --other q.mass=2"), "q.mass"),
        (format!("edge {S} --other x"), "NAME=VALUE"),
        ("edge --machine chain --other q.third=1".to_owned(), "q.third"),
    ]);
}
