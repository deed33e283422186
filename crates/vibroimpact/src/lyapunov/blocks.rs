//! Quotients of sums over a run, with an error bar that knows of correlation.
//!
//! A run is cut into blocks of equally many impacts, and a number per unit of time is $`r = \sum A_k/\sum B_k`$ over them. With the
//! deviations $`d_k = A_k - rB_k`$ of $`n`$ blocks its standard error is
//!
//! $$`\frac{1}{|\sum B_k|}\sqrt{\frac{n}{n-1}\sum d_k^2}`$$
//!
//! if the blocks are independent. Where neighbours are correlated it is too small, and grows when blocks are joined in pairs
//! until they are long enough (H. Flyvbjerg and H. G. Petersen, J. Chem. Phys. 91 (1989) 461-466, doi:10.1063/1.457480). So it is
//! taken for 128, 64 and 32 blocks, and the largest of the three counts. What is correlated over more than a 32nd of the run no error bar
//! from that run can know.
//!
//! Nor is the exponent of a run of time $`t`$ better defined than to about $`1/t`$: another measure of length would multiply the
//! stretch by a number of order 1. So the bar of a sum of such logarithms is never less than 1 over $`|\sum B_k|`$.

use super::Measured;

/// Blocks a run is cut into.
pub(crate) const BLOCKS: u64 = 128;
/// Fewer blocks say too little about their own scatter.
const FEWEST: usize = 32;
/// Sums are not known better than this, in parts of the sum of their absolute values.
const ROUNDING: f64 = 1e-13;
/// What another measure of length would change a logarithm of a stretch by.
pub(crate) const MEASURE: f64 = 1.0;

/// What is summed over a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Block {
    /// Logarithms of both stretches.
    pub(crate) stretch: [f64; 2],
    /// Logarithm of the area's change, exact.
    pub(crate) area: f64,
    /// Its length.
    pub(crate) time: f64,
    /// Its impacts.
    pub(crate) impacts: f64,
}

impl Block {
    /// Both one after the other.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            stretch: [self.stretch[0] + other.stretch[0], self.stretch[1] + other.stretch[1]],
            area: self.area + other.area,
            time: self.time + other.time,
            impacts: self.impacts + other.impacts,
        }
    }
}

/// The quotient of two sums and three standard errors of it, the upper sum being known to within `least` at best. Infinite sums
/// have an infinite quotient without error.
pub(crate) fn quotient(
    blocks: &[Block],
    least: f64,
    above: impl Fn(&Block) -> f64,
    below: impl Fn(&Block) -> f64,
) -> Measured {
    let sum = |of: &dyn Fn(&Block) -> f64| blocks.iter().map(of).sum::<f64>();
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
        // one block alone has no scatter
        error = error.max(if n > 1.0 { 3.0 * (n / (n - 1.0) * square).sqrt() } else { f64::INFINITY });
        if deviations.len() < 2 * FEWEST {
            return Measured { value, error: error / b.abs() };
        }
        deviations = deviations.chunks(2).map(|pair| pair.iter().sum()).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between -1/2 and 1/2 that look like chance.
    fn noise(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(*seed >> 32).unwrap()) / f64::from(u32::MAX) - 0.5
    }

    /// Runs of blocks whose values remember their neighbour with this weight; how often the true mean lies within the bar,
    /// and how wide the bar is on average.
    fn coverage(memory: f64) -> (f64, f64) {
        let (mut seed, mut within, mut width) = (7, 0, 0.0);
        for _ in 0..400 {
            let mut x = 0.0;
            let blocks: Vec<Block> = (0..BLOCKS)
                .map(|_| {
                    x = memory * x + noise(&mut seed);
                    Block { area: 0.3 + x, time: 1.0, ..Block::default() }
                })
                .collect();
            let found = quotient(&blocks, 0.0, |b| b.area, |b| b.time);
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
        let one = Block { stretch: [0.5, f64::NEG_INFINITY], time: 2.0, ..Block::default() };
        let found = quotient(&[one; 40], MEASURE, |b| b.stretch[1], |b| b.time);
        assert_eq!(found, Measured { value: f64::NEG_INFINITY, error: 0.0 });
        let found = quotient(&[one; 40], MEASURE, |b| b.stretch[0], |b| -b.stretch[1]);
        assert_eq!((found.value, found.error), (0.0, 0.0));
        let found = quotient(&[one], MEASURE, |b| b.stretch[0], |b| b.time);
        assert_eq!((found.value, found.error), (0.25, f64::INFINITY));
        let found = quotient(&[one; 40], MEASURE, |b| b.stretch[0], |b| b.time);
        assert_eq!((found.value, found.error), (0.25, 1.0 / 80.0));
    }
}
