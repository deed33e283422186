//! Commands with `--machine`, and `vibro run` with a plan of a machine: the result of the plan.

use crate::args::{FigureArgs, MachineArgs, StartOfMachineArgs};
use crate::commands::outputs::Outputs;
use crate::failure::Failure;
use crate::report::{machine_answers, machine_events};
use crate::session::Session;
use std::path::Path;
use vibroimpact_report::figure::plane::Sides;
use vibroimpact_report::machine_answer;
use vibroimpact_study::{MachinePlan, MachineResults, MachineTask};

/// The files of a command: its table, its figure, and whether it prints JSON.
pub(super) type Files<'a> = (Option<&'a Path>, (Option<&'a Path>, &'a FigureArgs), bool);

/// The machine of a command computes this task from this start; `None` if no machine is named.
pub(super) fn asked(
    machine: &MachineArgs,
    start: Option<(&StartOfMachineArgs, Option<f64>)>,
    task: impl FnOnce() -> Result<MachineTask, Failure>,
    (csv, plot, json): Files<'_>,
    session: &Session,
) -> Option<Result<(), Failure>> {
    let name = machine.machine.as_deref()?;
    let answer = || {
        let plan = MachinePlan::new(machine.source(start)?, task()?);
        plan.check()?;
        let outputs = Outputs::reserve(csv, plot, json, session)?;
        run(name, &plan, (outputs, None), session)
    };
    Some(answer())
}

/// Computes the answer of a plan and reports it.
pub(super) fn run(
    name: &str,
    plan: &MachinePlan,
    (outputs, step): (Outputs, Option<f64>),
    session: &Session,
) -> Result<(), Failure> {
    let none = |what: &str| Failure::bad(format!("of a machine this command has no {what} yet"));
    // before the computation
    match &plan.task {
        MachineTask::Basin { axes, .. } | MachineTask::Map { axes, .. } if outputs.drawn() => {
            Sides::of_machine(axes)?;
        }
        MachineTask::Attractors { .. } | MachineTask::Orbit { .. } | MachineTask::Lyapunov { .. }
            if outputs.drawn() =>
        {
            return Err(none("figure"));
        }
        MachineTask::Settle { .. } | MachineTask::Orbit { .. } | MachineTask::Lyapunov { .. } if outputs.tabled() => {
            return Err(none("table"));
        }
        _ => {}
    }
    let answer = session.watched(None, |control| machine_answer(name, plan, control))?;
    let (json, table, files) = (outputs.json(), outputs.table_on_stdout(), outputs.any_file());
    outputs.write(
        session,
        || answer.table(step)?.ok_or_else(|| none("table")),
        || answer.figure()?.ok_or_else(|| none("figure")),
    )?;
    if json {
        return session.print_json(&answer);
    }
    if table || files && matches!(answer.results, MachineResults::Basin(_) | MachineResults::Map(_)) {
        return Ok(());
    }
    match &answer.results {
        MachineResults::Simulate(found) => session.print(&machine_events::events(&answer.machine, found)),
        _ => session.print(&machine_answers::text(&answer)),
    }
}
