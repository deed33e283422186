//! What the record of a motion needs to know of a system: of the oscillator, or of a machine.

use super::outcome::System;
use crate::lyapunov::{Spectrum, Tail};
use core::fmt::Debug;

/// What verdicts on the motions consist of.
pub(crate) type SystemOf<R> = <R as Recurring>::System;
/// A cycle of the system.
pub(crate) type CycleOf<R> = <SystemOf<R> as System>::Cycle;
/// The exponents of a measurement, and what is kept of its last part.
pub(crate) type Measurement<R> = (Spectrum<<SystemOf<R> as System>::Exponents>, <R as Recurring>::MeasuredTail);

/// A system whose motions are recorded.
pub(crate) trait Recurring: Sized {
    /// What verdicts on its motions consist of.
    type System: System;
    /// Whether chaos is shown only at the end of the budget: that of a machine is often a transient of thousands of events.
    const LASTING: bool;
    /// A return.
    type Return: Clone;
    /// A measurement of the Lyapunov exponents in progress.
    type Measure: Clone;
    /// What is kept of the last part of a measurement.
    type MeasuredTail: Clone + Debug;

    /// The distance of two returns, relative to the motion; infinite if they are of different kinds.
    fn distance(&self, a: &Self::Return, b: &Self::Return) -> f64;
    /// The number of forcing periods in a time; 1 for any time without forcing.
    fn periods(&self, time: f64) -> f64;
    /// The cycle near a return that takes `m` returns and about this time; it may be `None` if it is unstable.
    fn cycle(&self, last: &Self::Return, m: u32, time: f64) -> Option<CycleOf<Self>>;
    /// Whether a cycle attracts its neighbourhood.
    fn stable(cycle: &CycleOf<Self>) -> bool;
    /// Whether the motion is captured by this stable cycle: it is near, and follows its linear law.
    fn captured(&self, last: &Self::Return, cycle: &CycleOf<Self>) -> bool;
    /// A measurement from a return on, over this number of further ones.
    fn measure(&self, from: &Self::Return, over: u32) -> Self::Measure;
    /// Adds the next return, `interval` after the last one; whether the measurement is complete.
    fn add(&self, measure: &mut Self::Measure, next: &Self::Return, interval: f64) -> bool;
    /// The number of returns that are still missing.
    fn left(measure: &Self::Measure) -> u32;
    /// The exponents so far, and whether they show chaos.
    fn chaos(&self, measure: &Self::Measure) -> Option<(Measurement<Self>, bool)>;
    /// The tail of a chaotic motion with these latest returns.
    fn tail(
        measured: Self::MeasuredTail,
        returns: &[(Self::Return, f64)],
    ) -> Option<Tail<<Self::System as System>::State>>;
}
