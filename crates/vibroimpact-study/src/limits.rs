//! The version of plans, and the most that one question may ask for.

use crate::PlanError;

/// Version of the plan's fields; a plan of a later version is refused.
pub const PLAN_VERSION: u32 = 1;

/// The most results one run keeps in memory.
pub(crate) const MOST_CELLS: u64 = 100_000_000;
/// Starts of one question.
pub(crate) const MOST_STARTS: u64 = 1_000_000_000;

/// Checks a number of starts.
///
/// # Errors
/// [`PlanError::Starts`] for none, or more than `most`.
pub(crate) fn starts(given: u64, most: u64) -> Result<(), PlanError> {
    if (1..=most).contains(&given) { Ok(()) } else { Err(PlanError::Starts { given, most }) }
}
