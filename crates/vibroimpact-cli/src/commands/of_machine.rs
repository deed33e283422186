//! Commands with `--machine`, and `vibro run` with a plan of a machine: the result of the plan.

use crate::args::{Files, MachineArgs, StartOfMachineArgs, StoreArgs};
use crate::commands::outputs::Outputs;
use crate::commands::{respond, stored};
use crate::failure::Failure;
use crate::report::{machine_answers, machine_events};
use crate::session::Session;
use vibroimpact::events::MachineEnd;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Undecided, UndecidedCause, Verdict};
use vibroimpact_report::figure::plane::{PlaneAxis, Sides};
use vibroimpact_report::{Shown, machine_answer};
use vibroimpact_study::{
    Control, MachineBasinPlan, MachineLyapunovPlan, MachineMapPlan, MachinePlan, MachineResults, MachineTask,
    SEARCH_LIMIT, StudyPlan,
};

/// The look of the table and the figure of a command that has no flags for it.
#[allow(clippy::unnecessary_wraps, reason = "other looks may be refused")]
pub(super) fn usual(_: bool) -> Result<Shown, Failure> {
    Ok(Shown::default())
}

/// The machine of a command computes this task from this start; `None` if no machine is named. Grids may have a store. `shown`
/// says how the table and the figure look; it is asked with whether there is a figure.
pub(super) fn asked(
    machine: &MachineArgs,
    start: Option<(&StartOfMachineArgs, Option<f64>)>,
    task: impl FnOnce() -> Result<MachineTask, Failure>,
    files: Files<'_>,
    (store, shown): (Option<&StoreArgs>, impl FnOnce(bool) -> Result<Shown, Failure>),
    session: &Session,
) -> Option<Result<(), Failure>> {
    let name = machine.machine.as_deref()?;
    let answer = || {
        let (tile, shard) = store.map_or((None, None), |store| (store.tile, store.shard));
        let plan = MachinePlan { tile, shard, ..MachinePlan::new(machine.source(start)?, task()?) };
        plan.check()?;
        let outputs = Outputs::reserve(files, session)?;
        let shown = shown(outputs.drawn())?;
        let filling = store.and_then(StoreArgs::filling);
        // exponents over axes are a study, with a store or in memory
        if filling.is_none() && !matches!(plan.task, MachineTask::Lyapunov(_) if plan.fills_a_grid()) {
            return run(name, &plan, (outputs, shown), session);
        }
        drawable(&plan, &outputs)?;
        stored::filled(&StudyPlan::from(&plan), filling, (outputs, shown), session)
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
        MachineTask::Lyapunov(MachineLyapunovPlan { axes, .. }) if outputs.drawn() => {
            axes.iter().try_for_each(|axis| PlaneAxis::of_machine(axis).map(drop))?;
        }
        _ => {}
    }
    Ok(())
}

/// Computes the answer of a plan and reports it.
pub(super) fn run(
    name: &str,
    plan: &MachinePlan,
    (outputs, shown): (Outputs, Shown),
    session: &Session,
) -> Result<(), Failure> {
    let none = |what: &str| Failure::bad(format!("of a machine this command has no {what} yet"));
    // before the computation
    drawable(plan, &outputs)?;
    let bare = match &plan.task {
        MachineTask::Lyapunov(lyapunov) => lyapunov.points.is_none(),
        _ => false,
    };
    if outputs.drawn() && bare {
        return Err(none("figure"));
    }
    if outputs.tabled() && bare {
        return Err(none("table"));
    }
    let work = plan.work();
    let answer = session.watched(work, |control| machine_answer(name, plan, control));
    let answer = answer.map_err(|error| respond::stopped(error, work))?;
    let (json, table, files) = (outputs.json(), outputs.table_on_stdout(), outputs.any_file());
    // the orbit diagram behind a branch is computed with its figure
    let behind = |control: &Control<'_>| answer.figure(&shown, control);
    outputs.write(
        session,
        || answer.table(&shown)?.ok_or_else(|| none("table")),
        || session.watched(None, behind)?.ok_or_else(|| none("figure")),
    )?;
    if json {
        session.print_json(&answer)?;
    } else if !(table || files && plan.fills_a_grid()) {
        match &answer.results {
            MachineResults::Simulate(found) => session.print(&machine_events::events(&answer.machine, found))?,
            _ => session.print(&machine_answers::text(&answer))?,
        }
    }
    let search_limit = match &answer.results {
        MachineResults::Simulate(found) => found.reason == SEARCH_LIMIT,
        MachineResults::Settle(found) => ended_by_search(&found.verdict),
        MachineResults::Lyapunov(found, _) => ended_by_search(&found.motion),
        _ => false,
    };
    if search_limit { Err(respond::search_limit()) } else { Ok(()) }
}

fn ended_by_search(verdict: &Verdict<Machine>) -> bool {
    matches!(verdict, Verdict::Undecided(Undecided { why: UndecidedCause::Ended(MachineEnd::SearchLimit), .. }))
}
