//! Why a plan makes no sense.

use thiserror::Error;
use vibroimpact::SystemError;
use vibroimpact::verdict::LabelError;

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
    /// A number of impacts that makes no sense.
    #[error("impacts = {0} lies outside 1 <= impacts <= 10000000")]
    Impacts(u64),
    /// A number of impacts to measure over that is too small for an error bar, or too large.
    #[error(
        "impacts = {given} lies outside {least} <= impacts <= {most}\nhint: the error bar shrinks with the square root of the number; 100000 give two or three digits"
    )]
    Measured {
        /// What was asked.
        given: u64,
        /// The least allowed.
        least: u64,
        /// The most allowed.
        most: u64,
    },
    /// A number of points of a section that makes no sense.
    #[error("points = {given} lies outside 1 <= points <= {most}")]
    Points {
        /// What was asked.
        given: u64,
        /// The most allowed.
        most: u64,
    },
    /// A number of forcing periods that makes no sense.
    #[error("periods = {0} lies outside 0 < periods <= 1e9")]
    Periods(f64),
    /// A transient that is too long.
    #[error("transient = {given} lies outside 0 <= transient <= {most}")]
    Transient {
        /// What was asked.
        given: u64,
        /// The most allowed.
        most: u64,
    },
    /// A number of impacts or states to keep that makes no sense.
    #[error("keep = {given} lies outside 1 <= keep <= {most}")]
    Keep {
        /// What was asked.
        given: u64,
        /// The most allowed.
        most: u64,
    },
    /// A parameter of a second stop where there is only one.
    #[error("{0} is to vary, but there is no second stop\nhint: a second stop has a gap and a restitution of its own")]
    NoSecondStop(&'static str),
    /// More results than fit any memory.
    #[error(
        "{rows} x {columns} = {total} {what}; at most {most} are allowed\nhint: fewer values, or several smaller runs",
        total = u128::from(*rows) * u128::from(*columns)
    )]
    Size {
        /// What there would be so many of.
        what: &'static str,
        /// Values on one axis.
        columns: u64,
        /// Values on the other.
        rows: u64,
        /// The most allowed.
        most: u64,
    },
    /// Not a label.
    #[error(transparent)]
    Label(#[from] LabelError),
    /// A plan of a version this program does not know.
    #[error("the plan has version {0}; this program knows version {known}", known = crate::PLAN_VERSION)]
    Version(u32),
}
