//! Whether a sum of harmonics stays above a level.
//!
//! Between two angles the sum $`f(\theta) = \sum_k a_k\cos k\theta + b_k\sin k\theta`$ lies above the smaller of its values
//! there less $`M\,h^2/8`$, where $`h`$ is the distance of the angles and $`M = \sum_k k^2\sqrt{a_k^2 + b_k^2}`$ bounds its
//! second derivative. Intervals in which this bound is too low are halved.

use crate::math::{hypot, sin_cos};
use core::f64::consts::TAU;

/// A harmonic of an angle: its order, and the amplitudes of cosine and sine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Harmonic {
    pub(super) order: f64,
    pub(super) cos: f64,
    pub(super) sin: f64,
}

impl Harmonic {
    pub(super) fn amplitude(&self) -> f64 {
        hypot(self.cos, self.sin)
    }
}

/// The largest number of angles at which the sum is computed. A sum that comes so near to the level that these do not suffice
/// is not proven to stay above it.
const ANGLES: u32 = 20_000;
/// Intervals of the first division, for a turn of the fastest harmonic.
const INTERVALS: f64 = 4.0;

/// Whether a sum of harmonics is above the level at every angle. `false` if this is not proven.
pub(super) fn stays_above(harmonics: &[Harmonic], level: f64) -> bool {
    let size: f64 = harmonics.iter().map(Harmonic::amplitude).sum();
    // rounding errors of the angles
    let level = level + 4.0 * f64::EPSILON * harmonics.iter().map(|of| of.order * of.amplitude()).sum::<f64>();
    // all harmonics together do not reach the level
    if -size > level {
        return true;
    }
    let moving: Vec<Harmonic> = harmonics.iter().copied().filter(|of| of.amplitude() > 0.0).collect();
    if level >= 0.0 || moving.len() < 2 {
        // the mean of the sum is 0, and one harmonic reaches its amplitude
        return false;
    }
    // orders with a common divisor repeat sooner
    let divisor = moving.iter().fold(0.0, |divisor, of| common_divisor(divisor, of.order));
    let moving: Vec<Harmonic> = moving.iter().map(|of| Harmonic { order: of.order / divisor, ..*of }).collect();
    let curvature: f64 = moving.iter().map(|of| of.order * of.order * of.amplitude()).sum();
    let at = |angle: f64| {
        moving.iter().fold(0.0, |sum, of| {
            let (sin, cos) = sin_cos(of.order * angle);
            sum + (of.cos * cos + of.sin * sin)
        })
    };
    let fastest = moving.iter().fold(1.0_f64, |most, of| most.max(of.order));
    let count = INTERVALS * fastest;
    let mut left = ANGLES;
    let mut next = 0.0;
    let (mut begin, mut value) = (0.0, at(0.0));
    let mut ends: Vec<(f64, f64)> = Vec::new();
    while next < count || !ends.is_empty() {
        if ends.is_empty() {
            next += 1.0;
            let end = TAU * next / count;
            ends.push((end, at(end)));
        }
        let Some(&(end, last)) = ends.last() else { break };
        // the sum is below the level, or so near that the angles do not suffice
        if left == 0 || value.min(last) <= level {
            return false;
        }
        left -= 1;
        let length = end - begin;
        // above the smaller end by what the curvature can bend at most
        if value.min(last) - 0.125 * curvature * length * length > level {
            (begin, value) = (end, last);
            ends.pop();
        } else {
            let middle = 0.5 * (begin + end);
            ends.push((middle, at(middle)));
        }
    }
    true
}

/// The largest common divisor of two whole numbers.
fn common_divisor(a: f64, b: f64) -> f64 {
    let (mut x, mut y) = (a, b);
    while y > 0.0 {
        (x, y) = (y, x % y);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of two to five harmonics against their smallest value at 20,000 angles: just below it they stay above the level, just
    /// above it they do not.
    #[test]
    fn levels_beside_the_minimum() {
        let mut state = 3_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31)
        };
        for case in 0..200 {
            let scale = if case % 3 == 0 { 1e-6 } else { 1.0 };
            let sum: Vec<Harmonic> = (0..2 + case % 4)
                .map(|_| Harmonic {
                    order: 1.0 + (12.0 * random()).floor(),
                    cos: scale * (random() - 0.5),
                    sin: scale * (random() - 0.5),
                })
                .collect();
            let value = |angle: f64| {
                sum.iter().map(|of| of.cos * (of.order * angle).cos() + of.sin * (of.order * angle).sin()).sum::<f64>()
            };
            let least = (0..20_000).map(|k| value(TAU * f64::from(k) / 2e4)).fold(f64::INFINITY, f64::min);
            // the samples miss the minimum by at most this
            let missed =
                sum.iter().map(|of| of.order * of.order * of.amplitude()).sum::<f64>() * (TAU / 2e4).powi(2) / 8.0;
            assert!(stays_above(&sum, least - 2.0 * missed), "case {case}: {least} {sum:?}");
            assert!(!stays_above(&sum, least), "case {case}: {least} {sum:?}");
        }
    }

    /// A sum can stay far above minus the sum of its amplitudes; a single harmonic does not.
    #[test]
    fn less_than_all_amplitudes() {
        let of = |order, cos| Harmonic { order, cos, sin: 0.0 };
        // cos t + cos 2t = 2 (c + 1/4)^2 - 9/8 with c = cos t
        assert!(stays_above(&[of(1.0, 1.0), of(2.0, 1.0)], -1.125 - 1e-13));
        assert!(!stays_above(&[of(1.0, 1.0), of(2.0, 1.0)], -1.125 + 1e-13));
        assert!(stays_above(&[of(700.0, 1.0), of(1400.0, 1.0)], -1.1251));
        assert!(!stays_above(&[of(3.0, 1.0), of(5.0, 0.0)], -1.0));
        assert!(stays_above(&[], -1e-300) && !stays_above(&[], 0.0));
    }
}
