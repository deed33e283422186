//! Tests of stores with shards: the same numbers as without, equal bytes after a death at any write, detection and repair of
//! damage.

#![allow(clippy::unwrap_used)]

mod common;

use common::{Access, S, again, basin, control, files, map, open, rare, sharded, watched, whole};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use std::{fs, io};
use vibroimpact_store::{Folder, Part, Shelf, Store, StoreError};
use vibroimpact_study::{BasinPlan, Plan, Task};

#[test]
fn shards_have_the_same_numbers_in_fewer_files() {
    for (plan, plain, shards) in sharded().into_iter().zip([basin(), map()]).zip([6, 2]).map(|((a, b), c)| (a, b, c)) {
        let (folder, files) = whole(&plan);
        let (other, more) = whole(&plain);
        let (store, without) = (again(folder.path()), again(other.path()));
        for field in 0..store.study().fields().len() {
            assert!(store.column(field).unwrap() == without.column(field).unwrap());
        }
        for tile in 0..store.study().grid().tiles() {
            assert!(store.tile(tile).unwrap() == without.tile(tile).unwrap());
        }
        let chunks = |files: &std::collections::BTreeMap<String, Vec<u8>>| {
            files.keys().filter(|key| key.starts_with("label/c/")).count() as u64
        };
        assert_eq!((chunks(&files), chunks(&more)), (shards, store.study().grid().tiles()));
        assert!(!folder.path().join(".tiles").exists());
        let label = String::from_utf8(files["label/zarr.json"].clone()).unwrap();
        assert!(label.contains("sharding_indexed") && label.contains("index_location"), "{label}");
        let tables = files.keys().filter(|key| key.starts_with("cycle_")).count();
        assert_eq!(store.files(), (files.len() - tables) as u64);
        let found = store.verify(1000, 0, &control(2)).unwrap();
        assert_eq!((found.damage, found.open, found.recomputed), (vec![], 0, store.study().grid().tiles()));
        assert!(store.progress().unwrap().complete && store.shard().is_some() && without.shard().is_none());
    }
}

/// A folder that fails from a given change on, as for a process that is killed then.
fn dying(folder: &Path, changes: u64) -> Arc<dyn Shelf> {
    let left = AtomicU64::new(changes);
    let count = move || left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_err();
    watched(
        folder,
        move |access, _| {
            if access != Access::Read && count() { Err(io::Error::other("killed")) } else { Ok(()) }
        },
    )
}

/// Tiles that wait move to their shards, and the last process writes the final numbers. A process that works at the
/// same time, in any order of both, finds every tile: the other process acts before every third access, or with
/// `VIBROIMPACT_LONG=1` before each.
#[test]
fn tiles_that_move_while_they_are_read_are_found() {
    let basin = BasinPlan::plane("-4:0.75:6".parse().unwrap(), "-4:4:4".parse().unwrap(), 0.0);
    let plan = Plan { shard: Some(2), tile: Some(2), ..Plan::new(S, Task::from(basin)) };
    let (kept, want) = whole(&plan);
    let complete = again(kept.path());
    let study = complete.study();
    let tiles: Vec<_> = (0..study.grid().tiles()).map(|tile| study.tile(tile, &|| false).unwrap()).collect();
    let step = if std::env::var("VIBROIMPACT_LONG").is_ok_and(|value| value == "1") { 1 } else { 3 };
    type Act = fn(&Store) -> Result<u64, StoreError>;
    let acts: [(&str, Act); 5] = [
        ("conclude", |store| store.conclude_if_done().map(u64::from)),
        ("run", |store| store.run(Part::ALL, &control(1)).map(|ran| ran.computed)),
        ("read", |store| store.column(0).map(|_| 0)),
        ("find", |store| store.to_do(&control(1)).map(|(open, damaged)| open.len() as u64 + damaged)),
        // the whole store changes while it is verified, but no tile is damaged or open
        ("verify", |store| {
            let found = store.verify(0, 0, &control(1))?;
            Ok(found.open + found.damage.iter().filter(|damage| damage.tile.is_some()).count() as u64)
        }),
    ];
    for (name, act) in acts {
        for before in (0..).step_by(step) {
            let folder = tempfile::tempdir().unwrap();
            let place = folder.path().to_owned();
            // all tiles wait
            let store = open(&place, &plan);
            (0..).zip(&tiles).for_each(|(tile, columns)| store.write_tile(tile, columns).unwrap());
            let left = Arc::new(AtomicU64::new(u64::MAX));
            let (count, there) = (Arc::clone(&left), place.clone());
            // another process acts just before this one reads or changes something
            let meanwhile = watched(&place, move |_, _| {
                let now = count.fetch_sub(1, Ordering::Relaxed) == 0;
                assert!(!now || again(&there).conclude_if_done().unwrap());
                Ok(())
            });
            let store = Store::open(meanwhile).unwrap();
            left.store(before, Ordering::Relaxed);
            let found = act(&store).unwrap_or_else(|error| panic!("{name}, after {before} accesses: {error}"));
            let moved = left.load(Ordering::Relaxed) > before;
            assert_eq!(found, u64::from(name == "conclude"), "{name}, after {before} accesses");
            if name == "read" {
                assert!(store.column(0).unwrap() == complete.column(0).unwrap());
            }
            if !moved {
                assert!(before >= 10, "{name}: {before}");
                break;
            }
            assert!(files(&place) == want, "{name}, after {before} accesses");
        }
    }
}

/// All tiles in one run, which holds those of a shard until it can write the shard; or each tile in a run of its own, after
/// which it waits for its shard.
fn all_tiles(store: &Store, alone: bool) -> Result<(), StoreError> {
    if !alone {
        return store.run(Part::ALL, &control(1)).map(drop);
    }
    for tile in 0..store.study().grid().tiles() {
        store.run_tiles(&[tile], &control(1))?;
    }
    store.conclude_if_done().map(drop)
}

/// A run that dies at any of its changes is completed to the same bytes, and what it left is not damaged.
#[test]
fn killed_at_every_change() {
    // few points, because every change writes all of them again
    let few = BasinPlan::plane("-4:0.75:23".parse().unwrap(), "-4:4:19".parse().unwrap(), 0.0);
    let few = Plan { tile: Some(10), ..Plan::new(S, Task::from(few)) };
    let sharded = [Plan { shard: Some(2), ..few }, Plan { shard: Some(2), ..rare() }];
    let plain = Plan { tile: Some(12), ..rare() };
    for (plan, alone, least) in [(&sharded[0], false, 25), (&sharded[1], true, 50), (&plain, false, 30)] {
        let (_kept, want) = whole(plan);
        let mut changes = 0;
        loop {
            let folder = tempfile::tempdir().unwrap();
            let died = Store::create(dying(folder.path(), changes), plan).and_then(|store| all_tiles(&store, alone));
            if let Ok(store) = Store::open(Arc::new(Folder::new(folder.path()))) {
                let found = store.verify(0, 0, &control(1)).unwrap();
                let of_tile: Vec<_> = found.damage.iter().filter(|damage| damage.tile.is_some()).collect();
                assert!(of_tile.is_empty(), "{changes}: {of_tile:?}");
            }
            open(folder.path(), plan).run(Part::ALL, &control(1)).unwrap();
            assert!(files(folder.path()) == want, "{changes}");
            match died {
                Ok(()) => break,
                Err(StoreError::Write { .. } | StoreError::Begin { .. }) => changes += 1,
                Err(other) => panic!("{other}"),
            }
        }
        assert!(changes > least, "{changes}");
    }
}

/// Tiles that take little time are not written until their shard is, unless the run ends before.
#[test]
fn quick_tiles_are_written_with_their_shard() {
    for plan in sharded() {
        let (_kept, want) = whole(&plan);
        for threads in [1, 3] {
            let folder = tempfile::tempdir().unwrap();
            let written = Arc::new(AtomicU64::new(0));
            let count = Arc::clone(&written);
            // counts the tiles that are written to wait for their shard
            let counting = watched(folder.path(), move |access, key| {
                count.fetch_add(u64::from(access == Access::Put && key.starts_with(".tiles/")), Ordering::Relaxed);
                Ok(())
            });
            let store = Store::create(counting, &plan).unwrap();
            store.run_until(Part::ALL, Some(Instant::now()), &control(1)).unwrap();
            assert_eq!((written.load(Ordering::Relaxed), store.progress().unwrap().done), (1, 1));
            store.run(Part::ALL, &control(threads)).unwrap();
            // the others of the shard of that tile
            let waited = written.load(Ordering::Relaxed);
            assert!(waited <= store.shard().unwrap().iter().product::<usize>() as u64, "{waited}");
            assert!(files(folder.path()) == want);
        }
    }
}

/// Cycles that the survey has not found are in the tables, also after a further run of the complete store.
#[test]
fn further_runs_keep_the_cycles_that_the_survey_missed() {
    for plan in [rare(), Plan { shard: Some(2), ..rare() }] {
        let (folder, want) = whole(&plan);
        let store = again(folder.path());
        assert_eq!(store.verify(9, 0, &control(2)).unwrap().damage, vec![]);
        store.run(Part::ALL, &control(2)).unwrap();
        assert!(files(folder.path()) == want);
        let first = "cycle/c/0/0";
        fs::remove_file(folder.path().join(first)).unwrap();
        store.run(Part::ALL, &control(2)).unwrap();
        assert!(files(folder.path()) == want);
    }
}

#[test]
fn damage_of_shards_is_found_and_mended() {
    for plan in sharded() {
        let (folder, want) = whole(&plan);
        let chunks: Vec<&String> = want.keys().filter(|key| key.contains("/c/")).collect();
        let shards = |key: &str| {
            !key.starts_with("cycle_") && !["x/", "v/", "gap/", "inverse_beta/"].iter().any(|of| key.starts_with(of))
        };
        for (k, key) in chunks.iter().copied().filter(|key| shards(key)).enumerate() {
            let (path, bytes) = (folder.path().join(key), &want[key]);
            // in the chunks, in the index, cut short, with more behind, and away
            let mut flipped = bytes.clone();
            let at = if k % 5 == 0 { bytes.len() / 3 } else { bytes.len() - 9 };
            flipped[at] ^= 1 << (k % 8);
            match k % 5 {
                0 | 1 => fs::write(&path, flipped).unwrap(),
                2 => fs::write(&path, &bytes[..bytes.len() / 2]).unwrap(),
                3 => fs::write(&path, [&bytes[..bytes.len() / 2], bytes].concat()).unwrap(),
                _ => fs::remove_file(&path).unwrap(),
            }
            let found = again(folder.path()).verify(0, 0, &control(1)).unwrap();
            assert!(!found.damage.is_empty(), "{key} {k}");
            again(folder.path()).run(Part::ALL, &control(2)).unwrap();
            assert!(files(folder.path()) == want, "{key} {k}");
        }
        // a tile with right checksums and wrong numbers
        let label: Vec<&String> = chunks.iter().copied().filter(|key| key.starts_with("label/c/")).collect();
        fs::write(folder.path().join(label[0]), &want[label[1]]).unwrap();
        let found = again(folder.path()).verify(u64::MAX, 0, &control(2)).unwrap();
        assert!(!found.damage.is_empty());
    }
}

/// Stores of many tiles have shards; those that were begun without have none.
#[test]
fn many_tiles_are_in_shards_by_default() {
    let plan = Plan { tile: Some(1), ..basin() };
    let folder = tempfile::tempdir().unwrap();
    assert!(open(folder.path(), &plan).shard().is_none());
    let many = Plan {
        task: serde_json::from_str(
            r#"{"basin":{"axes":[{"vary":"x","over":"-4:0.75:65"},{"vary":"v","over":"-4:4:64"}]}}"#,
        )
        .unwrap(),
        ..plan
    };
    let folder = tempfile::tempdir().unwrap();
    let store = open(folder.path(), &many);
    assert_eq!((store.shard(), store.study().grid().tiles()), (Some([4, 4].as_slice()), 4160));
    let root = folder.path().join("zarr.json");
    let text = fs::read_to_string(&root).unwrap();
    assert!(text.contains("\"vibroimpact_format\": 2"), "{text}");
    fs::write(&root, text.replace("\"vibroimpact_format\": 2", "\"vibroimpact_format\": 1")).unwrap();
    assert!(again(folder.path()).shard().is_none());
    assert!(open(folder.path(), &many).shard().is_none());
}
