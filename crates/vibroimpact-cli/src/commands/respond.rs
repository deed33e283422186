//! Common part of the commands with one answer: compute it, write the files, and print the report.

use crate::args::{OutputArgs, Question, StoreArgs};
use crate::commands::outputs::Outputs;
use crate::commands::stored;
use crate::failure::Failure;
use crate::report;
use crate::session::Session;
use vibroimpact_report::{Answer, AnswerError, Shown, answer};
use vibroimpact_study::{Control, Stopped, Task};

/// Computes the answer to a question and reports it as usual.
pub(super) fn ask(
    question: &Question<'_>,
    output: &OutputArgs,
    store: Option<&StoreArgs>,
    session: &Session,
) -> Result<(), Failure> {
    run(question, (output, Shown::default()), store, session)
}

/// Computes the answer to a question and reports it. With --store, the plan fills the store instead. Exponents over axes are a
/// study, with a store or in memory.
pub(super) fn run(
    question: &Question<'_>,
    (output, shown): (&OutputArgs, Shown),
    store: Option<&StoreArgs>,
    session: &Session,
) -> Result<(), Failure> {
    let plan = &question.plan;
    let outputs = Outputs::reserve(output.files(), session)?;
    stored::check_overlay(&shown.overlay, plan, shown.colour.is_some())?;
    outputs.check(plan)?;
    let filling = store.and_then(StoreArgs::filling);
    let exponents = matches!(plan.task, Task::Lyapunov(_));
    if filling.is_some() || exponents && plan.fills_a_grid() {
        return stored::filled(plan, filling, (outputs, shown), session);
    }
    let answer = compute(question, session)?;
    tell(&answer, (outputs, shown), session)
}

/// Computes the answer to a question, with a progress bar if its plan reports progress.
pub(super) fn compute(question: &Question<'_>, session: &Session) -> Result<Answer, Failure> {
    let Question { plan, units, machine } = question;
    let work = plan.work();
    let answer = session.watched(work, |control| answer(plan, *units, control));
    let answer = answer.map_err(|error| stopped(error, work))?;
    Ok(if let Some(name) = machine { answer.named(name) } else { answer })
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

/// Writes the files, then prints the JSON object, or the text unless the table is on stdout. For a grid with an output
/// file no text is printed.
pub(super) fn tell(answer: &Answer, (outputs, shown): (Outputs, Shown), session: &Session) -> Result<(), Failure> {
    let grid = answer.plan().fills_a_grid();
    let (json, files, table) = (outputs.json(), outputs.any_file(), outputs.table_on_stdout());
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
        session.print(&answer.text()?)?;
        for hint in report::hints(answer) {
            session.note(&format!("hint: {hint}"));
        }
    }
    if report::ended_by_search(answer) { Err(search_limit()) } else { Ok(()) }
}

/// The failure of a question without a table or a figure.
pub(super) fn none(what: &str) -> Failure {
    Failure::bad(format!("this question has no {what}"))
}

/// The failure of a motion whose next event was not found. What was found before it is printed.
fn search_limit() -> Failure {
    Failure::Failed(
        "the search for the next event used all its steps: the motion is not known after the last event\nhint: numbers that lie many orders of magnitude apart make the search long; what is printed before is right"
            .to_owned(),
    )
}
