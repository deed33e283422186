//! Answers as text. JSON, tables and figures are made by `vibroimpact-report`.

mod attractors;
mod basin;
mod branch;
mod certainty;
mod curve;
mod diagram;
mod leading;
mod lyapunov;
pub(crate) mod machine;
pub(crate) mod machine_answers;
pub(crate) mod machine_curve;
pub(crate) mod machine_events;
mod map;
mod margins;
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
mod words;

use crate::failure::Failure;
use vibroimpact_report::Answer;
use vibroimpact_report::response::ResponseView;
use vibroimpact_study::{Results, Task};

/// The text that a command prints, unless JSON or a table on stdout was requested.
pub(crate) fn text(answer: &Answer) -> Result<String, Failure> {
    let Answer { plan, asked, osc, results, paper_rule } = answer;
    let units = &asked.units;
    let system = || words::system(asked, osc) + "\n";
    let from = |start| words::system(asked, osc) + &words::start(start, units);
    Ok(match (&plan.task, results) {
        (_, Results::Simulate(start, found)) => from(start) + &simulate::text(found, asked),
        (_, Results::Settle(start, found)) => from(start) + "\n" + &settle::text(found, *paper_rule, osc, units),
        (Task::Attractors { starts, .. }, Results::Attractors(found)) => {
            words::system(asked, osc) + &attractors::text(found, *starts, osc, units)
        }
        (Task::Orbit { label }, Results::Orbit(found)) => system() + &orbit::text(found, label, osc, units),
        (_, Results::Basin(found)) => system() + &basin::text(found, osc),
        (_, Results::Map(found)) => map::text(found, plan.system.second_stop.is_some()),
        (_, Results::Diagram(found)) => diagram::text(found, units),
        (_, Results::Lyapunov(start, found, _)) => from(start) + "\n" + &lyapunov::text(found, osc.period(), units),
        (Task::Branch(task), Results::Branch(found)) => {
            system() + &branch::text(found, &task.cut(&asked.system)?, units)
        }
        (Task::Curve(task), Results::Curve(found)) => system() + &curve::text(found, task, units),
        (Task::Region(task), Results::Region(found)) => region::text(found, task, asked),
        (Task::Response(task), Results::Response(found)) => {
            response::text(&ResponseView::of_oscillator(found, task, units), &branch::named(task.vary, units))
        }
        (_, Results::Margins(found)) => match &found.start {
            Some(start) => from(start) + "\n" + &margins::text(found, osc, units),
            None => system() + &margins::text(found, osc, units),
        },
        _ => return Err(Failure::Failed("the results belong to another task than the plan's".into())),
    })
}

/// Hints for the next command.
pub(crate) fn hints(answer: &Answer) -> Vec<String> {
    let next = match answer.results {
        Results::Settle(..) => Some("`vibro attractors` shows what other starts lead to"),
        Results::Attractors(_) => {
            Some("--json has the impacts of each motion; `vibro basin` shows where they start from")
        }
        Results::Basin(_) => Some("--csv FILE keeps every start, --plot FILE.png draws them"),
        Results::Map(_) | Results::Diagram(_) => Some("--csv FILE keeps every point, --plot FILE.png draws them"),
        Results::Lyapunov(_, _, None) => {
            Some("--plot FILE.png draws the attractor; a longer --impacts narrows the error bars")
        }
        _ => None,
    };
    undecided::hint(answer).into_iter().chain(next.map(str::to_owned)).collect()
}
