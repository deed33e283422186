//! Quotients of sums over a run, with error bars that take account of correlation.
//!
//! A run is divided into blocks of equal numbers of impacts. A number per unit of time is $`r = \sum A_k/\sum B_k`$
//! over the blocks. With the deviations $`d_k = A_k - rB_k`$ of $`n`$ blocks its standard error is
//!
//! $$`\frac{1}{|\sum B_k|}\sqrt{\frac{n}{n-1}\sum d_k^2}`$$
//!
//! if the blocks are independent. If neighbouring blocks are correlated, this is too small, and it increases when
//! blocks are joined in pairs until they are long enough (H. Flyvbjerg and H. G. Petersen, J. Chem. Phys. 91 (1989)
//! 461-466, doi:10.1063/1.457480). So it is computed for 128, 64 and 32 blocks, and the largest of the three is used.
//! Correlation over more than a 32nd of the run cannot be detected from that run.
//!
//! The exponent of a run of time $`t`$ is not defined better than to about $`1/t`$, because another measure of length
//! would multiply the stretch by a factor of order 1. So the error bar of a sum of such logarithms is at least 1 over
//! $`|\sum B_k|`$.

use super::Measured;
use crate::math::{Wide, ln};

/// The number of blocks of a run of which exponents are reported.
pub(crate) const BLOCKS: u64 = 128;
/// The smallest number of blocks from which a standard error is computed.
pub(crate) const FEWEST: usize = 32;
/// The number of blocks of a run that decides on chaos, which verdicts depend on.
pub(crate) const VERDICT_BLOCKS: u64 = 25;
/// The smallest number of blocks for a verdict. The same number of blocks at the end of the run must diverge by themselves;
/// otherwise the divergence may have ended.
pub(crate) const FEWEST_BLOCKS: usize = 5;
/// The rounding error of a sum, relative to the sum of the absolute values.
const ROUNDING: f64 = 1e-13;
/// The change of the logarithm of a stretch if another measure of length is used.
pub(crate) const MEASURE: f64 = 1.0;

/// The sums over a block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Block {
    /// The logarithms of the stretches of all tangent vectors.
    pub(crate) stretch: Vec<f64>,
    /// The logarithm of the change of volume, exact.
    pub(crate) volume: f64,
    /// The time.
    pub(crate) time: f64,
    /// The number of impacts.
    pub(crate) impacts: f64,
}

/// The logarithm of a product of many factors. They are multiplied as long as the product neither overflows nor
/// underflows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LogSum {
    product: f64,
    sum: Wide,
}

impl Default for LogSum {
    fn default() -> Self {
        Self { product: 1.0, sum: Wide::default() }
    }
}

impl LogSum {
    /// Multiplies the product by `factor`, which must not be negative.
    pub(crate) fn multiply(&mut self, factor: f64) {
        let product = self.product * factor;
        // one logarithm for many factors: it takes longer than the product
        if (1e-100..=1e100).contains(&product) {
            self.product = product;
        } else {
            self.sum += ln(self.product);
            self.product = factor;
        }
    }

    /// Adds a factor given by its logarithm.
    pub(crate) fn add(&mut self, logarithm: f64) {
        self.sum += logarithm;
    }

    pub(crate) fn value(mut self) -> f64 {
        self.sum += ln(self.product);
        self.sum.value()
    }
}

/// The quotient of two sums, with three standard errors. The error of the upper sum is at least `least`. An infinite
/// quotient has no error.
pub(crate) fn quotient<B>(blocks: &[B], least: f64, above: impl Fn(&B) -> f64, below: impl Fn(&B) -> f64) -> Measured {
    let sum = |of: &dyn Fn(&B) -> f64| blocks.iter().map(of).sum::<f64>();
    let (a, b) = (sum(&above), sum(&below));
    let value = a / b;
    if !value.is_finite() || !b.is_finite() {
        return Measured { value, error: 0.0 };
    }
    let mut deviations: Vec<f64> = blocks.iter().map(|block| above(block) - value * below(block)).collect();
    let mut error = least.max(ROUNDING * sum(&|block| above(block).abs()));
    loop {
        #[allow(clippy::cast_precision_loss)] // at most 128
        let n = deviations.len() as f64;
        let square: f64 = deviations.iter().map(|d| d * d).sum();
        // a single block has no deviation from the mean
        error = error.max(if n > 1.0 { 3.0 * (n / (n - 1.0) * square).sqrt() } else { f64::INFINITY });
        // the next ones would be fewer than a standard error needs
        if deviations.len() < 2 * FEWEST {
            return Measured { value, error: error / b.abs() };
        }
        deviations = deviations.chunks(2).map(|pair| pair.iter().sum()).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudorandom numbers between -1/2 and 1/2.
    fn noise(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(*seed >> 32).unwrap()) / f64::from(u32::MAX) - 0.5
    }

    /// Runs of blocks whose values are correlated with the value before with this weight: how often the true mean lies
    /// within the error bar, and the mean width of the bar.
    fn coverage(memory: f64) -> (f64, f64) {
        let (mut seed, mut within, mut width) = (7, 0, 0.0);
        for _ in 0..400 {
            let mut x = 0.0;
            let blocks: Vec<Block> = (0..BLOCKS)
                .map(|_| {
                    x = memory * x + noise(&mut seed);
                    Block { volume: 0.3 + x, time: 1.0, ..Block::default() }
                })
                .collect();
            let found = quotient(&blocks, 0.0, |b| b.volume, |b| b.time);
            within += u32::from((found.value - 0.3).abs() <= found.error);
            width += found.error / 400.0;
        }
        (f64::from(within) / 400.0, width)
    }

    #[test]
    fn correlated_blocks_have_wider_bars() {
        // 128 independent values of variance 1/12: three standard errors are 0.0765
        let (within, width) = coverage(0.0);
        assert!(within > 0.985 && (0.076..0.095).contains(&width), "{within} {width}");
        // the mean of these has a standard error twice as large (0.153). Single blocks, of variance 1/9, show 0.088 of it; sums
        // of four, of variance 8.25/9, show 3 sqrt(32 * 8.25/9)/128 = 0.127
        let (within, width) = coverage(0.5);
        assert!(within > 0.97 && (0.12..0.135).contains(&width), "{within} {width}");
    }

    #[test]
    fn infinite_sums_and_single_blocks() {
        let one = || Block { stretch: vec![0.5, f64::NEG_INFINITY], time: 2.0, ..Block::default() };
        let run = |blocks: usize| core::iter::repeat_with(one).take(blocks).collect::<Vec<_>>();
        let found = quotient(&run(40), MEASURE, |b| b.stretch[1], |b| b.time);
        assert_eq!(found, Measured { value: f64::NEG_INFINITY, error: 0.0 });
        let found = quotient(&run(40), MEASURE, |b| b.stretch[0], |b| -b.stretch[1]);
        assert_eq!((found.value, found.error), (0.0, 0.0));
        let found = quotient(&run(1), MEASURE, |b| b.stretch[0], |b| b.time);
        assert_eq!((found.value, found.error), (0.25, f64::INFINITY));
        let found = quotient(&run(40), MEASURE, |b| b.stretch[0], |b| b.time);
        assert_eq!((found.value, found.error), (0.25, 1.0 / 80.0));
    }
}
