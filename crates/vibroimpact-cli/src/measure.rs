//! The workloads of `vibro bench` and the measurement of their rates.

use crate::signal;
use clap::ValueEnum;
use serde::Serialize;
use std::hint::black_box;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use vibroimpact::flight::SearchLimits;
use vibroimpact::lanes::{ABREAST, Batch, Width};
use vibroimpact::math::sort_by;
use vibroimpact::motion::{EventKind, Motion};
use vibroimpact::verdict::{KnownAttractors, SettleOptions, settle, settle_many};
use vibroimpact::{Oscillator, Start, scenario};

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Workload {
    /// Impacts of the chaotic motion at U
    Chaos,
    /// Impacts of the settled motions at S
    Regular,
    /// Starts of a basin at S
    Basin,
}

impl Workload {
    pub(crate) const ALL: [Self; 3] = [Self::Chaos, Self::Regular, Self::Basin];
}

/// Rates per second.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Rates {
    pub(crate) scalar: f64,
    pub(crate) lanes: f64,
}

/// Measures a workload for about the given duration.
pub(crate) fn measure(workload: Workload, width: Width, duration: Duration) -> Rates {
    match workload {
        Workload::Chaos => {
            let osc = scenario::U.oscillator();
            let rest = Start::at_rest(&osc);
            Rates { scalar: alone(&osc, rest, duration / 3), lanes: abreast(&osc, width, spread(&osc), duration / 2) }
        }
        Workload::Regular => {
            let osc = scenario::S.oscillator();
            // motions 2/1 and 1/1 with equal numbers of impacts, so that the times can be added
            let starts = [Start { x: 0.0, v: 0.0, phase: 0.0 }, Start { x: -2.0, v: 0.0, phase: 0.0 }];
            let both = |rate: &dyn Fn(Start) -> f64| 2.0 / starts.map(|start| 1.0 / rate(start)).iter().sum::<f64>();
            Rates {
                scalar: both(&|start| alone(&osc, start, duration / 6)),
                lanes: both(&|start| abreast(&osc, width, along(&osc, start), duration / 4)),
            }
        }
        Workload::Basin => Rates { scalar: one_by_one(duration / 3), lanes: basin(width, duration / 2) },
    }
}

/// Number of impacts before the measurement.
const TRANSIENT: usize = 200;
/// Duration of a slice of the measurement.
const SLICE: Duration = Duration::from_millis(50);

/// The median of the rates in slices; `work` returns the number of things done.
fn median_rate(duration: Duration, mut work: impl FnMut() -> usize) -> f64 {
    let begin = Instant::now();
    let mut rates = Vec::new();
    while rates.is_empty() || (begin.elapsed() < duration && !signal::flag().load(Ordering::Relaxed)) {
        let (slice, mut done) = (Instant::now(), 0);
        while slice.elapsed() < SLICE.min(duration) {
            done += work();
        }
        #[allow(clippy::cast_precision_loss)] // counts below 2^53
        rates.push(done as f64 / slice.elapsed().as_secs_f64());
    }
    sort_by(&mut rates, f64::total_cmp);
    rates[rates.len() / 2]
}

/// Impacts per second of one motion.
fn alone(osc: &Oscillator, start: Start, duration: Duration) -> f64 {
    let mut impacts =
        Motion::new(osc, start).filter(|event| matches!(event.kind, EventKind::Impact { .. })).skip(TRANSIENT);
    median_rate(duration, || impacts.by_ref().take(1000).map(black_box).count())
}

/// The relative place (0 to 1) of each of the simultaneous motions.
fn parts() -> impl Iterator<Item = f64> {
    #[allow(clippy::cast_precision_loss)] // a thousand
    (0..ABREAST).map(|k| k as f64 / ABREAST as f64)
}

/// Starts at rest, spread over all positions and phases.
fn spread(osc: &Oscillator) -> Vec<Start> {
    parts().map(|part| Start { x: osc.gap() - 4.0 * part, v: 0.0, phase: 6.0 * ((7.0 * part) % 1.0) }).collect()
}

/// Starts along a flight of the settled motion, so that the motions are the same at different phases.
fn along(osc: &Oscillator, start: Start) -> Vec<Start> {
    let mut motion = Motion::new(osc, start);
    let settled = motion.by_ref().nth(TRANSIENT).is_some();
    let Some(leg) = motion.leg().filter(|_| settled) else { return Vec::new() };
    parts().map(|part| leg.start(osc, part * leg.duration)).collect()
}

/// Impacts per second of many simultaneous motions.
fn abreast(osc: &Oscillator, width: Width, starts: Vec<Start>, duration: Duration) -> f64 {
    let Some(mut batch) = Batch::new(osc, ABREAST, width) else { return 0.0 };
    let count = starts.len();
    for start in starts {
        batch.push(start);
    }
    let mut round = || {
        let mut struck = 0;
        for _ in 0..16 {
            batch.round();
            struck += batch.struck().len();
            for slot in batch.rare().to_vec() {
                batch.carefully(slot, SearchLimits::default());
                struck += 1;
            }
        }
        struck
    };
    let mut dropped = 0;
    while dropped < TRANSIENT * count {
        dropped += round();
    }
    median_rate(duration, || black_box(round()))
}

/// A start of the basin, which is a grid of 100 x 100.
fn basin_start(k: u64) -> Start {
    #[allow(clippy::cast_precision_loss)] // up to 100
    let (column, row) = ((k % 100) as f64, (k / 100) as f64);
    Start { x: -4.0 + 4.75 * (column + 0.5) / 100.0, v: -4.0 + 8.0 * (row + 0.5) / 100.0, phase: 0.0 }
}

/// Starts per second to a confirmed motion, including the survey of the basin.
fn basin(width: Width, duration: Duration) -> f64 {
    let (osc, options) = (scenario::S.oscillator(), SettleOptions::default());
    median_rate(duration, || {
        let survey = KnownAttractors::survey(&osc, (0..24).map(|k| basin_start(417 * k)), &options);
        settle_many(&osc, 0..10_000, &basin_start, &survey, &options, width, &|| false).cells.len()
    })
}

/// The number of starts between two looks at the clock.
const BATCH: usize = 100;

/// The same for starts that are settled one after another, each without the results of the others.
fn one_by_one(duration: Duration) -> f64 {
    let (osc, options) = (scenario::S.oscillator(), SettleOptions::default());
    let mut starts = (0..10_000).map(|k| 7919 * k % 10_000).cycle();
    median_rate(duration, || {
        starts.by_ref().take(BATCH).for_each(|k| drop(black_box(settle(&osc, basin_start(k), &options))));
        BATCH
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_workload_is_done() {
        for workload in Workload::ALL {
            let rates = measure(workload, Width::best(), Duration::from_millis(20));
            assert!(rates.scalar > 1e3 && rates.lanes > 1e3, "{workload:?} {rates:?}");
        }
    }
}
