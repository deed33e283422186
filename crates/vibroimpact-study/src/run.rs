//! The function that computes the result of a plan in memory. The command, the page and the Python package call it.

use crate::branch::branches;
use crate::curve::curve;
use crate::in_memory::{DIAGRAM_TILE, attractors, basin, diagram, map};
use crate::map::options;
use crate::margins::margins;
use crate::region::regions;
use crate::response::response;
use crate::simulate::simulate;
use crate::study::SweepFill;
use crate::{
    Basin, Branches, Control, Diagram, EventCurve, LyapunovPlan, MarginsPlan, MotionMargins, Plan, PlanError,
    RegionMap, Regions, ResponseCurves, RunError, Simulated, StartPlan, Stopped, System, SystemPlan, Task, machine,
    machine_plan,
};
use core::sync::atomic::{AtomicU64, Ordering};
use vibroimpact::chaos::{Exponents, Section, exponents_while, section_while};
use vibroimpact::orbit::{FindOptions, Orbit, find_while};
use vibroimpact::verdict::{Census, Settled, settle_while};
use vibroimpact::{Label, Start};

/// The result of a [`Task`], one variant for each.
#[derive(Clone, Debug)]
#[non_exhaustive]
#[allow(clippy::large_enum_variant, reason = "there is one of them for a plan")]
pub enum Results {
    /// The start and the events of its motion.
    Simulate(Start, Simulated),
    /// The start and the result of settling its motion.
    Settle(Start, Settled),
    /// The attractors to which the starts lead.
    Attractors(Census),
    /// The orbits of a label.
    Orbit(Vec<Orbit>),
    /// The motion to which each start leads.
    Basin(Basin),
    /// The motions at each point.
    Map(RegionMap),
    /// The motions at each value.
    Diagram(Diagram),
    /// The start, the exponents of its motion, and its sections if points of them were requested.
    Lyapunov(Start, Exponents, Option<Section>),
    /// A branch and the branches that begin on it.
    Branch(Branches),
    /// A curve of events.
    Curve(EventCurve),
    /// The regions where a motion exists and where it is stable.
    Region(Regions),
    /// The motions of two sweeps, and their branches.
    Response(ResponseCurves),
    /// The start, unless the motion is given by its label, and the distances of the motion from its nearest events.
    Margins(Option<Start>, MotionMargins),
    /// The result of a task of a machine.
    Machine(machine::Results),
}

/// Number of impacts of one motion between two reports.
const TELL: u64 = 1024;

/// Computes the result of a plan: every point of a grid, without refinement.
///
/// `control.stop` is read at every point of a grid, every event of a motion, every seed of a search for orbits, every
/// step along the boundary of a region, and every point of a branch or curve.
///
/// ```
/// use vibroimpact_study::{Control, Plan, Results, run};
/// let plan = Plan::from_text(r#"{"version":1,"system":{"inverse_beta":1.8,"gap":0.25,"restitution":0.5},"task":{"settle":{"start":{}}}}"#)?;
/// let Results::Settle(_, settled) = run(&plan, &Control::default())? else { unreachable!() };
/// assert_eq!(settled.verdict.label(), "4/1");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped. A plan for exponents over axes is an error too, because it has no
/// single result; it is computed as a [`Study`](crate::Study).
pub fn run(plan: &Plan, control: &Control<'_>) -> Result<Results, RunError> {
    plan.check()?;
    match &plan.system {
        System::Oscillator(system) => run_oscillator(system, plan, control),
        System::Machine(machine) => Ok(Results::Machine(machine_plan::run(machine, &plan.task, control)?)),
    }
}

/// Computes the result of the task of an oscillator, which was checked.
fn run_oscillator(system: &SystemPlan, plan: &Plan, control: &Control<'_>) -> Result<Results, RunError> {
    let of = system.setup(StartPlan::default())?;
    let osc = of.system;
    // one motion reports its impacts
    let impacts = AtomicU64::new(0);
    let go_on = || {
        let now = impacts.fetch_add(1, Ordering::Relaxed) + 1;
        if now.is_multiple_of(TELL) {
            (control.progress)(now);
        }
        !control.stopping()
    };
    let stopped = Stopped { done: 0, total: plan.work().map_or(1, |(total, _)| total) };
    if control.stopping() {
        return Err(stopped.into());
    }
    Ok(match &plan.task {
        Task::Simulate { start, impacts, periods } => {
            let start = start.unwrap_or_default().start(&osc)?;
            Results::Simulate(start, simulate(&osc, start, (*impacts, *periods), control)?)
        }
        Task::Settle { start, impacts } => {
            let start = start.unwrap_or_default().start(&osc)?;
            Results::Settle(start, settle_while(&osc, start, &options(*impacts), &go_on).ok_or(stopped)?)
        }
        Task::Attractors { starts, seed, impacts } => {
            Results::Attractors(attractors(system, (*starts, *seed), &options(*impacts), control)?)
        }
        Task::Orbit { label } => {
            let label: Label = label.parse().map_err(PlanError::from)?;
            Results::Orbit(find_while(&osc, label, FindOptions::default(), &go_on).ok_or(stopped)?)
        }
        Task::Basin(task) => Results::Basin(basin(system, &task.typed()?, control)?),
        Task::Map(task) => Results::Map(map(system, &task.typed()?, control)?),
        Task::Diagram(task) => {
            let task = SweepFill::new(system, &task.typed()?, Some(DIAGRAM_TILE));
            Results::Diagram(diagram(&task, control)?)
        }
        Task::Lyapunov(task) => {
            let task: LyapunovPlan = task.typed()?;
            if let Some(axis) = task.axes.first() {
                let (task, known) = ("measurement of one motion", "none: over axes it is a study");
                return Err(PlanError::WrongAxis { task, name: axis.vary.name().into(), known }.into());
            }
            let start = task.start().start(&osc)?;
            let section = match task.points {
                Some(points) => Some(section_while(&osc, start, task.lengths().1, points, &go_on).ok_or(stopped)?),
                None => None,
            };
            let exponents = exponents_while(&osc, start, &task.options(), &go_on).ok_or(stopped)?;
            Results::Lyapunov(start, exponents, section)
        }
        Task::Branch(task) => Results::Branch(branches(&of, &task.typed()?, control)?),
        Task::Curve(task) => Results::Curve(curve(&of, &task.typed()?, control)?),
        Task::Region(task) => Results::Region(regions(&of, &task.typed()?, control)?),
        Task::Response(task) => Results::Response(response(&of, &task.typed()?, control)?),
        Task::Margins(task) => {
            let task: MarginsPlan = task.typed()?;
            let of = system.setup(task.start())?;
            Results::Margins(task.label.is_none().then_some(of.start), margins(&of, &task, control)?)
        }
        Task::SettleMany(_) => return Err(PlanError::OfMachine.into()),
    })
}
