//! Why a plan makes no sense.

use thiserror::Error;
use vibroimpact::SystemError;

/// A plan that cannot be run. The sentence names the value, the allowed range and often a hint.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PlanError {
    /// The system or a start is impossible.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A range that is not `A:B:N`.
    #[error(
        "range `{given}` is not A:B:N with finite A and B and a whole N >= 1\nhint: 0.4:2:33 is 33 values from 0.4 to 2, both included"
    )]
    Range {
        /// What was typed.
        given: String,
    },
    /// A range with a number of values that is too small or too large.
    #[error("range `{given}` asks for {count} values; allowed is 1 to {most}, and 1 only when A = B")]
    Count {
        /// What was typed.
        given: String,
        /// The number of values asked for.
        count: u64,
        /// The largest number allowed.
        most: u64,
    },
    /// Neither or both of beta and its inverse.
    #[error(
        "the frequency is given {0}: exactly one of beta and inverse beta is needed\nhint: --beta B or --inverse-beta X, with X = 1/B"
    )]
    Frequency(&'static str),
    /// A number of starts that makes no sense.
    #[error("starts = {0} lies outside 1 <= starts <= 1000000000")]
    Starts(u64),
    /// A plan of a version this program does not know.
    #[error("the plan has version {0}; this program knows version {known}", known = crate::PLAN_VERSION)]
    Version(u32),
}
