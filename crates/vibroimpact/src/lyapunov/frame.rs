//! Orthonormal tangent vectors along a motion, of an oscillator or of a machine.
//!
//! They are moved by the derivative of each step and made orthonormal again; the mean logarithms of their stretches are the
//! exponents (G. Benettin, L. Galgani, A. Giorgilli and J.-M. Strelcyn, Meccanica 15 (1980) 9-20, doi:10.1007/BF02128236).
//! Lengths do not depend on units (`events::Metric`), because they count in the mean of each block and where the frame begins
//! anew.

use super::blocks::LogSum;
use crate::events::Metric;
use crate::math::add_scaled;

/// Tangent vectors, and the logarithms of their stretches.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    /// Orthonormal by the metric.
    vectors: Vec<Vec<f64>>,
    metric: Metric,
    /// The number of components of a vector.
    size: usize,
    logs: Vec<LogSum>,
    /// Which of them are minus infinity.
    lost: Vec<bool>,
}

/// By how much a vector is stretched: a factor, or its logarithm. Factors are multiplied, which saves a logarithm for each.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Stretch {
    By(f64),
    Log(f64),
}

impl Frame {
    /// The first `count` unit vectors of `size` components.
    pub(crate) fn new(size: usize, metric: Metric, count: usize) -> Self {
        let unit = |k: usize| {
            let mut vector = vec![0.0; size];
            vector[k] = 1.0;
            let length = metric.product(&vector, &vector).sqrt();
            vector[k] /= length;
            vector
        };
        Self {
            vectors: (0..count).map(unit).collect(),
            metric,
            size,
            logs: vec![LogSum::default(); count],
            lost: vec![false; count],
        }
    }

    /// Passes a step. `carry` moves the vectors and gives the stretch of each; it removes those that vanish, which are stretched by 0.
    pub(crate) fn carry<L: IntoIterator<Item = Stretch>>(
        &mut self,
        carry: impl FnOnce(&mut Vec<Vec<f64>>, &Metric) -> L,
    ) {
        let mut kept = 0;
        for (k, stretch) in carry(&mut self.vectors, &self.metric).into_iter().enumerate() {
            let vanishes = match stretch {
                Stretch::By(factor) => factor == 0.0,
                Stretch::Log(log) => log == f64::NEG_INFINITY,
            };
            if !vanishes {
                match stretch {
                    Stretch::By(factor) => self.logs[k].multiply(factor),
                    Stretch::Log(log) => self.logs[k].add(log),
                }
                // vectors that are kept close ranks, and their sums with them
                self.logs.swap(kept, k);
                self.lost.swap(kept, k);
                kept += 1;
            }
        }
        // neighbours in these directions have become the same motion: their stretches, also those before, are minus
        // infinity, and come last
        for lost in &mut self.lost[self.vectors.len()..] {
            *lost = true;
        }
        // another vector takes the place of one that is lost, so that the frame spans all directions
        while self.vectors.len() < self.logs.len() {
            let vector = self.any();
            self.vectors.push(vector);
        }
    }

    /// The logarithms of the stretches since the last call; minus infinity for a stretch by 0.
    pub(crate) fn take(&mut self) -> Vec<f64> {
        let count = self.logs.len();
        let logs = core::mem::replace(&mut self.logs, vec![LogSum::default(); count]);
        let lost = core::mem::replace(&mut self.lost, vec![false; count]);
        logs.into_iter().zip(lost).map(|(log, lost)| if lost { f64::NEG_INFINITY } else { log.value() }).collect()
    }

    /// Any direction that is orthogonal to the vectors.
    fn any(&self) -> Vec<f64> {
        let mut best = (0.0, vec![0.0; self.size]);
        for i in 0..self.size {
            let mut unit = vec![0.0; self.size];
            unit[i] = 1.0;
            let length = self.metric.product(&unit, &unit).sqrt();
            let left = self.orthonormal(&mut unit) / length;
            if left > best.0 {
                best = (left, unit);
            }
        }
        best.1
    }

    /// Makes a vector orthogonal to the others and of length 1; returns its length before.
    fn orthonormal(&self, vector: &mut [f64]) -> f64 {
        // twice, because once leaves rounding errors of the original length
        for _ in 0..2 {
            for other in &self.vectors {
                add_scaled(vector, -self.metric.product(other, vector), other);
            }
        }
        let length = self.metric.product(vector, vector).sqrt();
        if length > 0.0 {
            vector.iter_mut().for_each(|x| *x /= length);
        }
        length
    }
}
