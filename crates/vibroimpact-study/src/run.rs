//! The results of tasks, and the function that computes that of a plan in memory. The command, the page and the Python package call
//! it.

use crate::branch::branches;
use crate::curve::curve;
use crate::diagram::Diagram;
use crate::dynamics::{CycleOf, Dynamics, PointOf};
use crate::edge::edge;
use crate::machine::MachineSource;
use crate::map::options;
use crate::margins::margins;
use crate::name::Name;
use crate::region::regions;
use crate::response::response;
use crate::simulate::TELL;
use crate::{
    Basin, Branches, Control, EventCurve, LyapunovPlan, MotionMargins, Plan, PlanError, RegionMap, Regions,
    ResponseCurves, RunError, SectionPoints, Simulated, Stopped, System, SystemPlan, Task,
};
use core::sync::atomic::{AtomicU64, Ordering};
use vibroimpact::chaos::Exponents;
use vibroimpact::edge::Edge;
use vibroimpact::orbit::{Cycle, EarlierContact};
use vibroimpact::verdict::{Census, Settled};

/// The result of a [`Task`] of an oscillator or of a machine, one variant for each kind of result.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "there is one of them for a plan")]
pub enum Results<D: Dynamics> {
    /// The events of the motion.
    Simulate(Simulated<D::Event>),
    /// What the motion settles into.
    Settle(Settled<D::System>),
    /// The motions to which the starts lead, and how many lead to each.
    Attractors(Census<D::System>),
    /// The orbits of a label, the fastest last.
    Orbit(Vec<Orbit<CycleOf<D>>>),
    /// The motion to which each start leads.
    Basin(Basin<D::System, D::Coordinate, D::Quantity>),
    /// The motions at each point.
    Map(RegionMap<D::Coordinate, D::Quantity>),
    /// The motions at each value.
    Diagram(Diagram<D::Name, D::Shown>),
    /// The exponents of the motion, and its sections if points of them were requested.
    Lyapunov(Exponents<D::System>, Option<SectionPoints>),
    /// A branch and the branches that begin on it.
    Branch(Branches<CycleOf<D>, PointOf<D>>),
    /// A curve of events.
    Curve(EventCurve<CycleOf<D>, PointOf<D>, D::CurvePoint>),
    /// The regions where a motion exists and where it is stable.
    Region(Regions),
    /// The motions of two sweeps, and their branches.
    Response(ResponseCurves),
    /// The distances of the motion from its nearest events.
    Margins(MotionMargins<D::System, D::Name, PointOf<D>>),
    /// The border between two starts, and the motion on it.
    Edge(Edge<D::System>),
}

/// An orbit with a label.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit<C = Cycle> {
    /// Its cycle.
    pub cycle: C,
    /// Whether it is a motion; a solution of the equations of an oscillator may pass through a stop.
    pub admissible: bool,
    /// The first contact that makes it inadmissible.
    pub earlier: Option<EarlierContact>,
}

/// The result of a plan.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "there is one of them for a plan")]
pub enum PlanResults {
    /// Of an oscillator.
    Oscillator(Results<SystemPlan>),
    /// Of a machine.
    Machine(Results<MachineSource>),
}

/// Computes the result of a plan: every point of a grid, without refinement.
///
/// `control.stop` is read at every point of a grid, every event of a motion, every seed of a search for orbits, every
/// step along the boundary of a region, and every point of a branch or curve.
///
/// ```
/// use vibroimpact_study::{Control, Plan, PlanResults, Results, run};
/// let plan = Plan::from_text(r#"{"version":1,"system":{"inverse_beta":1.8,"gap":0.25,"restitution":0.5},"task":{"settle":{"start":{}}}}"#)?;
/// let PlanResults::Oscillator(Results::Settle(settled)) = run(&plan, &Control::default())? else { unreachable!() };
/// assert_eq!(settled.verdict.label(), "4/1");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped. A plan for exponents over axes is an error too, because it has no
/// single result; it is computed as a [`Study`](crate::Study).
pub fn run(plan: &Plan, control: &Control<'_>) -> Result<PlanResults, RunError> {
    plan.check()?;
    Ok(match &plan.system {
        System::Oscillator(system) => PlanResults::Oscillator(results(system, plan, control)?),
        System::Machine(machine) => PlanResults::Machine(results(&**machine, plan, control)?),
    })
}

/// Computes the result of the task of a plan, which was checked, of its system.
fn results<D: Dynamics>(system: &D, plan: &Plan, control: &Control<'_>) -> Result<Results<D>, RunError> {
    let of = system.setup_of(&plan.task)?;
    // one motion reports its impacts
    let impacts = AtomicU64::new(0);
    let go_on = || {
        let now = impacts.fetch_add(1, Ordering::Relaxed) + 1;
        if now.is_multiple_of(TELL) {
            (control.progress)(now);
        }
        !control.stopping()
    };
    if control.stopping() {
        return Err(Stopped { done: 0, total: plan.work().map_or(1, |(total, _)| total) }.into());
    }
    Ok(match &plan.task {
        Task::Simulate(plan) => Results::Simulate(D::simulate(&of, plan, control)?),
        Task::Settle { impacts, .. } => Results::Settle(D::settle(&of.system, &of.start, *impacts, &go_on)?),
        Task::Attractors { starts, seed, impacts } => {
            Results::Attractors(D::attractors(&of, (*starts, *seed), &options(*impacts), control)?)
        }
        Task::Orbit { label } => {
            let label = D::label(&of.system, Some(label), false)?.ok_or(PlanError::NoLabel)?;
            Results::Orbit(D::orbits(&of.system, label, &go_on)?)
        }
        Task::Lyapunov(task) => {
            let task: LyapunovPlan<D::Coordinate> = task.typed()?;
            if let Some(axis) = task.axes.first() {
                let (task, known) = ("measurement of one motion", "none: over axes it is a study");
                return Err(PlanError::WrongAxis { task, name: axis.vary.text().to_owned().into(), known }.into());
            }
            D::exponents(&of, &task, &go_on)?
        }
        Task::Branch(task) => Results::Branch(branches(&of, &task.typed()?, control)?),
        Task::Curve(task) => Results::Curve(curve(&of, &task.typed()?, control)?),
        Task::Region(task) => Results::Region(regions(&of, &task.typed()?, control)?),
        Task::Response(task) => Results::Response(response(&of, &task.typed()?, control)?),
        Task::Margins(task) => Results::Margins(margins(&of, &task.typed()?, control)?),
        Task::Edge(task) => Results::Edge(edge(&of, &task.typed()?, control)?),
        Task::Basin(_) | Task::Map(_) | Task::Diagram(_) | Task::SettleMany(_) => {
            D::over_grid(&of, &plan.task, control)?
        }
    })
}
