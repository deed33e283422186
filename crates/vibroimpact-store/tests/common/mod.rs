//! Common parts of the tests of stores.

#![allow(clippy::unwrap_used, unreachable_pub, dead_code)] // each program of tests uses a part of it

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::{fs, io};
use vibroimpact_store::{Folder, Item, Part, Shelf, Store, StoreError};
use vibroimpact_study::{BasinPlan, Control, MapPlan, Plan, SystemPlan, Task};

/// The system of the plans.
pub const S: SystemPlan = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);

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

/// The plans of 20 and 12 tiles, with shards of 2 by 2 and 3 by 3 tiles.
pub fn sharded() -> [Plan; 2] {
    [Plan { shard: Some(2), ..basin() }, Plan { shard: Some(3), ..map() }]
}

/// The plans of 20 and 12 tiles, without shards and with them.
pub fn all_plans() -> [Plan; 4] {
    let [of_basin, of_map] = sharded();
    [basin(), map(), of_basin, of_map]
}

/// The store of a plan in a folder.
pub fn open(folder: &Path, plan: &Plan) -> Store {
    Store::create(Arc::new(Folder::new(folder)), plan).unwrap()
}

/// The store in a folder, without its plan.
pub fn again(folder: &Path) -> Store {
    Store::open(Arc::new(Folder::new(folder))).unwrap()
}

/// What is done with an object of a folder.
#[derive(Clone, Copy, Eq, PartialEq)]
pub enum Access {
    Read,
    Put,
    Remove,
}

type Before = Box<dyn Fn(Access, &str) -> io::Result<()> + Send + Sync>;

struct Watched(Folder, Before);

/// A folder that calls `before` with each access and its key just before it; an error of it is that of the access.
pub fn watched(
    folder: &Path,
    before: impl Fn(Access, &str) -> io::Result<()> + Send + Sync + 'static,
) -> Arc<dyn Shelf> {
    Arc::new(Watched(Folder::new(folder), Box::new(before)))
}

impl Shelf for Watched {
    fn get(&self, key: &str) -> io::Result<Option<Vec<u8>>> {
        (self.1)(Access::Read, key).and_then(|()| self.0.get(key))
    }
    fn tail(&self, key: &str, count: usize) -> io::Result<Option<(Vec<u8>, u64)>> {
        (self.1)(Access::Read, key).and_then(|()| self.0.tail(key, count))
    }
    fn range(&self, key: &str, from: u64, count: u64) -> io::Result<Option<Vec<u8>>> {
        (self.1)(Access::Read, key).and_then(|()| self.0.range(key, from, count))
    }
    fn put(&self, key: &str, bytes: &[u8]) -> io::Result<()> {
        (self.1)(Access::Put, key).and_then(|()| self.0.put(key, bytes))
    }
    fn remove(&self, key: &str) -> io::Result<()> {
        (self.1)(Access::Remove, key).and_then(|()| self.0.remove(key))
    }
    fn list(&self, prefix: &str) -> io::Result<Vec<Item>> {
        (self.1)(Access::Read, prefix).and_then(|()| self.0.list(prefix))
    }
    fn sweep(&self) -> io::Result<()> {
        self.0.sweep()
    }
    fn name(&self) -> String {
        self.0.name()
    }
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

/// Runs a store until it is complete, stopped after so many more points each time, and returns how often it was stopped.
pub fn stopped(store: impl Fn() -> Store, points: u64, threads: usize) -> usize {
    for stops in 0..100 {
        let (stop, first) = (AtomicBool::new(false), OnceLock::new());
        let progress = |now: u64| {
            stop.fetch_or(now > first.get_or_init(|| now) + points, Ordering::Relaxed);
        };
        match store().run(Part::ALL, &Control { stop: &stop, progress: &progress, threads }) {
            Ok(_) => return stops,
            Err(StoreError::Stopped(stopped)) => assert!(stopped.done < stopped.total),
            Err(other) => panic!("{other}"),
        }
    }
    panic!("it is not complete after 100 runs")
}
