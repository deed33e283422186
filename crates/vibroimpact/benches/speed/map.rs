//! Which motions there are in the plane of the 1971 paper's figure 4: a coarse map, a few starts a point.

use criterion::{Criterion, Throughput};
use std::hint::black_box;
use std::time::Duration;
use vibroimpact::Oscillator;
use vibroimpact::lanes::Width;
use vibroimpact::verdict::{KnownAttractors, SettleOptions, StartBox, scattered_starts, settle_many};

/// Values of each parameter.
const SIDE: u32 = 10;
/// Starts a point.
const STARTS: u64 = 4;

/// The oscillators of the plane.
fn plane() -> Vec<Oscillator> {
    let at = |low: f64, high: f64, k: u32| low + (high - low) * f64::from(k) / f64::from(SIDE - 1);
    let point = |k: u32| Oscillator::from_inverse_beta(at(0.4, 2.0, k % SIDE), at(-1.0, 5.0, k / SIDE), 0.5);
    (0..SIDE * SIDE).map(|k| point(k).expect("the paper's plane is legal")).collect()
}

/// The motions at a point.
fn motions(osc: &Oscillator, options: &SettleOptions) -> usize {
    let area = StartBox::natural(osc);
    let start = |index: u64| scattered_starts(osc, area, 1, index);
    settle_many(osc, 0..STARTS, &start, &KnownAttractors::default(), options, Width::best(), &|| false).motions.len()
}

pub(crate) fn bench(criterion: &mut Criterion) {
    let (plane, options) = (plane(), SettleOptions::default());
    let mut group = criterion.benchmark_group("map");
    group.throughput(Throughput::Elements(plane.len() as u64)).sample_size(10).measurement_time(Duration::from_secs(3));
    group.bench_function("points", |b| {
        b.iter(|| black_box(&plane).iter().map(|osc| motions(osc, &options)).sum::<usize>());
    });
    group.finish();
}
