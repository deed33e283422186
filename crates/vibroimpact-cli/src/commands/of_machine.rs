//! Commands with `--machine`, and `vibro run` with a plan of a machine: the result of the plan.

use crate::args::{ColourArgs, FigureArgs, MachineArgs, StartOfMachineArgs, StoreArgs};
use crate::commands::outputs::Outputs;
use crate::commands::{respond, stored};
use crate::failure::Failure;
use crate::report::{machine_answers, machine_events};
use crate::session::Session;
use std::path::Path;
use vibroimpact_report::figure::coloured::Coloured;
use vibroimpact_report::figure::plane::Sides;
use vibroimpact_report::{Shown, machine_answer};
use vibroimpact_study::{MachineBasinPlan, MachineMapPlan, MachinePlan, MachineResults, MachineTask, StudyPlan};

/// The files of a command: its table, its figure, and whether it prints JSON.
pub(super) type Files<'a> = (Option<&'a Path>, (Option<&'a Path>, &'a FigureArgs), bool);

/// The machine of a command computes this task from this start; `None` if no machine is named. Grids may have a store and
/// colours.
pub(super) fn asked(
    machine: &MachineArgs,
    start: Option<(&StartOfMachineArgs, Option<f64>)>,
    task: impl FnOnce() -> Result<MachineTask, Failure>,
    (csv, plot, json): Files<'_>,
    (store, colour): (Option<&StoreArgs>, Option<&ColourArgs>),
    session: &Session,
) -> Option<Result<(), Failure>> {
    let name = machine.machine.as_deref()?;
    let answer = || {
        let (tile, shard) = store.map_or((None, None), |store| (store.tile, store.shard));
        let plan = MachinePlan { tile, shard, ..MachinePlan::new(machine.source(start)?, task()?) };
        plan.check()?;
        let outputs = Outputs::reserve(csv, plot, json, session)?;
        let colour = colour.map(|colour| colour.coloured(outputs.drawn())).transpose()?.flatten();
        let Some(filling) = store.and_then(StoreArgs::filling) else {
            return run(name, &plan, (outputs, None, colour), session);
        };
        drawable(&plan, &outputs)?;
        stored::run(&StudyPlan::from(&plan), &filling, (outputs, Shown { colour, ..Shown::default() }), session)
    };
    Some(answer())
}

/// Refuses a figure of a grid that cannot be drawn, before the computation.
fn drawable(plan: &MachinePlan, outputs: &Outputs) -> Result<(), Failure> {
    match &plan.task {
        MachineTask::Basin(MachineBasinPlan { axes, .. }) | MachineTask::Map(MachineMapPlan { axes, .. })
            if outputs.drawn() =>
        {
            Sides::of_machine(axes)?;
        }
        _ => {}
    }
    Ok(())
}

/// Computes the answer of a plan and reports it.
pub(super) fn run(
    name: &str,
    plan: &MachinePlan,
    (outputs, step, colour): (Outputs, Option<f64>, Option<Coloured>),
    session: &Session,
) -> Result<(), Failure> {
    let none = |what: &str| Failure::bad(format!("of a machine this command has no {what} yet"));
    // before the computation
    drawable(plan, &outputs)?;
    match &plan.task {
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
    let work = plan.work();
    let answer = session.watched(work, |control| machine_answer(name, plan, control));
    let answer = answer.map_err(|error| respond::stopped(error, work))?;
    let (json, table, files) = (outputs.json(), outputs.table_on_stdout(), outputs.any_file());
    outputs.write(
        session,
        || answer.table(step)?.ok_or_else(|| none("table")),
        || answer.figure(colour.as_ref())?.ok_or_else(|| none("figure")),
    )?;
    if json {
        return session.print_json(&answer);
    }
    if table || files && plan.fills_a_grid() {
        return Ok(());
    }
    match &answer.results {
        MachineResults::Simulate(found) => session.print(&machine_events::events(&answer.machine, found)),
        _ => session.print(&machine_answers::text(&answer)),
    }
}
