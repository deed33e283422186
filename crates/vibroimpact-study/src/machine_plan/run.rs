//! The results of the tasks of machines.

use super::branch::{self, MachineBranched};
use super::curve::{self, MachineEventCurve};
use super::diagram::MachineDiagram;
use super::grid::{MachineBasin, MachineMap};
use super::margins::MachineMargins;
use super::section::{self, MachineSection};
use super::simulate::{MachineSimulated, simulate};
use super::{margins, orbits, region, response, verdicts};
use crate::machine::MachineSource;
use crate::{Control, LyapunovPlan, Regions, ResponseCurves, RunError, Task, in_memory};
use vibroimpact::chaos::Exponents;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::verdict::{Census, Settled};

/// The result of a [`Task`] of a machine.
#[derive(Clone, Debug)]
pub enum MachineResults {
    /// The events of the motion.
    Simulate(MachineSimulated),
    /// What the motion settles into.
    Settle(Settled<Machine>),
    /// The distinct motions and their counts.
    Attractors(Census<Machine>),
    /// The exponents, and the sections of the attractor if points of them were requested.
    Lyapunov(Exponents<Machine>, Option<MachineSection>),
    /// The orbits, the fastest last.
    Orbit(Vec<MachineCycle>),
    /// The branch.
    Branch(MachineBranched),
    /// The curve.
    Curve(MachineEventCurve),
    /// The margins.
    Margins(MachineMargins),
    /// Both regions.
    Region(Regions),
    /// The response.
    Response(ResponseCurves),
    /// The basin.
    Basin(MachineBasin),
    /// The map.
    Map(MachineMap),
    /// The orbit diagram.
    Diagram(MachineDiagram),
}

/// Computes the result of a task of a machine, which was checked.
pub(crate) fn run(source: &MachineSource, task: &Task, control: &Control<'_>) -> Result<MachineResults, RunError> {
    let (machine, start) = source.described()?;
    Ok(match task {
        Task::Simulate { impacts, periods, .. } => {
            MachineResults::Simulate(simulate(&machine, &start, (*impacts, *periods), control)?)
        }
        Task::Settle { impacts, .. } => MachineResults::Settle(verdicts::settle(&machine, &start, *impacts, control)?),
        Task::Attractors { starts, seed, impacts } => {
            MachineResults::Attractors(verdicts::attractors(&machine, (*starts, *seed, *impacts), control)?)
        }
        Task::Lyapunov(lyapunov) => {
            let lyapunov: LyapunovPlan<String> = lyapunov.typed()?;
            let found = lyapunov.run(&machine, &start, control)?;
            let before = u64::from(lyapunov.events().1);
            let section = |points| section::section(&machine, &start, (before, points), control);
            MachineResults::Lyapunov(found, lyapunov.points.map(section).transpose()?)
        }
        Task::Orbit { label } => {
            MachineResults::Orbit(orbits::orbits(&machine, orbits::label(&machine, label)?, control)?)
        }
        Task::Branch(asked) => {
            MachineResults::Branch(branch::branch(source, (&machine, &start), &asked.typed()?, control)?)
        }
        Task::Curve(asked) => {
            MachineResults::Curve(curve::curve(source, (&machine, &start), &asked.typed()?, control)?)
        }
        Task::SettleMany(asked) => {
            MachineResults::Map(in_memory::machine_points(source, (&machine, &start), &asked.typed()?, control)?)
        }
        Task::Margins(asked) => {
            MachineResults::Margins(margins::margins(source, (&machine, &start), &asked.typed()?, control)?)
        }
        Task::Region(asked) => MachineResults::Region(region::regions(source, &asked.typed()?, control)?),
        Task::Response(asked) => {
            MachineResults::Response(response::response(source, (&machine, &start), &asked.typed()?, control)?)
        }
        Task::Basin(basin) => {
            MachineResults::Basin(in_memory::machine_basin((&machine, &start), &basin.typed()?, control)?)
        }
        Task::Map(map) => MachineResults::Map(in_memory::machine_map(source, &map.typed()?, control)?),
        Task::Diagram(diagram) => {
            MachineResults::Diagram(in_memory::machine_diagram(source, &diagram.typed()?, control)?)
        }
    })
}
