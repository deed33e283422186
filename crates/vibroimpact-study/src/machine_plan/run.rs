//! The results of the tasks of machines.

use super::section::{self, SectionPoints};
use super::simulate::simulate;
use super::verdicts;
use crate::branch::branches;
use crate::curve::curve;
use crate::dynamics::{Dynamics, Setup, machine_label};
use crate::in_memory::DIAGRAM_TILE;
use crate::machine::MachineSource;
use crate::margins::margins;
use crate::region::regions;
use crate::response::response;
use crate::study::SweepFill;
use crate::{
    Basin, Branches, Control, Diagram, EventCurve, LyapunovPlan, MotionMargins, RegionMap, Regions, ResponseCurves,
    RunError, Simulated, Task, in_memory,
};
use vibroimpact::chaos::Exponents;
use vibroimpact::continuation::machine::{CurvePoint, SolutionPoint};
use vibroimpact::events::Event;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{Census, Settled};

/// The result of a [`Task`] of a machine.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "there is one of them for a plan")]
pub enum Results {
    /// The events of the motion.
    Simulate(Simulated<Event>),
    /// What the motion settles into.
    Settle(Settled<Machine>),
    /// The distinct motions and their counts.
    Attractors(Census<Machine>),
    /// The exponents, and the sections of the attractor if points of them were requested.
    Lyapunov(Exponents<Machine>, Option<SectionPoints>),
    /// The orbits, the fastest last.
    Orbit(Vec<Cycle>),
    /// The branch.
    Branch(Branches<Cycle, SolutionPoint>),
    /// The curve.
    Curve(EventCurve<Cycle, SolutionPoint, CurvePoint>),
    /// The margins.
    Margins(MotionMargins<Machine, String, SolutionPoint>),
    /// Both regions.
    Region(Regions),
    /// The response.
    Response(ResponseCurves),
    /// The basin.
    Basin(Basin<Machine, String, String>),
    /// The map.
    Map(RegionMap<String, String>),
    /// The orbit diagram.
    Diagram(Diagram<String, String>),
}

/// Computes the result of a task of a machine, which was checked.
pub(crate) fn run(source: &MachineSource, task: &Task, control: &Control<'_>) -> Result<Results, RunError> {
    let (machine, start) = source.described()?;
    let of = Setup { written: source, system: machine, start };
    let (machine, start) = (&of.system, &of.start);
    Ok(match task {
        Task::Simulate { impacts, periods, .. } => {
            Results::Simulate(simulate(machine, start, (*impacts, *periods), control)?)
        }
        Task::Settle { impacts, .. } => Results::Settle(MachineSource::settle(machine, start, *impacts, control)?),
        Task::Attractors { starts, seed, impacts } => {
            Results::Attractors(verdicts::attractors(machine, (*starts, *seed, *impacts), control)?)
        }
        Task::Lyapunov(lyapunov) => {
            let lyapunov: LyapunovPlan<String> = lyapunov.typed()?;
            let found = lyapunov.run(machine, start, control)?;
            let before = u64::from(lyapunov.events().1);
            let section = |points| section::section(machine, start, (before, points), control);
            Results::Lyapunov(found, lyapunov.points.map(section).transpose()?)
        }
        Task::Orbit { label } => {
            let found = MachineSource::orbits(machine, machine_label(machine, label)?, control)?;
            Results::Orbit(found.into_iter().map(|(cycle, _)| cycle).collect())
        }
        Task::Branch(asked) => Results::Branch(branches(&of, &asked.typed()?, control)?),
        Task::Curve(asked) => Results::Curve(curve(&of, &asked.typed()?, control)?),
        Task::Margins(asked) => Results::Margins(margins(&of, &asked.typed()?, control)?),
        Task::Region(asked) => Results::Region(regions(&of, &asked.typed()?, control)?),
        Task::Response(asked) => Results::Response(response(&of, &asked.typed()?, control)?),
        Task::SettleMany(asked) => {
            Results::Map(in_memory::machine_points(source, (machine, start), &asked.typed()?, control)?)
        }
        Task::Basin(basin) => Results::Basin(in_memory::machine_basin((machine, start), &basin.typed()?, control)?),
        Task::Map(map) => Results::Map(in_memory::machine_map(source, &map.typed()?, control)?),
        Task::Diagram(diagram) => {
            let task = SweepFill::of_machine(source, &diagram.typed()?, Some(DIAGRAM_TILE));
            Results::Diagram(in_memory::diagram(&task, control)?)
        }
    })
}
