//! The function that computes the result of a plan of a machine. The command and the Python package call it.

use super::branch::{self, MachineBranched};
use super::curve::{self, MachineEventCurve};
use super::diagram::MachineDiagram;
use super::grid::{MachineBasin, MachineMap};
use super::margins::MachineMargins;
use super::plan::{MachinePlan, MachineTask};
use super::section::{self, MachineSection};
use super::simulate::{MachineSimulated, simulate};
use super::{many, margins, orbits, region, response, verdicts};
use crate::{Control, Regions, ResponseCurves, RunError, in_memory};
use vibroimpact::chaos::Exponents;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::verdict::{Census, Settled};

/// The result of a [`MachineTask`], one variant for each.
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

/// Checks a plan of a machine and computes its result.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
pub fn run_machine(plan: &MachinePlan, control: &Control<'_>) -> Result<MachineResults, RunError> {
    plan.check()?;
    // the plan was checked
    let (machine, start) = plan.described()?;
    Ok(match &plan.task {
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
            MachineResults::Branch(branch::branch(&plan.machine, (&machine, &start), asked, control)?)
        }
        MachineTask::Curve(asked) => {
            MachineResults::Curve(curve::curve(&plan.machine, (&machine, &start), asked, control)?)
        }
        MachineTask::SettleMany(asked) => {
            MachineResults::Map(many::many(&plan.machine, (&machine, &start), asked, control)?)
        }
        MachineTask::Margins(asked) => {
            MachineResults::Margins(margins::margins(&plan.machine, (&machine, &start), asked, control)?)
        }
        MachineTask::Region(asked) => MachineResults::Region(region::regions(&plan.machine, asked, control)?),
        MachineTask::Response(asked) => {
            MachineResults::Response(response::response(&plan.machine, (&machine, &start), asked, control)?)
        }
        MachineTask::Basin(basin) => {
            MachineResults::Basin(in_memory::machine_basin((&machine, &start), basin, control)?)
        }
        MachineTask::Map(map) => MachineResults::Map(in_memory::machine_map(&plan.machine, map, control)?),
        MachineTask::Diagram(diagram) => {
            MachineResults::Diagram(in_memory::machine_diagram(&plan.machine, diagram, control)?)
        }
    })
}
