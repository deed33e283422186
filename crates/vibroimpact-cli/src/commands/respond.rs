//! Common part of the commands with one answer: compute it, write the files, and print the report.

use crate::args::StoreArgs;
use crate::commands::outputs::Outputs;
use crate::commands::stored;
use crate::failure::Failure;
use crate::report;
use crate::session::Session;
use vibroimpact_report::{Answer, AnswerError, Shown, Units, answer};
use vibroimpact_study::{Control, Plan, Results, SEARCH_LIMIT, Stopped, StudyPlan};

/// Computes the answer of a plan and reports it. With --store, the plan fills the store instead.
pub(super) fn run(
    plan: &Plan,
    units: Units,
    (outputs, shown): (Outputs, Shown),
    store: Option<&StoreArgs>,
    session: &Session,
) -> Result<(), Failure> {
    shown.overlay.check(&in_units(plan, &units), shown.colour.is_some())?;
    if let Some(filling) = store.and_then(StoreArgs::filling) {
        return stored::run(&StudyPlan::from(&in_units(plan, &units)), &filling, (outputs, shown), session);
    }
    let answer = compute(plan, units, session)?;
    tell(&answer, (outputs, shown), session)
}

/// Computes the answer of a plan, with a progress bar if the plan reports progress.
pub(super) fn compute(plan: &Plan, units: Units, session: &Session) -> Result<Answer, Failure> {
    let plan = &in_units(plan, &units);
    let work = plan.work();
    session.watched(work, |control| answer(plan, units, control)).map_err(|error| stopped(error, work))
}

/// The failure of an answer. If it was stopped, it says how much of the work was done.
pub(super) fn stopped(error: AnswerError, work: Option<(u64, &str)>) -> Failure {
    match error {
        AnswerError::Stopped(Stopped { done, total }) => {
            let unit = work.map_or("impacts", |(_, unit)| unit);
            let part = if total > 1 { format!("after {done} of {total} {unit}; ") } else { String::new() };
            Failure::Stopped(format!("{part}nothing was written"))
        }
        other => other.into(),
    }
}

/// The plan with the units of its results, if they are SI units.
fn in_units(plan: &Plan, units: &Units) -> Plan {
    Plan { units: units.plan().or(plan.units), ..plan.clone() }
}

/// Writes the files, then prints the JSON object, or the text unless the table is on stdout. For a grid with an output
/// file no text is printed.
pub(super) fn tell(answer: &Answer, (outputs, shown): (Outputs, Shown), session: &Session) -> Result<(), Failure> {
    let grid = matches!(answer.results, Results::Basin(_) | Results::Map(_) | Results::Diagram(_));
    let (json, files, table) = (outputs.json(), outputs.any_file(), outputs.table_on_stdout());
    let none = |what: &str| Failure::bad(format!("this question has no {what}"));
    // the orbit diagram behind a branch is computed with its figure
    let behind = |control: &Control<'_>| answer.figure(&shown, control);
    outputs.write(
        session,
        || answer.table(&shown)?.ok_or_else(|| none("table")),
        || session.watched(None, behind)?.ok_or_else(|| none("figure")),
    )?;
    if json {
        session.print_json(answer)?;
    } else if !(table || (grid && files)) {
        session.print(&report::text(answer)?)?;
        for hint in report::hints(answer) {
            session.note(&format!("hint: {hint}"));
        }
    }
    match &answer.results {
        Results::Simulate(_, found) if found.reason == SEARCH_LIMIT => Err(search_limit()),
        _ => Ok(()),
    }
}

/// The failure of a motion whose next event was not found. What was found before it is printed.
pub(super) fn search_limit() -> Failure {
    Failure::Failed(
        "the search for the next event used all its steps: the motion is not known after the last event\nhint: numbers that lie many orders of magnitude apart make the search long; what is printed before is right"
            .to_owned(),
    )
}
