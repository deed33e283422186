//! How a branch is followed, and why it cannot begin.

use crate::continuation::trace::step_length::StepLength;
use core::ops::RangeInclusive;
use thiserror::Error;

/// The direction in which the parameter changes at first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The parameter increases.
    Up,
    /// The parameter decreases.
    Down,
}

/// Step lengths and limits of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchOptions {
    /// The longest step. Its length combines the change of all phases in radians, of the speeds, and of the parameter
    /// in quarters of its range.
    pub longest: f64,
    /// The length of the first step, also after a grazing event.
    pub first: f64,
    /// The branch ends if a step would have to be shorter than this.
    pub shortest: f64,
    /// The largest number of points.
    pub points: u32,
    /// The largest number of impacts of a cycle that does not stick. Towards a complete chatter the number grows
    /// without bound.
    pub impacts: u32,
    /// Whether the signature is kept at grazing events, so that the branch continues through inadmissible solutions.
    pub keep_signature: bool,
}

impl Default for BranchOptions {
    /// Steps up to 0.05, beginning with 0.002, never below 1e-9; 20 000 points, 32 impacts; the signature changes at
    /// grazing events.
    fn default() -> Self {
        Self { longest: 0.05, first: 2e-3, shortest: 1e-9, points: 20_000, impacts: 32, keep_signature: false }
    }
}

impl BranchOptions {
    /// The length of the first step.
    pub(crate) const fn first_step(&self) -> StepLength {
        StepLength { now: self.first, longest: self.longest, shortest: self.shortest }
    }
}

/// The change of a number that has the same length as a change of all phases by one radian: a quarter of the range.
///
/// # Errors
/// [`BranchError::OutOfRange`] if the range is invalid or does not contain `value`.
pub(crate) fn scale(range: &RangeInclusive<f64>, value: f64) -> Result<f64, BranchError> {
    let (low, high) = (*range.start(), *range.end());
    if !(low.is_finite() && high.is_finite() && low < high && range.contains(&value)) {
        return Err(BranchError::OutOfRange { value, low, high });
    }
    Ok(0.25 * (high - low))
}

/// Why a branch or a curve cannot begin.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BranchError {
    /// The parameter belongs to the second stop, but there is only one stop.
    #[error("{0} is a parameter of the second stop, and there is only one stop")]
    NoSuchParameter(&'static str),
    /// The range is not two finite numbers in increasing order, or the value at which the branch begins lies outside.
    #[error("the branch or curve begins at {value}, which does not lie in the range from {low} to {high}")]
    OutOfRange {
        /// The value at which it begins.
        value: f64,
        /// Lower end of the range.
        low: f64,
        /// Upper end of the range.
        high: f64,
    },
    /// A cycle that sticks is determined by its release and has no equations that could be followed over two
    /// parameters.
    #[error(
        "a cycle that rests on a stop has no equations to be followed over two parameters: its release determines it at each value anew\nhint: in one parameter it has a branch"
    )]
    Rests,
    /// The motion without impacts of an oscillator without damping.
    #[error(
        "without damping the steady motion without impacts is one of many and cannot be followed\nhint: a damping above 0, or a branch from 1/1 towards it"
    )]
    Undamped,
    /// Newton's method does not converge from the cycle at these parameters, or the curve has no single tangent there; or
    /// the cycle of a machine has no events.
    #[error(
        "the orbit cannot be followed from here: it has no events, or its equations have no solution close by, or no single curve of them\nhint: begin a little beside a fold, a branch point or a grazing contact"
    )]
    NoCycle,
    /// The event at this point is not one at which the requested branch or curve begins.
    #[error(
        "what happens at this point begins no branch and no curve of that kind\nhint: branches begin at flips and branch points; curves go through folds, flips, torus bifurcations, grazing, loss of contact, corners, and where sticking or holding begins or ends at a limit"
    )]
    NotThere,
}
