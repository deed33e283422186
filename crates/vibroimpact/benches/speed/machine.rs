//! Machines: their events, one motion from one start.

use crate::machine_problems;
use criterion::{BenchmarkId, Criterion, Throughput};
use std::hint::black_box;
use vibroimpact::events::{Limits, Motion};

const EVENTS: usize = 1000;

pub(crate) fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("machine");
    group.throughput(Throughput::Elements(EVENTS as u64));
    for problem in machine_problems::all() {
        group.bench_function(BenchmarkId::from_parameter(problem.name), |b| {
            b.iter(|| {
                let start = black_box(&problem.start);
                let motion = Motion::new(&problem.machine, start, Limits::default());
                motion.expect("a legal start").take(EVENTS).last()
            });
        });
    }
    group.finish();
}
