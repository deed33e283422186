//! What the record of a motion needs to know of a system: of the oscillator, or of a machine.

use crate::lyapunov::{Measured, Spectrum};
use core::fmt::Debug;

/// The exponents of a measurement, and what is kept of its last part.
pub(crate) type Measurement<R> = (Spectrum<<R as Recurring>::Exponents>, <R as Recurring>::Tail);

/// A system whose motions are recorded.
pub(crate) trait Recurring: Sized {
    /// A return.
    type Return: Clone;
    /// A confirmed cycle.
    type Cycle: Clone;
    /// A measurement of the Lyapunov exponents in progress.
    type Measure: Clone;
    /// A measured number for each exponent.
    type Exponents: AsRef<[Measured]> + Clone + Debug;
    /// What is kept of the last part of a measurement.
    type Tail: Clone + Debug;

    /// The distance of two returns, relative to the motion; infinite if they are of different kinds.
    fn distance(&self, a: &Self::Return, b: &Self::Return) -> f64;
    /// The number of forcing periods in a time; 1 for any time without forcing.
    fn periods(&self, time: f64) -> f64;
    /// The cycle near a return that takes `m` returns and about this time; it may be `None` if it is unstable.
    fn cycle(&self, last: &Self::Return, m: u32, time: f64) -> Option<Self::Cycle>;
    /// Whether a cycle attracts its neighbourhood.
    fn stable(cycle: &Self::Cycle) -> bool;
    /// Whether the motion is captured by this stable cycle: it is near, and follows its linear law.
    fn captured(&self, last: &Self::Return, cycle: &Self::Cycle) -> bool;
    /// A measurement from a return on, over this number of further ones.
    fn measure(&self, from: &Self::Return, over: u32) -> Self::Measure;
    /// Adds the next return, `interval` after the last one; whether the measurement is complete.
    fn add(&self, measure: &mut Self::Measure, next: &Self::Return, interval: f64) -> bool;
    /// The number of returns that are still missing.
    fn left(measure: &Self::Measure) -> u32;
    /// The exponents so far, and whether they show chaos.
    fn chaos(&self, measure: &Self::Measure) -> Option<(Measurement<Self>, bool)>;
}
