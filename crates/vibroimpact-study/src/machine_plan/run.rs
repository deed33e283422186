//! The function that computes the result of a plan of a machine. The command and the Python package call it.

use super::curve::{self, MachineEventCurve};
use super::diagram::MachineDiagram;
use super::grid::{MachineBasin, MachineMap};
use super::orbits::MachineBranched;
use super::plan::{MachinePlan, MachineTask};
use super::simulate::{MachineSimulated, simulate};
use super::{orbits, verdicts};
use crate::{Control, RunError, in_memory};
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
    /// The exponents.
    Lyapunov(MachineExponents),
    /// The orbits, the fastest last.
    Orbit(Vec<MachineCycle>),
    /// The branch.
    Branch(MachineBranched),
    /// The curve.
    Curve(MachineEventCurve),
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
        MachineTask::Lyapunov { impacts, transient } => {
            MachineResults::Lyapunov(verdicts::lyapunov(&machine, &start, (*impacts, *transient), control)?)
        }
        MachineTask::Orbit { label } => {
            MachineResults::Orbit(orbits::orbits(&machine, orbits::label(&machine, label)?, control)?)
        }
        MachineTask::Branch { label, vary, to, points, follow } => {
            let label = label.as_deref().map(|label| orbits::label(&machine, label)).transpose()?;
            MachineResults::Branch(orbits::branch(
                &plan.machine,
                (&machine, &start),
                (label, vary, *to),
                (*points, *follow),
                control,
            )?)
        }
        MachineTask::Curve(asked) => {
            MachineResults::Curve(curve::curve(&plan.machine, (&machine, &start), asked, control)?)
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
