//! The plan for the Lyapunov exponents of a machine: of the motion from its start, or at each point of a grid.

use super::axis::MachineAxis;
use super::grid::{StartAxis, check_axes};
use super::verdicts::refused;
use crate::machine::MachineSource;
use crate::{Control, PlanError, RunError, Stopped, limits};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::chaos::{DEFAULT_EVENTS, DEFAULT_MACHINE_TRANSIENT, Exponents, machine_exponents_while};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;

/// All Lyapunov exponents of the motion from the start, or at each point of a grid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineLyapunovPlan {
    /// Up to four paths of numbers, `q.COORDINATE`, `qdot.COORDINATE` or `phase`; the first varies fastest. Nothing varies
    /// when absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub axes: Vec<MachineAxis>,
    /// Events to measure over: 25 to 10000000. 20000 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
    /// Events to pass before: up to 1000000. 1000 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transient: Option<u32>,
    /// Points to show of each section of the attractor: 1 to 100000; none when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<u64>,
}

/// The smallest and the largest number of events of a measurement, and the longest transient.
const LEAST_IMPACTS: u64 = 25;
const MOST_IMPACTS: u64 = 10_000_000;
const MOST_TRANSIENT: u64 = 1_000_000;

impl MachineLyapunovPlan {
    /// The numbers of events of the measurement and of the transient.
    pub(crate) fn lengths(&self) -> (u32, u32) {
        (self.impacts.unwrap_or(DEFAULT_EVENTS), self.transient.unwrap_or(DEFAULT_MACHINE_TRANSIENT))
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
        let (least, most) = (LEAST_IMPACTS, MOST_IMPACTS);
        if let Some(given) = self.impacts.map(u64::from).filter(|given| !(least..=most).contains(given)) {
            return Err(PlanError::Measured { given, least, most });
        }
        if let Some(given) = self.transient.map(u64::from).filter(|given| *given > MOST_TRANSIENT) {
            return Err(PlanError::Transient { given, most: MOST_TRANSIENT });
        }
        if self.axes.is_empty() {
            return Ok(());
        }
        check_axes(&self.axes)?;
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
        start: &MachineStart,
        control: &Control<'_>,
    ) -> Result<Exponents<Machine>, RunError> {
        if let Some(axis) = self.axes.first() {
            let (task, known) = ("measurement of one motion", "none: over axes it is a study");
            return Err(PlanError::WrongAxis { task, name: axis.vary.clone().into(), known }.into());
        }
        let found =
            machine_exponents_while(machine, start, self.lengths(), &|| !control.stopping()).map_err(refused)?;
        found.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
    }
}
