//! Lyapunov exponents along the motion of a machine.
//!
//! A frame of $`2n`$ orthonormal tangent vectors is moved by the derivative of each step and made orthonormal again; the
//! mean logarithms of the lengths are the exponents (G. Benettin, L. Galgani, A. Giorgilli and J.-M. Strelcyn, Meccanica
//! 15 (1980) 9-20, doi:10.1007/BF02128236). The error bar is three standard errors of the mean of 25 blocks. Lengths do not
//! depend on units (`events::Metric`), because they count in the mean of each block and where the frame begins anew.

use super::measure::{LogSum, mean};
use super::{Measured, TRANSIENT};
use crate::events::Metric;
use crate::math::{Wide, add_scaled, sort_by};

/// The Lyapunov exponents of a motion of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineSpectrum {
    /// All $`2n`$ exponents per unit of time, the largest first. Minus infinity where neighbouring motions become the same.
    pub exponents: Vec<Measured>,
    /// Closings of stops per unit of time.
    pub closings: Measured,
    /// The time of the run.
    pub time: f64,
}

impl MachineSpectrum {
    /// Whether neighbours separate: the largest exponent exceeds its error bar.
    #[must_use]
    pub fn diverges(&self) -> bool {
        self.exponents.first().is_some_and(|first| first.value > first.error)
    }

    /// Whether neighbours separate, over the whole run, by more than is possible on the way from an unstable cycle to a
    /// stable one.
    #[must_use]
    pub fn chaotic(&self) -> bool {
        self.diverges() && self.exponents.first().is_some_and(|first| first.value * self.time > TRANSIENT)
    }
}

/// The number of blocks of the run, and the smallest number from which a standard error is computed.
const BLOCKS: usize = 25;
const FEWEST: usize = 5;

/// A measurement in progress; steps are added one by one.
#[derive(Clone, Debug)]
pub(crate) struct MachineMeasure {
    /// Orthonormal tangent vectors, by the metric.
    frame: Vec<Vec<f64>>,
    metric: Metric,
    size: usize,
    logs: Vec<LogSum>,
    /// Which of them are minus infinity in this block.
    lost: Vec<bool>,
    per_block: u32,
    count: u32,
    closings: f64,
    time: Wide,
    blocks: Vec<Block>,
}

/// The sums over a block.
#[derive(Clone, Debug)]
struct Block {
    logs: Vec<f64>,
    closings: f64,
    time: f64,
}

impl MachineMeasure {
    /// A measurement over this number of steps, of `exponents` exponents in a state of `size` components with lengths by a metric.
    pub(crate) fn new((size, metric): (usize, Metric), exponents: usize, steps: u32) -> Self {
        let unit = |k: usize| {
            let mut vector = vec![0.0; size];
            vector[k] = 1.0;
            let length = metric.product(&vector, &vector).sqrt();
            vector[k] /= length;
            vector
        };
        Self {
            frame: (0..exponents).map(unit).collect(),
            metric,
            size,
            logs: vec![LogSum::default(); exponents],
            lost: vec![false; exponents],
            per_block: (steps / 25).max(1),
            count: 0,
            closings: 0.0,
            time: Wide::default(),
            blocks: Vec::new(),
        }
    }

    /// The number of steps that are still missing.
    pub(crate) fn left(&self) -> u32 {
        let blocks = u32::try_from(BLOCKS.saturating_sub(self.blocks.len())).unwrap_or(0);
        (blocks * self.per_block).saturating_sub(self.count)
    }

    /// Whether all steps have been added.
    pub(crate) fn complete(&self) -> bool {
        self.blocks.len() >= BLOCKS
    }

    /// Adds a step with this time and number of closings. `carry` moves the frame of tangent vectors and says by how much each
    /// is stretched; it leaves out those that vanish, whose logarithms are minus infinity.
    pub(crate) fn add(
        &mut self,
        carry: impl FnOnce(&mut Vec<Vec<f64>>, &Metric) -> Vec<f64>,
        time: f64,
        closings: f64,
    ) {
        let mut last = 0;
        for (k, log) in carry(&mut self.frame, &self.metric).into_iter().enumerate() {
            if log > f64::NEG_INFINITY {
                self.logs[k].add(log);
                self.logs.swap(last, k);
                self.lost.swap(last, k);
                last += 1;
            }
        }
        // neighbours in these directions have become the same motion: their stretches, also those before, are minus
        // infinity, and come last
        let kept = self.frame.len();
        for lost in &mut self.lost[kept..] {
            *lost = true;
        }
        while self.frame.len() < self.logs.len() {
            let vector = self.any();
            self.frame.push(vector);
        }
        self.time += time;
        self.closings += closings;
        self.count += 1;
        if self.count == self.per_block {
            let logs = core::mem::replace(&mut self.logs, vec![LogSum::default(); self.frame.len()]);
            let lost = core::mem::replace(&mut self.lost, vec![false; logs.len()]);
            let value = |(log, lost): (LogSum, bool)| if lost { f64::NEG_INFINITY } else { log.value() };
            let logs = logs.into_iter().zip(lost).map(value).collect();
            self.blocks.push(Block { logs, closings: self.closings, time: self.time.value() });
            (self.count, self.closings, self.time) = (0, 0.0, Wide::default());
        }
    }

    /// Makes a vector orthogonal to the frame and of length 1; returns its length before.
    fn orthonormal(&self, vector: &mut [f64]) -> f64 {
        // twice, because once leaves rounding errors of the original length
        for _ in 0..2 {
            for other in &self.frame {
                add_scaled(vector, -self.metric.product(other, vector), other);
            }
        }
        let length = self.metric.product(vector, vector).sqrt();
        if length > 0.0 {
            vector.iter_mut().for_each(|x| *x /= length);
        }
        length
    }

    /// Any direction that is orthogonal to the frame.
    fn any(&self) -> Vec<f64> {
        let mut best = (0.0, vec![0.0; self.size]);
        for i in 0..self.size {
            let mut unit = vec![0.0; self.size];
            unit[i] = 1.0;
            let whole = self.metric.product(&unit, &unit).sqrt();
            let length = self.orthonormal(&mut unit) / whole;
            if length > best.0 {
                best = (length, unit);
            }
        }
        best.1
    }

    /// The exponents of all complete blocks; `None` if there are too few.
    pub(crate) fn spectrum(&self) -> Option<MachineSpectrum> {
        if self.blocks.len() < FEWEST {
            return None;
        }
        let of = |value: &dyn Fn(&Block) -> f64| {
            let values: Vec<(f64, f64)> =
                self.blocks.iter().map(|block| (value(block) / block.time, block.time)).collect();
            if values.iter().any(|(value, _)| !value.is_finite()) {
                return Measured {
                    value: values.iter().fold(f64::INFINITY, |least, (v, _)| least.min(*v)),
                    error: 0.0,
                };
            }
            mean(&values)
        };
        let mut exponents: Vec<Measured> = (0..self.frame.len()).map(|k| of(&|block| block.logs[k])).collect();
        sort_by(&mut exponents, |a, b| b.value.total_cmp(&a.value));
        let time = self.blocks.iter().map(|block| block.time).sum();
        Some(MachineSpectrum { exponents, closings: of(&|block| block.closings), time })
    }

    /// The exponents, and whether the motion is chaotic by this measurement: it is by the whole, and in its last fifth the
    /// direction of the largest exponent diverges too. That need not be the first one: in a machine of independent parts each direction
    /// of the frame stays in its part.
    pub(crate) fn chaos(&self) -> Option<(MachineSpectrum, bool)> {
        let spectrum = self.spectrum()?;
        let over =
            |k: usize, count: usize| self.blocks.iter().rev().take(count).map(|block| block.logs[k]).sum::<f64>();
        let largest = (0..self.frame.len()).max_by(|a, b| over(*a, BLOCKS).total_cmp(&over(*b, BLOCKS)));
        let chaotic = spectrum.chaotic() && largest.is_some_and(|k| over(k, FEWEST) > 0.0);
        Some((spectrum, chaotic))
    }
}
