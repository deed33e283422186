//! Texts about stores and machines, and hints for the next command. Answers are told by `vibroimpact-report`.

pub(crate) mod machine;
mod remarks;
pub(crate) mod status;
pub(crate) mod stored;
pub(crate) mod tallies;
mod undecided;

use vibroimpact::events::End;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Undecided, UndecidedCause, Verdict};
use vibroimpact_report::Answer;
use vibroimpact_study::{Results, SEARCH_LIMIT};

/// Whether the motion is not known to its end, because a search for the next event used all its steps.
pub(crate) fn ended_by_search(answer: &Answer) -> bool {
    let ended = |verdict: &Verdict<Machine>| {
        matches!(verdict, Verdict::Undecided(Undecided { why: UndecidedCause::Ended(End::SearchLimit), .. }))
    };
    match answer {
        Answer::Oscillator(answer) => {
            matches!(&answer.results, Results::Simulate(found) if found.reason == SEARCH_LIMIT)
        }
        Answer::Machine(answer) => match &answer.results {
            Results::Simulate(found) => found.reason == SEARCH_LIMIT,
            Results::Settle(found) => ended(&found.verdict),
            Results::Lyapunov(found, _) => ended(&found.motion),
            _ => false,
        },
    }
}

/// Hints for the next command.
pub(crate) fn hints(answer: &Answer) -> Vec<String> {
    let Answer::Oscillator(answer) = answer else { return Vec::new() };
    let next = match answer.results {
        Results::Settle(..) => Some("`vibro attractors` shows what other starts lead to"),
        Results::Attractors(_) => {
            Some("--json has the impacts of each motion; `vibro basin` shows where they start from")
        }
        Results::Basin(_) => Some("--csv FILE keeps every start, --plot FILE.png draws them"),
        Results::Map(_) | Results::Diagram(_) => Some("--csv FILE keeps every point, --plot FILE.png draws them"),
        Results::Lyapunov(_, None) => {
            Some("--plot FILE.png draws the attractor; a longer --impacts narrows the error bars")
        }
        _ => None,
    };
    undecided::hint(answer).into_iter().chain(next.map(str::to_owned)).collect()
}
