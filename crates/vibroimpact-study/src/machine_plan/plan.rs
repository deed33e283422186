//! A plan of a machine: everything on which a result depends, and nothing else.

use super::simulate::check;
use crate::machine::{MachineSource, NumberText, StartNumbers, StartText, VectorText};
use crate::{PLAN_VERSION, PlanError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::events::{MachineLimits, MachineMotion, MachineStart};
use vibroimpact::machine::Machine;

/// A question about a machine.
///
/// ```
/// use vibroimpact_study::{Control, MachinePlan, MachineResults, run_machine};
/// let plan = MachinePlan::from_text(r#"
///     version = 1
///     [start]
///     q = [0.5]
///     [machine]
///     bodies = { ball = 1 }
///     constant = { ball = -1 }
///     stop = [{ name = "floor", between = ["ground", "ball"], gap = 0, restitution = 0.5 }]
///     [task.simulate]
///     impacts = 3
/// "#, vibroimpact_study::machine::no_files)?;
/// let MachineResults::Simulate(found) = run_machine(&plan, &Control::default())? else { unreachable!() };
/// assert_eq!(found.events.iter().map(|event| event.time).collect::<Vec<_>>(), [1.0, 2.0, 2.5]);
/// assert_eq!(MachinePlan::from_text(&plan.to_toml(), vibroimpact_study::machine::no_files)?, plan);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "super::text::MachinePlanText", into = "super::text::MachinePlanText")]
pub struct MachinePlan {
    /// The version of the fields, [`PLAN_VERSION`].
    pub version: u32,
    /// The machine as it is written. Its table `[start]` is where the motion starts; at rest at 0 when absent.
    pub machine: MachineSource,
    /// What is computed.
    pub task: MachineTask,
}

/// What is computed for a machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MachineTask {
    /// The events of a motion.
    Simulate {
        /// The largest number of events: 1 to 10000000. 100 when absent, or 1000000 with `periods`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        impacts: Option<u64>,
        /// The largest number of forcing periods, up to 1e9; no limit when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        periods: Option<f64>,
    },
}

impl MachinePlan {
    /// A plan of the current version.
    #[must_use]
    pub const fn new(machine: MachineSource, task: MachineTask) -> Self {
        Self { version: PLAN_VERSION, machine, task }
    }

    /// The same plan with another start. Vectors that are empty are 0.
    #[must_use]
    pub fn starting(mut self, start: &MachineStart) -> Self {
        let vector = |values: &[f64]| {
            let list = values.iter().map(|value| NumberText::Value(*value)).collect();
            (!values.is_empty()).then_some(VectorText::List(list))
        };
        let phase = (start.phase != 0.0).then_some(NumberText::Value(start.phase));
        let text = StartText { q: vector(&start.q), qdot: vector(&start.qdot), phase };
        self.machine.start = (text != StartText::default()).then_some(text);
        self
    }

    /// The plan as JSON.
    #[must_use]
    pub fn json(&self) -> String {
        // finite numbers and texts can always be written as JSON
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The start, with a number for each coordinate and velocity.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that has no meaning.
    pub fn start(&self) -> Result<MachineStart, PlanError> {
        let StartNumbers { q, qdot, phase } = self.machine.start()?;
        Ok(MachineStart { q, qdot, phase })
    }

    /// The machine and the start, both checked.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that is not allowed.
    pub fn problem(&self) -> Result<(Machine, MachineStart), PlanError> {
        let (machine, start) = (self.machine.machine()?, self.start()?);
        let limits = MachineLimits::default();
        MachineMotion::new(&machine, &start, limits).map_err(|error| PlanError::Machine(error.into()))?;
        Ok((machine, start))
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self) -> Result<(), PlanError> {
        if self.version != PLAN_VERSION {
            return Err(PlanError::Version(self.version));
        }
        let (machine, _) = self.problem()?;
        match &self.task {
            MachineTask::Simulate { impacts, periods } => check(&machine, (*impacts, *periods)),
        }
    }
}
