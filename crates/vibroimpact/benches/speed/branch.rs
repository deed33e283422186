//! Branches in the gap from motions of the 1971 paper: an element is a point.

use criterion::{Criterion, Throughput};
use std::hint::black_box;
use vibroimpact::continuation::{Branch, BranchOptions, Direction};
use vibroimpact::orbit::{Cycle, FindOptions, find};
use vibroimpact::{Label, Oscillator, Parameter, scenario};

/// The stable orbit called `label`.
fn orbit(osc: &Oscillator, label: Label) -> Cycle {
    let orbits = find(osc, label, FindOptions::default());
    orbits.into_iter().find(|o| o.physical && o.cycle.stable()).expect("the paper found it").cycle
}

pub(crate) fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("branch");
    for (point, m) in [(scenario::S, 1), (scenario::S, 2), (scenario::N, 4)] {
        let (osc, label) = (point.oscillator(), Label::new(m, 1));
        let cycle = orbit(&osc, label);
        for parameter in [Parameter::Gap, Parameter::InverseBeta] {
            let value = parameter.get(&osc).expect("it has one");
            let branch = || {
                let range = value - 0.5..=value + 0.5;
                let options = BranchOptions { longest: 0.02, ..BranchOptions::default() };
                Branch::new(&osc, black_box(&cycle), parameter, range, Direction::Down, options).expect("it is a cycle")
            };
            group.throughput(Throughput::Elements(branch().count() as u64));
            group.bench_function(format!("{label} in {}", parameter.name()), |b| b.iter(|| branch().count()));
        }
    }
    group.finish();
    let mut group = criterion.benchmark_group("find");
    for (point, m, n) in [(scenario::N, 4, 1), (scenario::T, 1, 2), (scenario::U, 3, 4)] {
        let (osc, label) = (point.oscillator(), Label::new(m, n));
        group.bench_function(format!("{label} at {}", point.name), |b| {
            b.iter(|| find(black_box(&osc), label, FindOptions::default()).len());
        });
    }
    group.finish();
}
