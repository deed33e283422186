//! Which motion each start of a plane leads to, where two coexist: the whole question at every width of the lanes, the
//! survey included, and some of its starts one by one.

use crate::widths;
use criterion::{Criterion, Throughput};
use std::hint::black_box;
use vibroimpact::verdict::{KnownAttractors, SettleOptions, StartBox, settle, settle_many};
use vibroimpact::{Oscillator, Start, scenario};

/// Positions, and velocities.
const SIDE: u64 = 50;
/// Starts of the survey.
const SURVEY: u64 = 24;
/// Starts settled one by one.
const ALONE: u64 = 100;

/// Start number `k` of a grid over the natural box, at phase 0.
fn start(osc: &Oscillator, k: u64) -> Start {
    let area = StartBox::natural(osc);
    let at = |(low, high): (f64, f64), k: u64| low + (high - low) * k as f64 / (SIDE - 1) as f64;
    let (lowest, highest) = Start::room(osc);
    Start { x: at(area.x, k % SIDE).clamp(lowest, highest), v: at(area.v, k / SIDE), phase: 0.0 }
}

pub(crate) fn bench(criterion: &mut Criterion) {
    let (osc, options) = (scenario::S.oscillator(), SettleOptions::default());
    let total = SIDE * SIDE;
    let start = |k: u64| start(&osc, k);
    let mut group = criterion.benchmark_group("basin at S, starts");
    group.throughput(Throughput::Elements(total));
    for (width, name) in widths() {
        group.bench_function(name, |b| {
            b.iter(|| {
                let survey = KnownAttractors::survey(&osc, (0..SURVEY).map(|k| start(total / SURVEY * k)), &options);
                settle_many(&osc, 0..black_box(total), &start, &survey, &options, width, &|| false)
            });
        });
    }
    group.throughput(Throughput::Elements(ALONE));
    group.bench_function("one by one", |b| {
        b.iter(|| {
            let settled = (0..ALONE).map(|k| settle(&osc, start(black_box(total / ALONE * k)), &options));
            settled.map(|settled| settled.impacts).sum::<u64>()
        });
    });
    group.finish();
}
