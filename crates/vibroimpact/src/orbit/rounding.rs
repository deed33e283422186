//! Whether rounding errors decide the period of a cycle that sticks.
//!
//! A release forgets what was before, so a motion that returns to it has the same state again, whatever happened on the way.
//! On the way each impact adds rounding errors, and the derivative $`A`$ of the impact map carries them on: their covariance is
//! $`E_+ = AEA^T + D`$ with that of new errors, $`D`$. If they grow noticeably, neighbours of the motion at the distance of a
//! few roundings are followed from its first impact on. If one comes back to the release after another time, the
//! motion is periodic, and numbers of these digits do not know its period.

use super::release::{Excursion, Strike};
use crate::flight::SearchLimits;
use crate::motion::{EventKind, ImpactState, Motion, derivative};
use crate::system::{Oscillator, Side};
use core::f64::consts::TAU;

/// New errors of each impact, relative to a turn of the phase and to the fastest impact.
const NEW: f64 = 2.0 * f64::EPSILON;
/// Larger errors are noticeable.
const NOTICEABLE: f64 = 1e-9;
/// The distance of neighbours.
const BESIDE: f64 = 8.0 * f64::EPSILON;
/// Times of return that differ by less, in forcing periods, are the same.
const SAME: f64 = 1e-6;

impl Excursion {
    /// Whether rounding errors decide after which time the motion returns to its release.
    pub(crate) fn rounding_decides(&self, osc: &Oscillator) -> bool {
        let all = || self.stretches.iter().flat_map(|stretch| &stretch.strikes);
        let fastest = all().map(|strike| strike.state.velocity).fold(0.0, f64::max);
        let largest = self.stretches.iter().map(|stretch| largest_error(osc, &stretch.strikes, fastest));
        let (Some(first), true) = (all().next(), largest.fold(0.0, f64::max) > NOTICEABLE) else { return false };
        let (side, most) = (self.stretches[0].from, 4 * all().count() + 64);
        let period = returns(osc, &first.state, side, most);
        [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].into_iter().any(|(later, faster)| {
            let phase = first.state.phase + later * BESIDE * TAU;
            let beside = ImpactState { phase, velocity: first.state.velocity * (1.0 + faster * BESIDE), ..first.state };
            match (period, returns(osc, &beside, side, most)) {
                (Some(one), Some(other)) => (one - other).abs() > SAME * osc.period(),
                _ => true,
            }
        })
    }
}

/// The largest error on the way through the impacts after a release, relative to a turn of the phase and to the fastest one.
fn largest_error(osc: &Oscillator, strikes: &[Strike], fastest: f64) -> f64 {
    let scales = [TAU, fastest];
    let (mut errors, mut largest) = ([[0.0; 2]; 2], 0.0_f64);
    for pair in strikes.windows(2) {
        for (i, scale) in scales.iter().enumerate() {
            errors[i][i] += (NEW * scale) * (NEW * scale);
        }
        let a = derivative(osc, &pair[0].state, &pair[1].state, pair[1].flown).0;
        let turned = |x: [[f64; 2]; 2], i: usize| [0, 1].map(|j| a[i][0] * x[0][j] + a[i][1] * x[1][j]);
        let half = [turned(errors, 0), turned(errors, 1)];
        errors = half.map(|row| [0, 1].map(|j| row[0] * a[j][0] + row[1] * a[j][1]));
        for (i, scale) in scales.iter().enumerate() {
            largest = largest.max(errors[i][i].sqrt() / scale);
        }
        if !errors.iter().flatten().all(|error: &f64| error.is_finite()) {
            return f64::INFINITY;
        }
    }
    largest
}

/// The time from an impact to the next release from the stop on `side`, within so many events.
fn returns(osc: &Oscillator, from: &ImpactState, side: Side, most: usize) -> Option<f64> {
    let mut events = Motion::after(osc, from, SearchLimits::default()).take(most);
    events.find(|event| event.side == side && matches!(event.kind, EventKind::Release)).map(|event| event.time)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plastic stop forgets at each impact; after long chaotic excursions neighbours come back after other times.
    #[test]
    fn short_excursions_are_known_and_long_ones_are_not() {
        let (mut known, mut unknown) = (0, 0);
        for k in 0..400_u32 {
            let osc = Oscillator::from_inverse_beta(2.0 + 0.02 * f64::from(k), 0.05, 0.6).unwrap();
            let Some(excursion) = Excursion::new(&osc, Side::Upper, 4000, f64::INFINITY) else { continue };
            let Some(cycle) = excursion.cycle() else { continue };
            let decides = excursion.rounding_decides(&osc);
            if cycle.points.len() < 40 {
                assert!(!decides, "{k} {}", cycle.points.len());
                known += 1;
            } else if decides {
                unknown += 1;
            }
        }
        println!("{known} {unknown}");
        assert!(known > 50, "{known}");
    }
}
