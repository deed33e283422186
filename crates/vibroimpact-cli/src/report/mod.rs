//! Answers as text. JSON, tables and figures are made by `vibroimpact-report`.

mod attractors;
mod basin;
mod branch;
mod certainty;
mod curve;
mod diagram;
mod edge;
mod leading;
mod lyapunov;
pub(crate) mod machine;
mod map;
mod margins;
mod motion;
mod orbit;
mod region;
mod remarks;
mod response;
mod settle;
mod simulate;
pub(crate) mod status;
pub(crate) mod stored;
pub(crate) mod tallies;
mod undecided;
pub(crate) mod words;

use crate::failure::Failure;
use motion::Teller;
use vibroimpact::events::End;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Undecided, UndecidedCause, Verdict};
use vibroimpact_report::{Answer, AnswerOf, Varied};
use vibroimpact_study::{Name, Results, SEARCH_LIMIT, Task};

/// The text that a command prints, unless JSON or a table on stdout was requested.
pub(crate) fn text(answer: &Answer) -> Result<String, Failure> {
    match answer {
        Answer::Oscillator(answer) => text_of(answer),
        Answer::Machine(answer) => text_of(answer),
    }
}

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

fn text_of<D: Teller>(of: &AnswerOf<D>) -> Result<String, Failure> {
    let (units, machine) = (&of.units, D::machine(of));
    let text = match &of.results {
        Results::Simulate(found) => D::simulated(of, found),
        Results::Settle(found) => settle::text(of, found),
        Results::Attractors(found) => attractors::text(of, found),
        Results::Orbit(found) => orbit::text(of, found),
        Results::Basin(found) => basin::text(of, found),
        Results::Map(found) => {
            // points that are no grid have one start each
            let starts = if let Task::Map(task) = &of.plan.task { task.starts } else { 1 };
            let seen = if machine.is_some() { map::seen(found) } else { String::new() };
            map::text(found, starts, D::two_stops(of)) + &seen
        }
        Results::Diagram(found) => diagram::text(found, units),
        Results::Lyapunov(found, _) => lyapunov::text(of, found),
        Results::Branch(found) => branch::text(&of.branches_in_words(found)?, machine, (&of.cut()?, units)),
        Results::Curve(found) => curve::text(&of.curve(found)?, (&of.curve_plan()?, units)),
        Results::Region(found) => {
            let plan = of.region_plan()?;
            region::text(found, &plan, (plan.neutral(&of.written), D::in_closed_form(&plan)), units)
        }
        Results::Response(found) => {
            let vary = if let Task::Response(task) = &of.plan.task { task.vary.text() } else { "" };
            response::text(&D::response(of, found)?, &D::Name::of(vary)?.words(units))
        }
        Results::Margins(found) => margins::text(of, found),
        Results::Edge(found) => edge::text(of, found),
    };
    Ok(D::heading(of) + &text)
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
