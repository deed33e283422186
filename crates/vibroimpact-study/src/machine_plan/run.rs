//! The results of the tasks of machines.

use super::branch::{self, MachineBranched};
use super::curve::{self, MachineEventCurve};
use super::diagram::MachineDiagram;
use super::grid::{MachineBasin, MachineMap};
use super::margins::MachineMargins;
use super::plan::MachineTask;
use super::section::{self, MachineSection};
use super::simulate::{MachineSimulated, simulate};
use super::{many, margins, orbits, response, verdicts};
use crate::machine::MachineSource;
use crate::{Control, ResponseCurves, RunError, in_memory};
use vibroimpact::chaos::MachineExponents;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::verdict::{Census, MachineSettled, MachineVerdict};

/// The result of a [`MachineTask`], one variant for each.
#[derive(Clone, Debug)]
pub enum MachineResults {
    /// The events of the motion.
    Simulate(MachineSimulated),
    /// What the motion settles into.
    Settle(MachineSettled),
    /// The distinct motions and their counts.
    Attractors(Census<MachineVerdict>),
    /// The exponents, and the sections of the attractor if points of them were requested.
    Lyapunov(MachineExponents, Option<MachineSection>),
    /// The orbits, the fastest last.
    Orbit(Vec<MachineCycle>),
    /// The branch.
    Branch(MachineBranched),
    /// The curve.
    Curve(MachineEventCurve),
    /// The margins.
    Margins(MachineMargins),
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
pub(crate) fn run(
    source: &MachineSource,
    task: &MachineTask,
    control: &Control<'_>,
) -> Result<MachineResults, RunError> {
    let (machine, start) = source.described()?;
    Ok(match task {
        MachineTask::Simulate { impacts, periods } => {
            MachineResults::Simulate(simulate(&machine, &start, (*impacts, *periods), control)?)
        }
        MachineTask::Settle { impacts } => {
            MachineResults::Settle(verdicts::settle(&machine, &start, *impacts, control)?)
        }
        MachineTask::Attractors { starts, seed, impacts } => {
            MachineResults::Attractors(verdicts::attractors(&machine, (*starts, *seed, *impacts), control)?)
        }
        MachineTask::Lyapunov(lyapunov) => {
            let found = lyapunov.run(&machine, &start, control)?;
            let before = u64::from(lyapunov.lengths().1);
            let section = |points| section::section(&machine, &start, (before, points), control);
            MachineResults::Lyapunov(found, lyapunov.points.map(section).transpose()?)
        }
        MachineTask::Orbit { label } => {
            MachineResults::Orbit(orbits::orbits(&machine, orbits::label(&machine, label)?, control)?)
        }
        MachineTask::Branch(asked) => {
            MachineResults::Branch(branch::branch(source, (&machine, &start), asked, control)?)
        }
        MachineTask::Curve(asked) => {
            MachineResults::Curve(curve::curve(source, (&machine, &start), asked, control)?)
        }
        MachineTask::SettleMany(asked) => {
            MachineResults::Map(many::many(source, (&machine, &start), asked, control)?)
        }
        MachineTask::Margins(asked) => {
            MachineResults::Margins(margins::margins(source, (&machine, &start), asked, control)?)
        }
        MachineTask::Response(asked) => {
            MachineResults::Response(response::response(source, (&machine, &start), asked, control)?)
        }
        MachineTask::Basin(basin) => {
            MachineResults::Basin(in_memory::machine_basin((&machine, &start), basin, control)?)
        }
        MachineTask::Map(map) => MachineResults::Map(in_memory::machine_map(source, map, control)?),
        MachineTask::Diagram(diagram) => {
            MachineResults::Diagram(in_memory::machine_diagram(source, diagram, control)?)
        }
    })
}
