//! The plan for the Lyapunov exponents of a machine: of the motion from its start, or at each point of a grid.

use super::grid::{StartAxis, check_axes};
use crate::dynamics::refused;
use crate::machine::MachineSource;
use crate::{Control, LyapunovPlan, PlanError, RunError, Stopped, limits};
use vibroimpact::chaos::{DEFAULT_EVENTS, DEFAULT_MACHINE_TRANSIENT, Exponents, machine_exponents_while};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;

/// The smallest and the largest number of events of a measurement.
const LEAST_IMPACTS: u64 = 25;
const MOST_IMPACTS: u64 = 10_000_000;

impl LyapunovPlan<String> {
    /// The numbers of events of the measurement and of the transient, which were checked.
    pub(crate) fn events(&self) -> (u32, u32) {
        let count = |given: Option<u64>| given.map(|given| u32::try_from(given).unwrap_or(u32::MAX));
        let (impacts, transient) = (count(self.impacts), count(self.transient));
        (impacts.unwrap_or(DEFAULT_EVENTS), transient.unwrap_or(DEFAULT_MACHINE_TRANSIENT))
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
        if self.points.is_some() && machine.period().is_none() {
            return Err(PlanError::UnforcedSection);
        }
        limits::section(self.points)?;
        limits::measured(self.impacts, LEAST_IMPACTS..=MOST_IMPACTS, self.transient)?;
        if self.axes.is_empty() {
            return Ok(());
        }
        check_axes("study of exponents", &self.axes)?;
        for axis in &self.axes {
            if StartAxis::found(machine, &axis.vary)?.is_none() {
                source.number(&axis.vary)?;
            }
        }
        Ok(())
    }

    /// All exponents of the motion from the start.
    pub(super) fn run(
        &self,
        machine: &Machine,
        start: &Start,
        control: &Control<'_>,
    ) -> Result<Exponents<Machine>, RunError> {
        if let Some(axis) = self.axes.first() {
            let (task, known) = ("measurement of one motion", "none: over axes it is a study");
            return Err(PlanError::WrongAxis { task, name: axis.vary.clone().into(), known }.into());
        }
        let found = machine_exponents_while(machine, start, self.events(), &|| !control.stopping()).map_err(refused)?;
        found.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
    }
}
