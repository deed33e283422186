//! Common parts of the tests of stores.

#![allow(clippy::unwrap_used, unreachable_pub, dead_code)] // each program of tests uses a part of it

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use vibroimpact_store::{Folder, Part, Store};
use vibroimpact_study::{BasinPlan, Control, MapPlan, Plan, SystemPlan, Task};

/// The system of the plans.
pub const S: SystemPlan = SystemPlan {
    beta: None,
    inverse_beta: Some(1.3),
    gap: 0.75,
    restitution: 0.5,
    damping: 0.0,
    second_stop: None,
    body: None,
};

/// A basin of 20 tiles.
pub fn basin() -> Plan {
    let task = BasinPlan::plane("-4:0.75:45".parse().unwrap(), "-4:4:37".parse().unwrap(), 0.0);
    Plan { tile: Some(10), ..Plan::new(S, Task::from(task)) }
}

/// A basin of 9 tiles with cycles that the survey does not find.
pub fn rare() -> Plan {
    let task = BasinPlan::plane("-0.6:-0.4:24".parse().unwrap(), "-4:4:24".parse().unwrap(), 0.0);
    let weak = SystemPlan { beta: Some(2.8), inverse_beta: None, gap: 0.1, restitution: 0.97, damping: 0.01, ..S };
    Plan { tile: Some(8), ..Plan::new(weak, Task::from(task)) }
}

/// A map of 12 tiles.
pub fn map() -> Plan {
    let task = MapPlan::plane("0.6:1.4:13".parse().unwrap(), "-0.5:2:9".parse().unwrap(), 4, 1);
    let system = SystemPlan { inverse_beta: Some(0.6), gap: -0.5, ..S };
    Plan { tile: Some(4), ..Plan::new(system, Task::from(task)) }
}

/// The store of a plan in a folder.
pub fn open(folder: &Path, plan: &Plan) -> Store {
    Store::create(Arc::new(Folder::new(folder)), plan).unwrap()
}

/// A control with this number of threads.
pub fn control(threads: usize) -> Control<'static> {
    Control { threads, ..Control::default() }
}

/// All files of a folder.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fn walk(from: &Path, root: &Path, into: &mut BTreeMap<String, Vec<u8>>) {
        for entry in fs::read_dir(from).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, root, into);
            } else {
                into.insert(path.strip_prefix(root).unwrap().display().to_string(), fs::read(&path).unwrap());
            }
        }
    }
    let mut found = BTreeMap::new();
    walk(folder, folder, &mut found);
    found
}

/// The store of a plan, computed by one thread without interruption.
pub fn whole(plan: &Plan) -> (tempfile::TempDir, BTreeMap<String, Vec<u8>>) {
    let folder = tempfile::tempdir().unwrap();
    let store = open(folder.path(), plan);
    let ran = store.run(Part::ALL, &control(1)).unwrap();
    assert_eq!((ran.computed, ran.left), (store.study().grid().tiles(), 0));
    let files = files(folder.path());
    (folder, files)
}
