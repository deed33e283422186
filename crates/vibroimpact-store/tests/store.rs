//! Tests of stores: equal bytes after any interruption, detection and repair of damage, and an error message for every
//! refusal.

#![allow(clippy::unwrap_used)]

mod common;

use common::{Access, S, again, all_plans, basin, control, files, map, open, sharded, stopped, watched, whole};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};
use std::{fs, io};
use vibroimpact_store::{Folder, Part, Store, StoreError, costs_beside};
use vibroimpact_study::{Axis, Control, DiagramPlan, LyapunovPlan, MapPlan, Parameter, Plan, SystemPlan, Task};

#[test]
fn the_same_bytes_for_any_threads_and_parts() {
    for plan in all_plans() {
        let (_kept, want) = whole(&plan);
        for threads in [2, 3, 8] {
            let folder = tempfile::tempdir().unwrap();
            open(folder.path(), &plan).run(Part::ALL, &control(threads)).unwrap();
            assert!(files(folder.path()) == want, "{threads} threads");
        }
        let folder = tempfile::tempdir().unwrap();
        for index in [3, 1, 4, 2] {
            let ran = open(folder.path(), &plan).run(Part::new(index, 4).unwrap(), &control(2)).unwrap();
            assert_eq!(ran.left == 0, index == 2);
        }
        assert!(files(folder.path()) == want, "four parts");
    }
}

#[test]
fn every_kind_of_study_is_stored() {
    let u = SystemPlan { inverse_beta: Some(1.11), gap: 3.0, ..S };
    let gaps = || Axis::parameter(Parameter::Gap, "2:3:3".parse::<vibroimpact_study::Span>().unwrap());
    let exponents = LyapunovPlan { axes: vec![gaps()], impacts: Some(1000), ..LyapunovPlan::default() };
    let over = "0:2:20".parse::<vibroimpact_study::Span>().unwrap();
    let diagram: DiagramPlan = DiagramPlan { transient: 50, keep: 8, ..DiagramPlan::new(Parameter::Gap, over) };
    let refined =
        MapPlan { refine: Some(4), ..MapPlan::plane("0.6:1.4:13".parse().unwrap(), "0:2:9".parse().unwrap(), 2, 1) };
    for (system, task, field) in [
        (S, Task::Attractors { starts: 300, seed: 1, impacts: None }, "cycle"),
        (u, Task::from(exponents), "exponent"),
        (S, Task::from(diagram), "velocity"),
        (S, Task::from(refined), "computed"),
    ] {
        let plan = Plan::new(system, task);
        let (folder, _) = whole(&plan);
        let store = again(folder.path());
        assert_eq!(store.plan(), &plan.canonical().unwrap());
        let found = store.verify(1000, 0, &control(2)).unwrap();
        assert_eq!((found.damage, found.open), (vec![], 0));
        assert!(store.field(field).is_some());
        let sheet =
            vibroimpact_study::study::in_memory(vibroimpact_study::Study::new(&plan).unwrap(), &Control::default())
                .unwrap();
        for (k, column) in sheet.columns.iter().enumerate() {
            assert!(store.column(k).unwrap() == *column, "{}", sheet.fields[k].name);
        }
        assert!(store.progress().unwrap().complete);
    }
}

#[test]
fn stopped_and_resumed_it_is_the_same() {
    let [of_basin, _] = sharded();
    for plan in [basin(), of_basin] {
        let (_kept, want) = whole(&plan);
        let folder = tempfile::tempdir().unwrap();
        let stops = stopped(|| open(folder.path(), &plan), 300, 2);
        assert!(stops > 1, "{stops}");
        assert!(files(folder.path()) == want);
    }
}

/// With refinement most points are not computed, but all count in the progress. When a run is stopped, the points of
/// complete tiles count.
#[test]
fn f10_points_are_counted_with_refinement() {
    let side = |text: &str| text.parse::<vibroimpact_study::Span>().unwrap();
    let task = |refine| MapPlan { refine, ..MapPlan::plane(side("0.6:1.4:64"), side("0:2:64"), 2, 1) };
    for refine in [None, Some(8)] {
        let plan = Plan { tile: Some(16), ..Plan::new(S, Task::from(task(refine))) };
        let (folder, stop, told) = (tempfile::tempdir().unwrap(), AtomicBool::new(false), AtomicU64::new(0));
        let store = open(folder.path(), &plan);
        let progress = |done: u64| {
            told.fetch_max(done, Ordering::Relaxed);
            if done > 1500 {
                stop.store(true, Ordering::Relaxed);
            }
        };
        let watched = Control { stop: &stop, progress: &progress, threads: 1 };
        let Err(StoreError::Stopped(stopped)) = store.run(Part::ALL, &watched) else { panic!("it was stopped") };
        let kept = store.progress().unwrap().points_done;
        assert_eq!((stopped.done, stopped.total), (kept, 4096), "{refine:?}");
        assert!((1024..4096).contains(&kept), "{refine:?} {kept}");
        let all = std::sync::Mutex::new(Vec::new());
        let note = |done| all.lock().unwrap().push(done);
        store.run(Part::ALL, &Control { progress: &note, threads: 1, ..Control::default() }).unwrap();
        let all = all.into_inner().unwrap();
        assert!(all[0] == kept && all.windows(2).all(|pair| pair[0] <= pair[1]), "{refine:?} {all:?}");
        assert!(all[all.len() - 2] > 4096 - 64, "{refine:?} {all:?}");
    }
}

/// A run whose time is spent begins no further tile, gets on by at least one tile, and changes no byte of the result.
#[test]
fn a_budget_ends_at_the_border_of_a_tile() {
    for plan in all_plans() {
        let (_kept, want) = whole(&plan);
        let folder = tempfile::tempdir().unwrap();
        let tiles = open(folder.path(), &plan).study().grid().tiles();
        for done in 1..=tiles {
            let store = open(folder.path(), &plan);
            let ran = store.run_until(Part::ALL, Some(Instant::now()), &control(2)).unwrap();
            assert_eq!((ran.computed, ran.found, ran.left), (1, done - 1, tiles - done));
            assert_eq!(ran.spent, done < tiles);
            assert_eq!(store.progress().unwrap().done, done);
            // what is there can be read, and the rest has no values
            assert!(store.column(0).is_ok() && store.verify(1, 0, &control(1)).unwrap().damage.is_empty());
        }
        assert!(files(folder.path()) == want);
        let ran = open(folder.path(), &plan).run_until(Part::ALL, Some(Instant::now()), &control(2)).unwrap();
        assert_eq!((ran.computed, ran.found, ran.spent), (0, tiles, false));
        // a budget that is long enough changes nothing
        let other = tempfile::tempdir().unwrap();
        let until = Instant::now().checked_add(Duration::from_secs(3600));
        let part = Part::new(2, 3).unwrap();
        let ran = open(other.path(), &plan).run_until(part, until, &control(2)).unwrap();
        assert!(!ran.spent && ran.left == tiles - ran.computed);
    }
}

/// The tiles that are done first are spread over the grid.
#[test]
fn tiles_are_computed_from_coarse_to_fine() {
    let plan = Plan { tile: Some(5), ..basin() };
    let folder = tempfile::tempdir().unwrap();
    let store = open(folder.path(), &plan);
    let grid = store.study().grid().clone();
    for _ in 0..16 {
        store.run_until(Part::ALL, Some(Instant::now()), &control(1)).unwrap();
    }
    let missing = store.progress().unwrap().missing;
    for tile in 0..grid.tiles() {
        // 8 by 9 tiles: the first 4 by 4 are those whose places are even (by 8) or divisible by 4 (by 9, which counts as 16)
        let place = grid.place(tile);
        let wanted = place.iter().all(|at| at.is_multiple_of(4));
        assert!(!wanted || !missing.contains(&tile), "{place:?}");
    }
}

/// The processor time of tiles is recorded beside the store, whose bytes do not change.
#[test]
fn costs_are_beside_the_store() {
    let plan = map();
    let (_kept, want) = whole(&plan);
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("map.zarr").display().to_string();
    let with_costs = || open(Path::new(&place), &plan).with_costs(costs_beside(&place).unwrap());
    with_costs().run(Part::new(1, 2).unwrap(), &control(2)).unwrap();
    assert_eq!(with_costs().costs().unwrap().tiles.len(), 6);
    with_costs().run(Part::ALL, &control(1)).unwrap();
    let costs = with_costs().costs().unwrap();
    assert_eq!(costs.tiles.len(), 12);
    assert!(costs.seconds() > 0.0 && costs.tiles.values().all(|seconds| *seconds >= 0.0));
    let grid = with_costs().study().grid().clone();
    assert_eq!(costs.regions(&grid).iter().map(|region| region.points).sum::<u64>(), grid.points());
    assert!(files(Path::new(&place)) == want);
    // costs of another plan, and objects without costs in them, are skipped
    fs::write(folder.path().join("map.zarr.costs/other.json"), r#"{"tiles":[99],"seconds":[1]}"#).unwrap();
    fs::write(folder.path().join(format!("map.zarr.costs/{}-torn.json", plan.hash())), "{").unwrap();
    assert_eq!(with_costs().costs().unwrap(), costs);
    // without a shelf there are none
    assert_eq!(open(Path::new(&place), &plan).costs().unwrap().tiles.len(), 0);
}

#[test]
fn damage_is_found_and_mended() {
    for plan in [basin(), map()] {
        let (folder, want) = whole(&plan);
        let chunks: Vec<&String> = want.keys().filter(|key| key.contains("/c/")).collect();
        let open_again = || again(folder.path());
        for (k, key) in chunks.iter().enumerate().step_by(7) {
            let (path, bytes) = (folder.path().join(key), &want[*key]);
            match k % 3 {
                0 => fs::write(&path, &bytes[..bytes.len() / 2]).unwrap(),
                1 => {
                    let mut flipped = bytes.clone();
                    flipped[k % bytes.len()] ^= 1 << (k % 8);
                    fs::write(&path, flipped).unwrap();
                }
                _ => fs::remove_file(&path).unwrap(),
            }
            let found = open_again().verify(0, 0, &control(1)).unwrap();
            // a tile without a status counts as a tile that was never computed
            assert!(!found.damage.is_empty() || (found.open == 1 && key.starts_with("status")), "{key}");
            let of_tile = found.damage.iter().any(|damage| damage.tile.is_some());
            assert_eq!(open_again().damaged(&control(1)).unwrap(), u64::from(of_tile), "{key}");
            open_again().run(Part::ALL, &control(2)).unwrap();
            assert!(files(folder.path()) == want, "{key}");
        }
        for key in want.keys().filter(|key| key.ends_with("zarr.json")) {
            fs::write(folder.path().join(key), "{").unwrap();
            open(folder.path(), &plan).run(Part::ALL, &control(1)).unwrap();
            assert!(files(folder.path()) == want, "{key}");
        }
    }
}

/// Found by `cargo xtask fuzz`: a damaged tile was read as one that was never computed, and a table was written with
/// it.
#[test]
fn fz2_a_damaged_tile_is_never_read_as_an_open_one() {
    let (folder, want) = whole(&basin());
    let open_again = || again(folder.path());
    let path = folder.path().join("cycle/c/0/0");
    assert!(open_again().whole(&control(2)).is_ok());
    for damaged in
        [want["cycle/c/0/0"][..9].to_vec(), [want["cycle/c/0/0"].as_slice(), &[1, 2, 3]].concat(), Vec::new()]
    {
        fs::write(&path, damaged).unwrap();
        let store = open_again();
        let field = store.field("cycle").unwrap();
        for refused in [store.column(field).map(drop), store.tile(0).map(drop), store.whole(&control(2))] {
            let sentence = refused.unwrap_err().to_string();
            assert!(
                sentence.contains("`cycle/c/0/0` of tile 0") && sentence.contains("resuming the study"),
                "{sentence}"
            );
        }
        assert!(store.tile(1).is_ok());
    }
    // an incomplete tile has nothing to be read
    fs::remove_file(folder.path().join("status/c/0/0")).unwrap();
    assert!(open_again().whole(&control(2)).is_ok());
}

/// A tile with valid checksums that is not the result of the plan: only a second computation detects it.
#[test]
fn a_wrong_tile_is_found_by_computing_it_again() {
    let plan = basin();
    let (folder, want) = whole(&plan);
    let (_, other) =
        want.iter().find(|(key, bytes)| key.starts_with("label/c/") && **bytes != want["label/c/0/0"]).unwrap();
    fs::write(folder.path().join("label/c/0/0"), other).unwrap();
    let store = again(folder.path());
    assert!(store.verify(0, 0, &control(1)).unwrap().damage.is_empty());
    let found = store.verify(u64::MAX, 0, &control(2)).unwrap();
    assert_eq!(found.recomputed, store.study().grid().tiles());
    assert_eq!(found.damage.len(), 1);
    assert_eq!(found.damage[0].tile, Some(0));
    assert!(found.damage[0].what.contains("label/c/0/0"), "{:?}", found.damage);
}

/// Found by `cargo xtask fuzz`: a chunk at the edge of the grid contained other numbers beyond the edge, where nobody
/// reads them.
#[test]
fn fz3_a_chunk_that_differs_beyond_the_edge_of_the_grid_is_damaged() {
    let task = MapPlan::plane("0.6:1.4:9".parse().unwrap(), "-0.5:2:5".parse().unwrap(), 2, 1);
    let system = SystemPlan { inverse_beta: Some(0.6), gap: -0.5, ..S };
    let (folder, want) = whole(&Plan { tile: Some(4), ..Plan::new(system, Task::from(task)) });
    assert_ne!(want["label/c/0/2/0"], want["label/c/1/2/0"]);
    fs::copy(folder.path().join("label/c/0/2/0"), folder.path().join("label/c/1/2/0")).unwrap();
    let store = again(folder.path());
    let found = store.verify(u64::MAX, 0, &control(2)).unwrap();
    assert!(found.damage.len() == 1 && found.damage[0].what.contains("label/c/1/2/0"), "{:?}", found.damage);
}

#[test]
fn two_at_once_do_no_harm() {
    for plan in all_plans() {
        let (_kept, want) = whole(&plan);
        for _ in 0..5 {
            let folder = tempfile::tempdir().unwrap();
            std::thread::scope(|scope| {
                for _ in 0..3 {
                    scope.spawn(|| open(folder.path(), &plan).run(Part::ALL, &control(2)).unwrap());
                }
            });
            assert!(files(folder.path()) == want);
        }
    }
}

#[test]
fn a_complete_store_is_not_written_to() {
    for plan in [basin(), map()] {
        let (folder, want) = whole(&plan);
        let here = || {
            watched(folder.path(), |access, _| match access {
                Access::Read => Ok(()),
                Access::Put | Access::Remove => Err(io::ErrorKind::ReadOnlyFilesystem.into()),
            })
        };
        let tiles = Store::open(here()).unwrap().study().grid().tiles();
        for store in [Store::create(here(), &plan).unwrap(), Store::open(here()).unwrap()] {
            let ran = store.run(Part::ALL, &control(2)).unwrap();
            assert_eq!((ran.computed, ran.found, ran.left), (0, tiles, 0));
            assert!(store.conclude_if_done().unwrap());
        }
        // the objects written by the conclusion are written again if missing or damaged
        for key in want.keys().filter(|key| key.starts_with("cycle_") || *key == "label/zarr.json") {
            for damage in [Some("{}"), Some("{"), None] {
                let path = folder.path().join(key);
                match damage {
                    Some(text) => fs::write(&path, text).unwrap(),
                    None => fs::remove_file(&path).unwrap(),
                }
                let refused = match Store::create(here(), &plan) {
                    Ok(store) => store.run(Part::ALL, &control(1)).map(|ran| ran.left),
                    Err(refused) => Err(refused),
                };
                assert!(refused.is_err(), "{key} {damage:?}: {refused:?}");
                open(folder.path(), &plan).run(Part::ALL, &control(1)).unwrap();
                assert!(files(folder.path()) == want, "{key} {damage:?}");
            }
        }
    }
}

#[test]
fn a_store_that_is_begun_meanwhile_is_joined() {
    for (theirs, joined) in [(map(), true), (basin(), false)] {
        let folder = tempfile::tempdir().unwrap();
        let (place, begun) = (folder.path().to_owned(), AtomicBool::new(false));
        // another process creates a store after none was found, just before all objects are listed
        let contested = watched(folder.path(), move |_, key| {
            if key.is_empty() && !begun.swap(true, Ordering::Relaxed) {
                open(&place, &theirs);
            }
            Ok(())
        });
        match Store::create(contested, &map()) {
            Ok(store) => assert!(joined && store.progress().unwrap().done == 0),
            Err(error) => assert!(!joined && error.to_string().contains("holds another plan"), "{error}"),
        }
    }
}

#[test]
fn refusals() {
    let (folder, want) = whole(&map());
    let refused = |plan: &Plan, place: &Path| match Store::create(Arc::new(Folder::new(place)), plan) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("not refused"),
    };
    // a store of another plan
    assert!(refused(&basin(), folder.path()).contains("holds another plan"));
    // a plan without a grid
    let settle = Plan::new(S, Task::Settle { start: None, impacts: None });
    assert!(refused(&settle, folder.path()).contains("fills no grid"));
    assert!(files(folder.path()) == want);
    // a folder with other files
    let other = tempfile::tempdir().unwrap();
    fs::write(other.path().join("thesis.tex"), "years of work").unwrap();
    assert!(refused(&map(), other.path()).contains("is not empty, and no store"));
    fs::write(other.path().join("zarr.json"), r#"{"zarr_format":3,"node_type":"group"}"#).unwrap();
    assert!(refused(&map(), other.path()).contains("is not empty, and no store"));
    let file = other.path().join("thesis.tex");
    assert!(refused(&map(), &file).contains("no store"), "{}", refused(&map(), &file));
    // a folder that does not exist
    let none = Store::open(Arc::new(Folder::new(&other.path().join("none")))).err().unwrap().to_string();
    assert!(none.starts_with("there is no store at"), "{none}");
    // a later format, and another version
    let root = folder.path().join("zarr.json");
    let text = fs::read_to_string(&root).unwrap();
    fs::write(&root, text.replace("\"vibroimpact_format\": 1", "\"vibroimpact_format\": 3")).unwrap();
    let newer = Store::open(Arc::new(Folder::new(folder.path()))).err().unwrap().to_string();
    assert!(newer.contains("has format 3; this program knows format 2"), "{newer}");
    let version = format!("\"vibroimpact_version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    fs::write(&root, text.replace(&version, "\"vibroimpact_version\": \"0.0.9\"")).unwrap();
    let store = again(folder.path());
    // a complete store of another version may be read and concluded, but not extended
    store.run(Part::ALL, &control(1)).unwrap();
    fs::remove_file(folder.path().join("status/c/0/0")).unwrap();
    let mixed = store.run(Part::ALL, &control(1)).err().unwrap().to_string();
    assert!(mixed.contains("was begun by vibroimpact 0.0.9"), "{mixed}");
    assert!(matches!(Part::new(0, 3), Err(StoreError::Part { .. })) && Part::new(4, 3).is_err());
}

/// Damages an object in one of several ways: truncated, one byte changed, other JSON, or removed.
fn damaged(bytes: &[u8], how: usize) -> Option<Vec<u8>> {
    match how {
        0 => Some(bytes[..bytes.len() / 2].to_vec()),
        1 => Some(Vec::new()),
        2 => {
            let mut changed = bytes.to_vec();
            // a digit or letter in the middle is changed, so JSON remains valid JSON
            let at = (0..bytes.len()).map(|k| (bytes.len() / 2 + k) % bytes.len());
            let at = at.into_iter().find(|k| bytes[*k].is_ascii_alphanumeric()).unwrap_or(0);
            changed[at] = if changed[at] == b'7' { b'8' } else { b'7' };
            Some(changed)
        }
        3 => Some(b"{}\n".to_vec()),
        _ => None,
    }
}

/// Damages every object except the chunks of fields and status in every way. The verification must never report the
/// store as whole.
#[test]
fn f09_damage_of_what_describes_a_store_is_found() {
    for plan in [basin(), map()] {
        let (folder, want) = whole(&plan);
        let here = || Store::open(Arc::new(Folder::new(folder.path())));
        let is_whole = |found: vibroimpact_store::Verified| found.damage.is_empty() && found.open == 0;
        assert!(is_whole(here().unwrap().verify(0, 0, &control(1)).unwrap()));
        let described = |key: &&String| key.ends_with("zarr.json") || key.starts_with("cycle_") || key.ends_with("c/0");
        let keys: Vec<&String> = want.keys().filter(described).collect();
        assert!(keys.len() >= 10 && keys.iter().any(|key| *key == "label/zarr.json"), "{keys:?}");
        for key in keys {
            for how in 0..5 {
                let path = folder.path().join(key);
                match damaged(&want[key], how) {
                    Some(bytes) => fs::write(&path, bytes).unwrap(),
                    None => fs::remove_file(&path).unwrap(),
                }
                match here().map(|store| store.verify(0, 0, &control(1))) {
                    Ok(Ok(found)) => {
                        assert!(!is_whole(found.clone()), "{key} {how}");
                        // a fault of the whole store is not reported for a tile
                        let named = found.damage.iter().filter(|damage| damage.tile.is_none());
                        assert!(named.count() > 0, "{key} {how}: {:?}", found.damage);
                    }
                    // a store with an unreadable root cannot be verified
                    Ok(Err(refused)) | Err(refused) => assert!(key == "zarr.json", "{key} {how}: {refused}"),
                }
                if key == "zarr.json" {
                    // a store without a root cannot be repaired
                    fs::write(&path, &want[key]).unwrap();
                }
                open(folder.path(), &plan).run(Part::ALL, &control(1)).unwrap();
                assert!(files(folder.path()) == want, "{key} {how}");
            }
        }
    }
}

/// Changes texts, and the copies of metadata in the root, such that the JSON remains valid.
#[test]
fn f09_edits_of_metadata_are_found() {
    let plan = basin();
    let (folder, want) = whole(&plan);
    let verified = || {
        let store = Store::open(Arc::new(Folder::new(folder.path())))?;
        store.verify(0, 0, &control(1)).map(|found| found.damage)
    };
    let text = |key: &str| String::from_utf8(want[key].clone()).unwrap();
    for (key, from, to) in [
        ("label/zarr.json", "\"2/1", "\"1/1"),
        ("label/zarr.json", "not_computed", "computed"),
        ("x/zarr.json", "F/k", "m"),
        ("zarr.json", "\"complete\": 1", "\"complete\": 0"),
        ("zarr.json", "position of the start", "velocity of the start"),
        ("zarr.json", "\"int32\"", "\"int16\""),
        ("zarr.json", "\"source\": \"vibroimpact", "\"source\": \"other"),
    ] {
        let before = text(key);
        let edited = before.replacen(from, to, 1);
        if edited == before {
            // the texts of labels are in one attribute
            assert!(key == "label/zarr.json", "{key} {from}");
            continue;
        }
        fs::write(folder.path().join(key), edited).unwrap();
        let damage = verified().unwrap();
        assert!(damage.iter().any(|damage| damage.what.contains(key)), "{key} {from}: {damage:?}");
        fs::write(folder.path().join(key), before).unwrap();
    }
    assert_eq!(verified().unwrap(), vec![]);
    // a plan that was changed does not match its hash
    let root = text("zarr.json");
    let edited = root.replacen("\\\"gap\\\":0.75", "\\\"gap\\\":0.85", 1);
    assert!(edited != root);
    fs::write(folder.path().join("zarr.json"), edited).unwrap();
    let refused = verified().unwrap_err().to_string();
    assert!(refused.contains("`zarr.json`") && refused.contains("one of them was changed"), "{refused}");
}

/// Stores that are incomplete or of another version: everything that can be compared is compared.
#[test]
fn f09_metadata_of_unfinished_and_older_stores() {
    let plan = map();
    let folder = tempfile::tempdir().unwrap();
    open(folder.path(), &plan).run(Part::new(1, 2).unwrap(), &control(1)).unwrap();
    let verified = |folder: &Path| {
        let store = again(folder);
        store.verify(0, 0, &control(1)).unwrap()
    };
    let begun = files(folder.path());
    assert!(verified(folder.path()).damage.is_empty() && verified(folder.path()).open > 0);
    for key in begun.keys().filter(|key| key.ends_with("/zarr.json")) {
        fs::write(folder.path().join(key), "{}").unwrap();
        assert!(!verified(folder.path()).damage.is_empty(), "{key}");
        fs::write(folder.path().join(key), &begun[key]).unwrap();
    }
    // all tiles are complete, but the run was killed before the conclusion
    let (done, want) = whole(&plan);
    fs::write(done.path().join("zarr.json"), &begun["zarr.json"]).unwrap();
    let found = verified(done.path());
    assert!(
        found.damage.iter().any(|damage| damage.what.contains("does not say that the store is complete")),
        "{found:?}"
    );
    open(done.path(), &plan).run(Part::ALL, &control(1)).unwrap();
    assert!(files(done.path()) == want);

    // another version may have other texts, but not other shapes; its tables have checksums
    let (older, _) = whole(&basin());
    let version = format!("\"vibroimpact_version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    for (key, bytes) in files(older.path()).iter().filter(|(key, _)| key.ends_with("zarr.json")) {
        let text = String::from_utf8(bytes.clone()).unwrap();
        let text = text.replace("position of the start", "where it starts");
        fs::write(older.path().join(key), text.replace(&version, "\"vibroimpact_version\": \"0.0.9\"")).unwrap();
    }
    assert_eq!(verified(older.path()).damage, vec![]);
    let objects = files(older.path());
    for key in objects.keys().filter(|key| key.ends_with("/zarr.json") || key.starts_with("cycle_")) {
        for how in [0, 3, 4] {
            match damaged(&objects[key], how) {
                Some(bytes) => fs::write(older.path().join(key), bytes).unwrap(),
                None => fs::remove_file(older.path().join(key)).unwrap(),
            }
            assert!(!verified(older.path()).damage.is_empty(), "{key} {how}");
            fs::write(older.path().join(key), &objects[key]).unwrap();
        }
    }
}

/// A store keeps the tiles and the fields with which it was begun, though the defaults of a later version are others.
#[test]
fn a_store_of_other_defaults_is_resumed_and_verified() {
    let plan = MapPlan::plane("0.6:1.4:13".parse().unwrap(), "0:2:9".parse().unwrap(), 2, 1);
    let plan = Plan::new(S, Task::from(plan));
    let smaller = Plan { tile: Some(3), ..plan.clone() };
    let hashes = [&plan, &smaller].map(|plan| plan.canonical().unwrap().hash());
    let folder = tempfile::tempdir().unwrap();
    open(folder.path(), &smaller).run(Part::new(1, 2).unwrap(), &control(1)).unwrap();
    // the same root with the plan that leaves the length of the tiles to the default, and without one field
    let root = folder.path().join("zarr.json");
    let mut value: serde_json::Value = serde_json::from_slice(&fs::read(&root).unwrap()).unwrap();
    assert_ne!(hashes[0], hashes[1]);
    value["attributes"]["plan"] = serde_json::to_string(&plan.canonical().unwrap()).unwrap().into();
    value["attributes"]["plan_hash"] = hashes[0].clone().into();
    value["consolidated_metadata"]["metadata"].as_object_mut().unwrap().shift_remove("speed").unwrap();
    fs::write(&root, format!("{value:#}\n")).unwrap();
    fs::remove_dir_all(folder.path().join("speed")).unwrap();

    let store = again(folder.path());
    assert_eq!(store.study().grid().dimensions.iter().map(|of| of.tile).collect::<Vec<_>>(), [3, 3]);
    assert!(store.field("speed").is_none() && store.field("share").is_some());
    let found = store.verify(1000, 0, &control(1)).unwrap();
    assert!(found.damage.is_empty() && found.open > 0 && found.recomputed > 0, "{found:?}");
    // the command of the plan goes on with it, too
    assert_eq!(open(folder.path(), &plan).run(Part::ALL, &control(2)).unwrap().left, 0);
    let store = again(folder.path());
    let found = store.verify(1000, 0, &control(1)).unwrap();
    assert!(found.damage.is_empty() && found.open == 0, "{found:?}");
    assert!(!folder.path().join("speed").exists());
    let (whole, _) = whole(&plan);
    let now = again(whole.path());
    let share = |store: &Store| store.column(store.field("share").unwrap()).unwrap();
    assert!(share(&store) == share(&now));
}

/// A number that another version rounded differently is told from a wrong one.
#[test]
fn a_difference_has_its_size() {
    let (folder, _) = whole(&map());
    let store = again(folder.path());
    let (_, mut columns) = store.tile(0).unwrap();
    let share = store.field("share").unwrap();
    if let vibroimpact_study::Column::F64(values) = &mut columns[share] {
        values[0] *= 1.0 + 1e-12;
    }
    store.write_tile(0, &columns).unwrap();
    let found = store.verify(1000, 0, &control(1)).unwrap();
    let [damage] = found.damage.as_slice() else { panic!("{found:?}") };
    assert!(
        damage.what.contains("1 of ") && damage.what.contains("differ, by 1.0e-12 of their size"),
        "{}",
        damage.what
    );
}
