//! What decides more, where motions are undecided.

use vibroimpact::verdict::{SettleOptions, Undecided, UndecidedCause, Verdict};
use vibroimpact_report::AnswerOf;
use vibroimpact_study::{Results, SystemPlan, Task};

/// The largest budget of impacts.
const MOST: u32 = 1_000_000;
/// The largest number of impacts of a measurement of exponents.
const MOST_MEASURED: u64 = 10_000_000;
/// The label of an undecided motion in a map and in a response, which keep labels only.
const LABEL: &str = "undecided";

/// The flag that decides more of the undecided motions; `None` if there are none, or if more impacts would not help.
pub(super) fn hint(answer: &AnswerOf<SystemPlan>) -> Option<String> {
    let (budget, several) = match &answer.plan.task {
        Task::Settle { impacts, .. } => (*impacts, false),
        Task::Attractors { impacts, .. } => (*impacts, true),
        Task::Basin(task) => (task.impacts, true),
        Task::Map(task) => (task.impacts, true),
        Task::Response(task) => (task.impacts, true),
        Task::Lyapunov(task) => {
            let open = matches!(&answer.results, Results::Lyapunov(found, _) if unsettled(&found.motion));
            let (impacts, _) = task.lengths();
            let longer = impacts.saturating_mul(10).min(MOST_MEASURED);
            return (open && longer > impacts).then(|| format!("--impacts {longer} measures over more impacts"));
        }
        _ => return None,
    };
    let open = match &answer.results {
        Results::Settle(found) => unsettled(&found.verdict),
        Results::Attractors(found) => found.motions().iter().any(|motion| unsettled(&motion.verdict)),
        Results::Basin(found) => found.motions.iter().any(|motion| unsettled(&motion.verdict)),
        Results::Map(found) => found.motions().any(|motion| motion.label == LABEL),
        Results::Response(found) => found.up.iter().chain(&found.down).any(|motion| motion.label == LABEL),
        _ => false,
    };
    let longer = longer(budget)?;
    let what = if several { "follows the undecided motions further" } else { "follows the motion further" };
    open.then(|| format!("--impacts {longer} {what}"))
}

/// Whether the impacts of its budget were too few for a motion. A search for one contact is not longer with more impacts.
const fn unsettled(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Undecided(Undecided { why: UndecidedCause::Budget, .. }))
}

/// A larger budget than the one used, if there is one.
fn longer(used: Option<u32>) -> Option<u32> {
    let usual = SettleOptions::default().max_impacts;
    let used = used.unwrap_or(usual);
    let next = if used < usual { usual } else { used.saturating_mul(5).min(MOST) };
    (next > used).then_some(next)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_larger_budget_up_to_the_largest() {
        assert_eq!(
            [None, Some(50), Some(20_000), Some(300_000), Some(MOST)].map(longer),
            [Some(100_000), Some(20_000), Some(100_000), Some(MOST), None]
        );
    }
}
