//! Continuation against closed forms worked out here, and against simulation.
//!
//! | what | file |
//! |---|---|
//! | one impact in n periods: orbit, multipliers, fold and doubling curves | `closed_forms` |
//! | points of codimension two, and ends of curves | `codimension` |
//! | the events of 2/1, 1/3 and 1/4 on a line, flown on either side | `events` |
//! | curves of folds, flips and grazing impacts in the plane | `curves` |
//! | the steady motion without impacts, and what begins where it touches | `free` |
//! | every event between 1/beta = 1.11, delta = 0 and loss of contact, confirmed by simulation | `line` |
//! | where 1/1 exists and where it is stable, against motions inside, outside and beside the edge | `regions` |
//! | lines through two parameters, against each of them alone | `oblique` |
//! | cycles that rest on a stop: where they change and end | `resting` |
//! | two stops alike: symmetry lost and found | `symmetric` |
//! | a damped oscillator at resonance, down to its grazing | `grazing` |
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod closed_forms;
mod codimension;
mod curves;
mod events;
mod free;
mod free_region;
mod grazing;
mod line;
mod oblique;
mod regions;
mod resting;
mod symmetric;

use vibroimpact::orbit::{Cycle, CyclePoint};
use vibroimpact::{Label, Side, motion::ImpactState};

/// Random numbers, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Between `low` and `high`.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number below `count`.
    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.next() % count as u64).expect("it is below a usize")
    }
}

/// A guess at a cycle with one impact on the first stop in `n` periods of length `period`.
fn guess(phase: f64, velocity: f64, n: u32, period: f64) -> Cycle {
    let state = ImpactState { phase: phase.rem_euclid(std::f64::consts::TAU), velocity, side: Side::Upper };
    Cycle {
        label: Label::new(1, n),
        points: vec![CyclePoint { state, interval: f64::from(n) * period }],
        rests: Vec::new(),
        multipliers: Default::default(),
        residual: f64::NAN,
    }
}
