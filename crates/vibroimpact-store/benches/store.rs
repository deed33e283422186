//! The cost of a store compared with the computation: a tile of a map is computed, written and read.
//!
//! Run it with `cargo bench -p vibroimpact-store`. The share of the store is the second time over the first.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;
use vibroimpact_store::{Folder, Part, Store};
use vibroimpact_study::{BasinPlan, Control, MapPlan, Plan, Study, SystemPlan, Task};

/// A map like that of the 1971 paper, with few starts: the case in which the share of the store is largest.
fn map(points: u32) -> Plan {
    let over = |from: f64, to: f64| vibroimpact_study::Span::new(from, to, points).unwrap();
    let task = MapPlan::plane(over(0.4, 2.0), over(0.0, 5.0), 2, 1);
    let system = SystemPlan { inverse_beta: Some(0.4), restitution: 0.5, ..SystemPlan::default() };
    Plan { tile: Some(points), ..Plan::new(system, Task::from(task)) }
}

fn basin(points: u32) -> Plan {
    let over = |from: f64, to: f64| vibroimpact_study::Span::new(from, to, points).unwrap();
    let task = BasinPlan::plane(over(-4.0, 0.75), over(-4.0, 4.0), 0.0);
    let system = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);
    Plan { tile: Some(points), ..Plan::new(system, Task::from(task)) }
}

fn tiles(criterion: &mut Criterion) {
    for (name, plan) in [("map, 32 x 32", map(32)), ("basin, 256 x 256", basin(256))] {
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        let study = Study::new(&plan).unwrap();
        group.bench_function("compute", |b| b.iter(|| black_box(study.tile(0, &|| false).unwrap())));
        let folder = tempfile::tempdir().unwrap();
        let store = Store::create(Arc::new(Folder::new(folder.path())), &plan).unwrap();
        store.run(Part::ALL, &Control::default()).unwrap();
        let columns = store.tile(0).unwrap().1;
        group.bench_function("write", |b| b.iter(|| store.write_tile(0, black_box(&columns)).unwrap()));
        group.bench_function("read", |b| b.iter(|| black_box(store.tile(0).unwrap())));
        group.finish();
    }
}

criterion_group!(benches, tiles);
criterion_main!(benches);
