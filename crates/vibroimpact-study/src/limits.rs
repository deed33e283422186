//! The version of plans, and the largest sizes of a question.

use crate::PlanError;
use core::fmt::Display;
use core::ops::RangeInclusive;

/// Version of the fields of a plan. A plan of another version is refused.
pub const PLAN_VERSION: u32 = 1;

/// Maximum number of results that one run keeps in memory.
pub(crate) const MOST_CELLS: u64 = 100_000_000;
/// Maximum number of starts of one question.
pub(crate) const MOST_STARTS: u64 = 1_000_000_000;

/// Maximum number of points of a branch or curve.
pub(crate) const MOST_POINTS: u32 = 100_000;

/// Checks that a number lies in its range.
pub(crate) fn check<T: PartialOrd + Display + Copy>(
    name: &'static str,
    given: T,
    range: RangeInclusive<T>,
) -> Result<(), PlanError> {
    if range.contains(&given) { Ok(()) } else { Err(PlanError::outside(name, given, (*range.start(), *range.end()))) }
}

/// The same of a number that may be absent.
pub(crate) fn given<T: PartialOrd + Display + Copy>(
    name: &'static str,
    given: Option<T>,
    range: RangeInclusive<T>,
) -> Result<(), PlanError> {
    given.map_or(Ok(()), |given| check(name, given, range))
}

/// Checks a largest number of points of a branch or curve.
pub(crate) fn branch_points(given: u32) -> Result<(), PlanError> {
    check("points", given, 2..=MOST_POINTS)
}

/// Maximum number of points of a section, more than a figure can show.
const MOST_SECTION: u64 = 100_000;

/// Checks a number of points of a section, if any are requested.
pub(crate) fn section(points: Option<u64>) -> Result<(), PlanError> {
    given("points", points, 1..=MOST_SECTION)
}

/// Checks a number of starts.
pub(crate) fn starts(given: u64, most: u64) -> Result<(), PlanError> {
    check("starts", given, 1..=most)
}

/// Checks the impacts of a measurement of exponents, and those to pass before.
pub(crate) fn measured(
    impacts: Option<u64>,
    range: RangeInclusive<u64>,
    transient: Option<u64>,
) -> Result<(), PlanError> {
    const HINT: &str =
        "\nhint: the error bar shrinks with the square root of the number; 100000 give two or three digits";
    given("impacts", impacts, range).map_err(|error| error.hinted(HINT))?;
    given("transient", transient, 0..=MOST_TRANSIENT)
}

/// Maximum number of impacts or periods of a transient; it takes a few seconds for each value.
pub(crate) const MOST_TRANSIENT: u64 = 1_000_000;
