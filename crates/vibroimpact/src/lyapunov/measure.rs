//! Lyapunov exponents along the impacts of a motion, as verdicts need them for many motions side by side.
//!
//! The tangent vectors are those of phase and arrival speed, whose area also changes by $`U_0/U_1`$. So over a run the
//! sum of the exponents differs from the identity by $`\ln(U_0/U_1)/t`$. The error bar is three standard errors of the
//! mean of 25 blocks. For numbers to publish use [`exponents`](crate::chaos::exponents()). The bits computed here must
//! not change, because verdicts depend on them.

use super::blocks::{FEWEST_BLOCKS, LogSum, VERDICT_BLOCKS};
use super::{Measured, Spectrum, Tail};
use crate::flight::SearchLimits;
use crate::math::{Matrix2, Wide};
use crate::motion::{ABREAST, ImpactMap, ImpactState, Mapped, derivatives};
use crate::system::Oscillator;

/// The limits of the search of each flight; the exponents of a motion with longer flights are not measured.
const LIMITS: SearchLimits = SearchLimits { periods: 1000.0, steps: 2_000 };
/// The number of blocks of the run.
#[allow(clippy::cast_possible_truncation)] // a few dozen
const BLOCKS: u32 = VERDICT_BLOCKS as u32;

/// The Lyapunov exponents along the motion that arrives at `from`, over `impacts` further impacts. `None` if the motion
/// sticks (then the larger exponent is minus infinity), if it has no further impact, or if the larger exponent is not
/// finite.
///
/// ```
/// use vibroimpact::{Oscillator, Side, chaos::lyapunov, motion::ImpactState};
/// let osc = Oscillator::from_inverse_beta(1.11, 3.0, 0.5)?;           // U of the 1971 paper
/// let from = ImpactState { phase: 1.4, velocity: 2.4, side: Side::Upper };
/// let spectrum = lyapunov(&osc, from, 5_000).unwrap();
/// assert!(spectrum.exponents[0].value > spectrum.exponents[0].error);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn lyapunov(osc: &Oscillator, from: ImpactState, impacts: u32) -> Option<Spectrum> {
    let mut measure = Measure::new(from, impacts);
    let mut map = ImpactMap::new(osc, LIMITS);
    while !measure.complete() {
        let Mapped::Impact { state, interval } = map.after(&measure.state) else {
            return None;
        };
        measure.impact(osc, state, interval);
    }
    measure.spectrum(osc)
}

/// A measurement in progress; impacts are added one by one.
#[derive(Clone, Debug)]
pub(crate) struct Measure {
    /// The last impact.
    pub(crate) state: ImpactState,
    tail: Tail,
    u: [f64; 2],
    w: [f64; 2],
    per_block: u32,
    /// The number of impacts that are still missing.
    left: u32,
    /// The impacts whose derivatives are not computed yet, with the time since the one before, and the impact before
    /// them.
    pending: Vec<(ImpactState, f64)>,
    before: ImpactState,
    /// The number of impacts of the current block.
    count: u32,
    time: Wide,
    one: LogSum,
    two: LogSum,
    /// For each block: the means of both exponents and of the number of impacts per unit of time, and the time.
    blocks: Vec<([f64; 3], f64)>,
}

impl Measure {
    /// A measurement from an impact on, over this number of further impacts.
    pub(crate) fn new(from: ImpactState, impacts: u32) -> Self {
        let per_block = (impacts / BLOCKS).max(1);
        Self {
            state: from,
            tail: Tail::new(from),
            u: [1.0, 0.0],
            w: [0.0, 1.0],
            per_block,
            left: BLOCKS * per_block,
            pending: Vec::with_capacity(ABREAST),
            before: from,
            count: 0,
            time: Wide::default(),
            one: LogSum::default(),
            two: LogSum::default(),
            blocks: Vec::with_capacity(BLOCKS as usize),
        }
    }

    /// Whether all impacts have been added.
    pub(crate) const fn complete(&self) -> bool {
        self.left == 0
    }

    /// The last impacts so far.
    pub(crate) fn tail(&self) -> Tail {
        self.tail.so_far()
    }

    /// The number of impacts that are still missing.
    pub(crate) const fn left(&self) -> u32 {
        self.left
    }

    /// Adds the next impact, `interval` after the last one.
    pub(crate) fn impact(&mut self, osc: &Oscillator, next: ImpactState, interval: f64) {
        self.state = next;
        self.left = self.left.saturating_sub(1);
        self.tail.impact(&next, u64::from(self.left));
        self.pending.push((next, interval));
        // as many as are computed side by side
        if self.pending.len() == ABREAST || self.complete() {
            self.catch_up(osc);
        }
    }

    /// Takes the pending impacts into account. Their derivatives do not depend on each other and are computed side by
    /// side.
    fn catch_up(&mut self, osc: &Oscillator) {
        let derivatives = derivatives(osc, &self.before, &self.pending);
        let mut pending = core::mem::take(&mut self.pending);
        for ((next, interval), derivative) in pending.drain(..).zip(derivatives) {
            self.before = next;
            self.stretch(derivative, interval);
        }
        self.pending = pending;
    }

    /// Carries the tangent vectors through a flight and its impact.
    fn stretch(&mut self, d: Matrix2, interval: f64) {
        let (u, w) = (d.apply(self.u), d.apply(self.w));
        // the first vector takes the direction that is stretched most
        let along = (u[0] * u[0] + u[1] * u[1]).sqrt();
        self.u = [u[0] / along, u[1] / along];
        // the part of w perpendicular to u is the area divided by the length
        let across = (self.u[0] * w[1] - self.u[1] * w[0]).abs();
        self.w = [-self.u[1], self.u[0]];
        self.one.multiply(along);
        self.two.multiply(across);
        self.time += interval;
        self.count += 1;
        if self.count == self.per_block {
            let t = self.time.value();
            let means = [self.one.value() / t, self.two.value() / t, f64::from(self.per_block) / t];
            self.blocks.push((means, t));
            (self.count, self.time) = (0, Wide::default());
            (self.one, self.two) = (LogSum::default(), LogSum::default());
        }
    }

    /// The blocks that are complete.
    fn blocks(&self, osc: &Oscillator) -> Vec<([f64; 3], f64)> {
        if self.pending.is_empty() {
            return self.blocks.clone();
        }
        // the measurement itself goes on unchanged
        let mut all = self.clone();
        all.catch_up(osc);
        all.blocks
    }

    /// The exponents, and whether the motion is chaotic by this measurement: [`Spectrum::chaotic`] holds, and the last
    /// fifth of the measurement diverges too. `None` for fewer than [`FEWEST_BLOCKS`], or if the larger exponent is not
    /// finite.
    pub(crate) fn chaos(&self, osc: &Oscillator) -> Option<(Spectrum, bool)> {
        let blocks = self.blocks(osc);
        let spectrum = Self::over(&blocks).filter(|_| blocks.len() >= FEWEST_BLOCKS)?;
        // the sum of the logarithms of the stretches in the last blocks
        let last: f64 = blocks.iter().rev().take(FEWEST_BLOCKS).map(|(means, t)| means[0] * t).sum();
        Some((spectrum, spectrum.chaotic() && last > 0.0))
    }

    /// The exponents of all complete blocks; `None` if the larger exponent is not finite.
    pub(crate) fn spectrum(&self, osc: &Oscillator) -> Option<Spectrum> {
        Self::over(&self.blocks(osc))
    }

    /// The exponents over these blocks.
    fn over(blocks: &[([f64; 3], f64)]) -> Option<Spectrum> {
        let of = |k: usize| {
            let values: Vec<(f64, f64)> = blocks.iter().map(|(means, t)| (means[k], *t)).collect();
            mean(&values)
        };
        let exponents = [of(0), of(1)];
        let time = blocks.iter().map(|(_, t)| t).sum();
        exponents[0].value.is_finite().then(|| Spectrum { exponents, impact_rate: of(2), time })
    }
}

/// The time-weighted mean of the blocks, with three standard errors.
fn mean(blocks: &[(f64, f64)]) -> Measured {
    let total: f64 = blocks.iter().map(|(_, t)| t).sum();
    let value = blocks.iter().map(|(x, t)| x * t).sum::<f64>() / total;
    #[allow(clippy::cast_precision_loss)] // a few dozen
    let count = blocks.len() as f64;
    let spread: f64 = blocks
        .iter()
        .map(|(x, t)| {
            // relative to a block of mean length
            let deviation = (x - value) * t * count / total;
            deviation * deviation
        })
        .sum();
    Measured { value, error: 3.0 * (spread / (count * (count - 1.0))).sqrt() }
}
