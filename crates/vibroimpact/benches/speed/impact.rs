//! One impact after another: the motion as an iterator, from rest, over a thousand events.

use criterion::{BenchmarkId, Criterion, Throughput};
use std::hint::black_box;
use vibroimpact::motion::Motion;
use vibroimpact::{Start, scenario};

const EVENTS: usize = 1000;

pub(crate) fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("impact step");
    group.throughput(Throughput::Elements(EVENTS as u64));
    for (name, point) in [("S", scenario::S), ("U", scenario::U)] {
        let osc = point.oscillator();
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| Motion::new(&osc, black_box(Start::at_rest(&osc))).take(EVENTS).last());
        });
    }
    group.finish();
}
