//! One flight from the stop to its first contact: the careful search, and the strides that most flights take instead.
//!
//! The flights are those that follow the first thousand impacts of a motion. `strides` works out the constants of the
//! oscillator for every flight, which a motion does once: what a flight costs in a motion is in `impact`.

use criterion::{BenchmarkId, Criterion, Throughput};
use std::hint::black_box;
use vibroimpact::flight::{self, Flight, SearchLimits};
use vibroimpact::motion::{EventKind, Motion};
use vibroimpact::{Oscillator, Start, lanes, scenario};

const FLIGHTS: usize = 1000;

/// The flights after the first impacts of the motion from rest.
fn flights(osc: &Oscillator) -> Vec<Flight> {
    let after = Motion::new(osc, Start::at_rest(osc)).filter_map(|event| match event.kind {
        EventKind::Impact { velocity_after, .. } => {
            Some(Flight::new(osc, Start { x: osc.gap(), v: velocity_after, phase: event.phase }))
        }
        _ => None,
    });
    after.take(FLIGHTS).collect()
}

pub(crate) fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("first contact");
    group.throughput(Throughput::Elements(FLIGHTS as u64));
    let limits = SearchLimits::default();
    for (name, point) in [("S", scenario::S), ("U", scenario::U)] {
        let osc = point.oscillator();
        let flights = flights(&osc);
        group.bench_function(BenchmarkId::new("careful", name), |b| {
            b.iter(|| flights.iter().for_each(|flight| _ = black_box(flight::first_contact(&osc, flight, limits))));
        });
        group.bench_function(BenchmarkId::new("strides", name), |b| {
            b.iter(|| flights.iter().for_each(|flight| _ = black_box(lanes::first_contact(&osc, flight, limits))));
        });
    }
    group.finish();
}
