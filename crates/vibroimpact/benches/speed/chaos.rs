//! A chaotic motion: its exponents measured along an orbit, a start recognised as chaotic, and quantities over the last
//! impacts.

use criterion::{Criterion, Throughput};
use std::hint::black_box;
use vibroimpact::chaos::{ExponentOptions, exponents, lyapunov};
use vibroimpact::motion::ImpactState;
use vibroimpact::quantities::{MEASURED_IMPACTS, Quantity, of_verdict_only};
use vibroimpact::verdict::{SettleOptions, settle};
use vibroimpact::{Side, Start, scenario};

const IMPACTS: u32 = 2000;

pub(crate) fn bench(criterion: &mut Criterion) {
    let osc = scenario::U.oscillator();
    let mut group = criterion.benchmark_group("chaos at U");
    group.bench_function("settle", |b| {
        b.iter(|| settle(&osc, black_box(Start::at_rest(&osc)), &SettleOptions::default()));
    });
    let from = ImpactState { phase: 1.4, velocity: 2.4, side: Side::Upper };
    group.throughput(Throughput::Elements(u64::from(IMPACTS)));
    group.bench_function("exponents", |b| b.iter(|| lyapunov(&osc, black_box(from), IMPACTS)));
    let options = ExponentOptions::new(u64::from(IMPACTS) - 500, 500);
    group.bench_function("exponents from a start", |b| {
        b.iter(|| exponents(&osc, black_box(Start::at_rest(&osc)), &options));
    });
    let verdict = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
    group.throughput(Throughput::Elements(MEASURED_IMPACTS));
    for (name, asked) in [
        ("impact speeds", Quantity::ImpactSpeedMax),
        ("power", Quantity::Power),
        ("largest displacement", Quantity::DisplacementMax),
        ("largest acceleration", Quantity::AccelerationMax),
    ] {
        group.bench_function(name, |b| b.iter(|| of_verdict_only(&osc, black_box(&verdict), &[asked])));
    }
    group.finish();
}
