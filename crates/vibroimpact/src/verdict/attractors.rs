//! The distinct steady motions of a system, and the share of starts that lead to each.

use super::options::SettleOptions;
use super::outcome::{System, Verdict};
use super::settle::settle;
use crate::math::sort_by_key;
use crate::system::{Oscillator, Start};
use core::f64::consts::TAU;

/// A steady motion and the number of starts that lead to it.
#[derive(Clone, Debug, PartialEq)]
pub struct CountedMotion<S: System = Oscillator> {
    /// The verdict on the first start that leads to it.
    pub verdict: Verdict<S>,
    /// Starts that lead to it.
    pub count: u64,
}

/// The distinct motions of the starts counted so far. Two different cycles with the same label are counted separately.
#[derive(Clone, Debug, PartialEq)]
pub struct Census<S: System = Oscillator> {
    found: Vec<CountedMotion<S>>,
    total: u64,
}

impl<S: System> Default for Census<S> {
    fn default() -> Self {
        Self { found: Vec::new(), total: 0 }
    }
}

/// Two cycles that differ by less than this in phase and relative velocity are the same; the residuals of both are
/// rounding errors.
pub(super) const SAME: f64 = 1e-6;

impl<S: System> Census<S> {
    /// Adds a motion of another census with all its starts, and returns its index here.
    pub fn add_found(&mut self, found: &CountedMotion<S>) -> usize {
        // the verdict itself is counted once by `add`
        let number = self.add(&found.verdict);
        self.found[number].count += found.count - 1;
        self.total += found.count - 1;
        number
    }

    /// Adds one verdict and returns the index of its motion, in order of first appearance.
    pub fn add(&mut self, verdict: &Verdict<S>) -> usize {
        self.total += 1;
        if let Some(k) = self.found.iter().position(|found| found.verdict.same_as(verdict, SAME)) {
            self.found[k].count += 1;
            return k;
        }
        self.found.push(CountedMotion { verdict: verdict.clone(), count: 1 });
        self.found.len() - 1
    }

    /// The motions in order of first appearance.
    #[must_use]
    pub fn motions(&self) -> &[CountedMotion<S>] {
        &self.found
    }

    /// The motions, the most frequent first.
    #[must_use]
    pub fn by_share(&self) -> Vec<&CountedMotion<S>> {
        let mut list: Vec<&CountedMotion<S>> = self.found.iter().collect();
        sort_by_key(&mut list, |found| core::cmp::Reverse(found.count));
        list
    }

    /// The number of starts counted.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.total
    }

    /// The fraction of starts that lead to a motion.
    #[must_use]
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    pub fn share(&self, found: &CountedMotion<S>) -> f64 {
        found.count as f64 / (self.total.max(1)) as f64
    }
}

/// The box of starts to which shares refer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartBox {
    /// Range of positions.
    pub x: (f64, f64),
    /// Range of velocities.
    pub v: (f64, f64),
    /// Range of phases.
    pub phase: (f64, f64),
}

impl StartBox {
    /// The default box: with $`A = 1 + |\delta| + \min(|f|, 10)`$, positions from $`\delta - 2A`$ (or the second stop)
    /// to $`\delta`$, velocities within $`\pm A(1+\beta)/2`$ but at most $`\pm 2A`$, all phases.
    #[must_use]
    pub fn natural(osc: &Oscillator) -> Self {
        // twice the amplitude that the force and the gap give: larger motions only decay into it
        let size = osc.size();
        let (lowest, highest) = Start::room(osc);
        let speed = size * (0.5 * (1.0 + osc.beta())).min(2.0);
        Self { x: (lowest.max(highest - 2.0 * size), highest), v: (-speed, speed), phase: (0.0, TAU) }
    }
}

/// The start with the index `index` in the sequence of this `seed`.
///
/// The first start is at rest. The second is on the steady motion without impacts if that clears the stops, so that
/// this motion is not overlooked because few starts lead to it. The others are points of low discrepancy in the box
/// (the additive recurrence of the generalised golden ratio in three dimensions, M. Roberts 2018, shifted by the seed).
/// They are the same on every machine.
#[must_use]
#[allow(clippy::cast_precision_loss)] // 53 bits are kept on purpose
pub fn scattered_starts(osc: &Oscillator, area: StartBox, seed: u64, index: u64) -> Start {
    match index {
        0 => return Start::at_rest(osc),
        1 => {
            if let Some(start) = Start::free_motion(osc) {
                return start;
            }
        }
        _ => {}
    }
    // 2^64 / g, 2^64 / g^2, 2^64 / g^3 with g^4 = g + 1
    const STEP: [u64; 3] = [0xD1B5_4A32_D192_ED03, 0xABC9_8388_FB8F_AC03, 0x8CB9_2BA7_2F3D_8DD7];
    let unit = |k: usize| {
        // each coordinate is shifted by another number, so that seeds give different points
        let shift = mix(seed.wrapping_mul(3).wrapping_add(k as u64 + 1));
        let turn = STEP[k].wrapping_mul(index.wrapping_add(1)).wrapping_add(shift);
        (turn >> 11) as f64 / (1_u64 << 53) as f64
    };
    // rounding may exceed the stop by one unit in the last place, so positions are clamped
    let at = |(low, high): (f64, f64), t: f64| low + (high - low) * t;
    let (lowest, highest) = Start::room(osc);
    Start {
        x: at(area.x, unit(0)).clamp(lowest, highest),
        v: at(area.v, unit(1)),
        phase: crate::system::phase::wrap(at(area.phase, unit(2))),
    }
}

/// The finaliser of SplitMix64.
pub(super) const fn mix(seed: u64) -> u64 {
    let z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The steady motions to which `starts` starts from the natural box lead.
///
/// ```
/// use vibroimpact::{Oscillator, verdict::{SettleOptions, attractors}};
/// // S of the 1971 paper: two motions coexist
/// let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5)?;
/// let census = attractors(&osc, 40, 1, &SettleOptions::default());
/// let mut labels: Vec<_> = census.motions().iter().map(|found| found.verdict.label()).collect();
/// labels.sort();
/// assert_eq!(labels, ["1/1", "2/1"]);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn attractors(osc: &Oscillator, starts: u64, seed: u64, options: &SettleOptions) -> Census {
    let area = StartBox::natural(osc);
    let mut census = Census::default();
    for index in 0..starts {
        census.add(&settle(osc, scattered_starts(osc, area, seed, index), options).verdict);
    }
    census
}
