//! Tests of sweeps that carry their state: a run that was stopped goes on from the last state, to the same bytes.

#![allow(clippy::unwrap_used)]

mod common;

use common::{S, control, files, open, stopped, whole};
use std::fs;
use std::time::Instant;
use vibroimpact_store::Part;
use vibroimpact_study::machine::CATALOGUE;
use vibroimpact_study::{Plan, Task};

/// Orbit diagrams of two sweeps with 15 values, of a range or listed.
fn plans() -> [Plan; 3] {
    let listed = "[2,1.9,1.75,1.5,1.49,1.2,1.1,1,0.9,0.7,0.65,0.6,0.5,0.3,0.2]";
    [("velocity", "\"0.2:2:15\""), ("strobe", "\"0.2:2:15\""), ("velocity", listed)].map(|(show, over)| {
        let task = format!(
            r#"{{"diagram":{{"vary":"gap","over":{over},"show":"{show}","direction":"both","transient":40,"keep":16}}}}"#
        );
        Plan::new(S, serde_json::from_str::<Task>(&task).unwrap())
    })
}

#[test]
fn a_budget_ends_between_two_values() {
    for plan in plans() {
        let (_kept, want) = whole(&plan);
        let folder = tempfile::tempdir().unwrap();
        let mut runs = 0;
        loop {
            let ran = open(folder.path(), &plan).run_until(Part::ALL, Some(Instant::now()), &control(1)).unwrap();
            runs += 1;
            let begun = fs::read_dir(folder.path().join(".begun")).map_or(0, Iterator::count);
            assert_eq!((ran.spent, begun), if runs % 15 == 0 { (runs < 30, 0) } else { (true, 1) }, "{runs}");
            let found = open(folder.path(), &plan).verify(10, 0, &control(1)).unwrap();
            assert_eq!(found.damage, []);
            if !ran.spent {
                break;
            }
        }
        // one value each
        assert_eq!(runs, 30);
        assert!(files(folder.path()) == want);
    }
}

#[test]
fn stopped_runs_lose_no_value() {
    for plan in plans() {
        let (_kept, want) = whole(&plan);
        let folder = tempfile::tempdir().unwrap();
        let stops = stopped(|| open(folder.path(), &plan), 4, 1);
        assert!((2..60).contains(&stops), "{stops}");
        assert!(files(folder.path()) == want);
    }
}

#[test]
fn damaged_parts_are_computed_again() {
    let [plan, ..] = plans();
    let (_kept, want) = whole(&plan);
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join(".begun/0");
    for k in 0..5 {
        open(folder.path(), &plan).run_until(Part::ALL, Some(Instant::now()), &control(1)).unwrap();
        let bytes = fs::read(&part).unwrap();
        let mut bad = bytes.clone();
        let at = [9, 30, bytes.len() / 2, bytes.len() - 3, 70][k];
        bad[at] ^= 64;
        fs::write(&part, if k == 4 { &bytes[..at] } else { &bad }).unwrap();
    }
    open(folder.path(), &plan).run(Part::ALL, &control(2)).unwrap();
    assert!(files(folder.path()) == want);
    // a part that was left behind is removed when the store is complete
    fs::create_dir(folder.path().join(".begun")).unwrap();
    fs::write(&part, "left behind").unwrap();
    open(folder.path(), &plan).run(Part::ALL, &control(1)).unwrap();
    assert!(files(folder.path()) == want);
}

#[test]
fn sweeps_of_machines_too() {
    let machine = CATALOGUE.iter().find(|entry| entry.name == "soft-stop").unwrap().source().unwrap();
    let task = r#"{"diagram":{"vary":"frequency","over":"0.7:0.9:6","transient":20,"keep":8}}"#;
    let machine = machine.into();
    let task = Task::from_json(task, &machine).unwrap();
    let plan = Plan::new(machine, task);
    let (one, two) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    open(one.path(), &plan).run(Part::ALL, &control(1)).unwrap();
    let mut runs = 1;
    while open(two.path(), &plan).run_until(Part::ALL, Some(Instant::now()), &control(1)).unwrap().spent {
        runs += 1;
    }
    assert!(runs == 12 && files(one.path()) == files(two.path()), "{runs}");
}
