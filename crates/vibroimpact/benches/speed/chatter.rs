//! A motion with complete chatter: the mass is pressed onto the stop, sticks and is released in every period.

use criterion::{Criterion, Throughput};
use std::hint::black_box;
use vibroimpact::motion::Motion;
use vibroimpact::verdict::{SettleOptions, settle};
use vibroimpact::{Oscillator, Start};

const EVENTS: usize = 1000;

pub(crate) fn bench(criterion: &mut Criterion) {
    let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).expect("a legal oscillator");
    let mut group = criterion.benchmark_group("chatter");
    group.bench_function("settle", |b| {
        b.iter(|| settle(&osc, black_box(Start::at_rest(&osc)), &SettleOptions::default()));
    });
    group.throughput(Throughput::Elements(EVENTS as u64));
    group.bench_function("events", |b| {
        b.iter(|| Motion::new(&osc, black_box(Start::at_rest(&osc))).take(EVENTS).last());
    });
    group.finish();
}
