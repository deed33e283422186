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
use vibroimpact::events::End;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Undecided, UndecidedCause, Verdict};
use vibroimpact_report::answer::machine::Answer as MachineAnswer;
use vibroimpact_report::answer::oscillator;
use vibroimpact_report::response::ResponseView;
use vibroimpact_report::{Answer, Units, Varied};
use vibroimpact_study::machine::Results as MachineResults;
use vibroimpact_study::{Name, Parameter, RegionPlan, Results, SEARCH_LIMIT, Task};

/// The text that a command prints, unless JSON or a table on stdout was requested.
pub(crate) fn text(answer: &Answer) -> Result<String, Failure> {
    match answer {
        Answer::Oscillator(answer) => of_oscillator(answer),
        Answer::Machine(answer) => of_machine(answer),
    }
}

/// Whether the motion is not known to its end, because a search for the next event used all its steps.
pub(crate) fn ended_by_search(answer: &Answer) -> bool {
    let ended = |verdict: &Verdict<Machine>| {
        matches!(verdict, Verdict::Undecided(Undecided { why: UndecidedCause::Ended(End::SearchLimit), .. }))
    };
    match answer {
        Answer::Oscillator(answer) => {
            matches!(&answer.results, Results::Simulate(_, found) if found.reason == SEARCH_LIMIT)
        }
        Answer::Machine(answer) => match &answer.results {
            MachineResults::Simulate(found) => found.reason == SEARCH_LIMIT,
            MachineResults::Settle(found) => ended(&found.verdict),
            MachineResults::Lyapunov(found, _) => ended(&found.motion),
            _ => false,
        },
    }
}

fn of_oscillator(answer: &oscillator::Answer) -> Result<String, Failure> {
    let oscillator::Answer { asked, osc, results, paper_rule, plan } = answer;
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
        (Task::Map(task), Results::Map(found)) => map::text(found, task.starts, asked.system.second_stop.is_some()),
        (_, Results::Diagram(found)) => diagram::text(found, units),
        (_, Results::Lyapunov(start, found, _)) => from(start) + "\n" + &lyapunov::text(found, osc.period(), units),
        (_, Results::Branch(found)) => {
            system() + &branch::text(&answer.branches(found)?, None, (&answer.cut()?, units))
        }
        (_, Results::Curve(found)) => system() + &curve::text(&answer.curve(found)?, (&answer.curve_plan()?, units)),
        (Task::Region(task), Results::Region(found)) => {
            let task: RegionPlan = task.typed()?;
            region::text(found, &task, (task.neutral(&asked.system), region::in_closed_form(&task)), units)
        }
        (Task::Response(task), Results::Response(found)) => response::text(
            &ResponseView::of_oscillator(found, task, units)?,
            &Parameter::of(task.vary.text())?.words(units),
        ),
        (_, Results::Margins(Some(start), found)) => from(start) + "\n" + &margins::text(found, osc, units),
        (_, Results::Margins(None, found)) => system() + &margins::text(found, osc, units),
        _ => return Err(Failure::Failed("the results belong to another task than the plan's".into())),
    })
}

/// The same of a machine.
fn of_machine(answer: &MachineAnswer) -> Result<String, Failure> {
    let MachineAnswer { plan, machine, results, source, .. } = answer;
    Ok(match (&plan.task, results) {
        (Task::Simulate { periods, .. }, MachineResults::Simulate(found)) => {
            simulate::of_machine(found, *periods, machine)
        }
        (_, MachineResults::Settle(found)) => settle::of_machine(found, machine),
        (_, MachineResults::Attractors(found)) => attractors::of_machine(found, machine),
        (Task::Orbit { label }, MachineResults::Orbit(found)) => orbit::of_machine(found, label, machine),
        (_, MachineResults::Lyapunov(found, _)) => lyapunov::of_machine(found, machine),
        (_, MachineResults::Branch(found)) => {
            branch::text(&answer.branches(found)?, Some(machine), (&answer.cut()?, &Units::default()))
        }
        (_, MachineResults::Curve(found)) => {
            curve::text(&answer.curve(found)?, (&answer.curve_plan()?, &Units::default()))
        }
        (_, MachineResults::Margins(found)) => margins::of_machine(found, machine),
        (Task::Region(task), MachineResults::Region(found)) => {
            let task: RegionPlan<String> = task.typed()?;
            region::text(found, &task, (task.neutral(source), false), &Units::default())
        }
        (_, MachineResults::Response(found)) => {
            answer.response(found).map_or_else(String::new, |view| response::text(&view, view.vary))
        }
        (_, MachineResults::Basin(found)) => basin::of_machine(found, machine),
        (_, MachineResults::Diagram(found)) => diagram::text(found, &Units::default()),
        (task, MachineResults::Map(found)) => {
            // points that are no grid have one start each
            let starts = if let Task::Map(task) = task { task.starts } else { 1 };
            map::text(found, starts, false) + &map::seen(found)
        }
        _ => return Err(Failure::Failed("the results belong to another task than the plan's".into())),
    })
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
        Results::Lyapunov(_, _, None) => {
            Some("--plot FILE.png draws the attractor; a longer --impacts narrows the error bars")
        }
        _ => None,
    };
    undecided::hint(answer).into_iter().chain(next.map(str::to_owned)).collect()
}
