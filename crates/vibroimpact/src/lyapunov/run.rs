//! A measurement of exponents in progress, of an oscillator or of a machine; steps are added one by one.

use super::blocks::{BLOCKS, Block, FEWEST_BLOCKS, VERDICT_BLOCKS, quotient};
use super::frame::Frame;
use super::{Measured, Spectrum};
use crate::math::sort_by;

/// A transient, and a measurement after it in blocks of equal numbers of steps.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// The tangent vectors at the beginning, and now.
    begin: Frame,
    frame: Frame,
    pub(crate) transient: u64,
    steps: u64,
    /// The number of blocks of the whole measurement.
    parts: u64,
    /// The number of steps since the beginning of the transient.
    passed: u64,
    block: Block,
    pub(crate) blocks: Vec<Block>,
}

impl Run {
    /// The measurement of exponents to report, over `steps` steps after a transient.
    pub(crate) fn new(frame: Frame, transient: u64, steps: u64) -> Self {
        Self::with_blocks(frame, (transient, steps.max(1)), BLOCKS)
    }

    /// The measurement for a verdict, over about `steps` steps from now on.
    pub(crate) fn for_verdict(frame: Frame, steps: u64) -> Self {
        Self::with_blocks(frame, (0, (steps / VERDICT_BLOCKS).max(1) * VERDICT_BLOCKS), VERDICT_BLOCKS)
    }

    fn with_blocks(frame: Frame, (transient, steps): (u64, u64), blocks: u64) -> Self {
        Self {
            begin: frame.clone(),
            frame,
            transient,
            steps,
            parts: blocks.min(steps),
            passed: 0,
            block: Block::default(),
            blocks: Vec::new(),
        }
    }

    /// Adds a step. `carry` moves the tangent vectors and returns the logarithm of the exact change of volume, or NaN if it is
    /// not known.
    pub(crate) fn add(&mut self, carry: impl FnOnce(&mut Frame) -> f64, time: f64, impacts: f64) {
        let volume = carry(&mut self.frame);
        self.passed += 1;
        let Some(measured) = self.measured().filter(|measured| *measured > 0) else {
            // the stretches of the transient are discarded
            if self.passed == self.transient {
                self.frame.take();
            }
            return;
        };
        self.block.volume += volume;
        self.block.time += time;
        self.block.impacts += impacts;
        // blocks of equal length, to within one step, that fill the run
        let end = u128::from(self.steps) * (self.blocks.len() as u128 + 1) / u128::from(self.parts);
        if u128::from(measured) >= end {
            let block = core::mem::take(&mut self.block);
            self.blocks.push(Block { stretch: self.frame.take(), ..block });
        }
    }

    /// The number of steps that have been measured; `None` during the transient.
    pub(crate) const fn measured(&self) -> Option<u64> {
        self.passed.checked_sub(self.transient)
    }

    /// The number of steps that are still missing after the transient.
    pub(crate) fn left(&self) -> u64 {
        self.steps.saturating_sub(self.measured().unwrap_or(0))
    }

    /// Whether all steps have been added.
    pub(crate) fn complete(&self) -> bool {
        self.blocks.len() as u64 >= self.parts
    }

    /// Begins the transient again.
    pub(crate) fn begin_again(&mut self) {
        (self.frame, self.passed, self.block) = (self.begin.clone(), 0, Block::default());
        self.blocks.clear();
    }

    /// The exponents of all complete blocks, the largest first, each with an error of at least `least` in its stretch; and the
    /// blocks, whose stretches have the same order. `None` if there are too few.
    pub(crate) fn spectrum(&self, least: f64) -> Option<(Spectrum<Vec<Measured>>, Vec<Block>)> {
        if self.blocks.len() < FEWEST_BLOCKS.min(usize::try_from(self.parts).unwrap_or(usize::MAX)) {
            return None;
        }
        let rate = |least: f64, of: &dyn Fn(&Block) -> f64| quotient(&self.blocks, least, of, |block| block.time);
        let directions = 0..self.blocks.first()?.stretch.len();
        let mut exponents: Vec<(usize, Measured)> =
            directions.map(|k| (k, rate(least, &|block| block.stretch[k]))).collect();
        sort_by(&mut exponents, |(_, a), (_, b)| b.value.total_cmp(&a.value));
        // the stretches of the blocks in the same order
        let sorted = |block: &Block| exponents.iter().map(|(k, _)| block.stretch[*k]).collect();
        let blocks = self.blocks.iter().map(|block| Block { stretch: sorted(block), ..block.clone() }).collect();
        let impact_rate = rate(0.0, &|block| block.impacts);
        let time = self.blocks.iter().map(|block| block.time).sum();
        let exponents = exponents.into_iter().map(|(_, of)| of).collect();
        Some((Spectrum { exponents, impact_rate, time }, blocks))
    }

    /// The exponents, and whether the motion is chaotic by this measurement: it is by the whole, and in its last fifth the
    /// direction of the largest exponent diverges too. That need not be the first vector: in a machine of independent parts each
    /// vector stays in its part.
    pub(crate) fn chaos(&self) -> Option<(Spectrum<Vec<Measured>>, bool)> {
        let (spectrum, blocks) = self.spectrum(0.0).filter(|(_, blocks)| blocks.len() >= FEWEST_BLOCKS)?;
        let last: f64 = blocks.iter().rev().take(FEWEST_BLOCKS).map(|block| block.stretch[0]).sum();
        let chaotic = spectrum.chaotic() && last > 0.0;
        Some((spectrum, chaotic))
    }
}
