//! The version of plans, and the largest sizes of a question.

use crate::PlanError;

/// Version of the fields of a plan. A plan of another version is refused.
pub const PLAN_VERSION: u32 = 1;

/// Maximum number of results that one run keeps in memory.
pub(crate) const MOST_CELLS: u64 = 100_000_000;
/// Maximum number of starts of one question.
pub(crate) const MOST_STARTS: u64 = 1_000_000_000;

/// Maximum number of points of a branch or curve.
pub(crate) const MOST_POINTS: u32 = 100_000;

/// Checks a largest number of points of a branch or curve.
///
/// # Errors
/// [`PlanError::BranchPoints`] unless it lies between 2 and 100 000.
pub(crate) fn branch_points(given: u32) -> Result<(), PlanError> {
    if (2..=MOST_POINTS).contains(&given) { Ok(()) } else { Err(PlanError::BranchPoints { given, most: MOST_POINTS }) }
}

/// Maximum number of points of a section, more than a figure can show.
const MOST_SECTION: u64 = 100_000;

/// Checks a number of points of a section, if any are requested.
///
/// # Errors
/// [`PlanError::Points`] unless it lies between 1 and 100 000.
pub(crate) fn section(points: Option<u64>) -> Result<(), PlanError> {
    let wrong = points.filter(|points| !(1..=MOST_SECTION).contains(points));
    wrong.map_or(Ok(()), |given| Err(PlanError::Points { given, most: MOST_SECTION }))
}

/// Checks a number of starts.
///
/// # Errors
/// [`PlanError::Starts`] if it is 0 or greater than `most`.
pub(crate) fn starts(given: u64, most: u64) -> Result<(), PlanError> {
    if (1..=most).contains(&given) { Ok(()) } else { Err(PlanError::Starts { given, most }) }
}
