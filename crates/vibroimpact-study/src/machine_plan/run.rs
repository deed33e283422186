//! The function that computes the result of a plan of a machine. The command and the Python package call it.

use super::plan::{MachinePlan, MachineTask};
use super::simulate::{MachineSimulated, simulate};
use crate::{Control, RunError};

/// The result of a [`MachineTask`], one variant for each.
#[derive(Clone, Debug, PartialEq)]
pub enum MachineResults {
    /// The events of the motion.
    Simulate(MachineSimulated),
}

/// Checks a plan of a machine and computes its result.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
pub fn run_machine(plan: &MachinePlan, control: &Control<'_>) -> Result<MachineResults, RunError> {
    plan.check()?;
    let (machine, start) = plan.problem()?;
    match plan.task {
        MachineTask::Simulate { impacts, periods } => {
            Ok(MachineResults::Simulate(simulate(&machine, &start, (impacts, periods), control)?))
        }
    }
}
