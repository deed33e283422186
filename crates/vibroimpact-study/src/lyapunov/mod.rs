//! The plan for the Lyapunov exponents of a motion: its start, the length of the measurement, and whether sections are
//! computed.

mod section;

use crate::axis::{self, Axis, Coordinate};
use crate::machine::{MachineSource, StartAxis};
use crate::name::renamed;
use crate::{PlanError, StartPlan, SystemPlan, limits};
pub(crate) use section::section;
pub use section::{SectionClosing, SectionPoints};
use serde::{Deserialize, Serialize};
use vibroimpact::chaos::{
    DEFAULT_EVENTS, DEFAULT_IMPACTS, DEFAULT_MACHINE_TRANSIENT, DEFAULT_TRANSIENT, ExponentOptions,
};
use vibroimpact::machine::Machine;

/// Default number of points of each section.
pub const DEFAULT_POINTS: u64 = 5_000;

/// The exponents of the motion from a start, or from each start of each system of a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound(serialize = "V: Serialize", deserialize = "V: Deserialize<'de>"))]
#[schemars(rename = "LyapunovPlan", bound = "V: schemars::JsonSchema + Serialize")]
pub struct LyapunovPlan<V = Coordinate> {
    /// What varies, parameters and coordinates of the start; nothing when absent. The first runs fastest.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub axes: Vec<Axis<V>>,
    /// Where an oscillator starts, as far as it is on no axis; at rest when absent. A machine has a start of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartPlan>,
    /// Impacts to measure over: 1000 to 10000000, 100000 when absent; of a machine events, 25 to 10000000, 20000 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u64>,
    /// Impacts to pass before, of a machine events: up to 1000000, 1000 when absent. For the stroboscopic section forcing periods.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transient: Option<u64>,
    /// Number of points of each section of the attractor, 1 to 100000; no sections when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<u64>,
}

impl<V> Default for LyapunovPlan<V> {
    /// From rest, of usual lengths, without sections.
    fn default() -> Self {
        Self { axes: Vec::new(), start: None, impacts: None, transient: None, points: None }
    }
}

renamed!(LyapunovPlan: names, parts axes, others start impacts transient points);

impl<V> LyapunovPlan<V> {
    /// The impacts of an oscillator to measure over, and those to pass before.
    #[must_use]
    pub fn lengths(&self) -> (u64, u64) {
        (self.impacts.unwrap_or(DEFAULT_IMPACTS), self.transient.unwrap_or(DEFAULT_TRANSIENT))
    }
}

/// Maximum number of axes.
const MOST_AXES: usize = 4;
/// Minimum number of impacts: with fewer there is no error bar.
const FEWEST_IMPACTS: u64 = 1_000;
/// Maximum number of impacts of a measurement; it takes several seconds.
const MOST_IMPACTS: u64 = 10_000_000;

impl LyapunovPlan {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        let (impacts, transient) = self.lengths();
        limits::measured(Some(impacts), FEWEST_IMPACTS..=MOST_IMPACTS, Some(transient))?;
        limits::section(self.points)?;
        axis::check("study of exponents", &self.axes, (0, MOST_AXES))?;
        for corner in axis::corners(&self.axes) {
            let there = axis::system_at(system, &self.axes, |k| corner[k])?;
            let start = axis::start_at((system, &there), &self.start(), &self.axes, |k| corner[k]);
            start.start(&there.oscillator()?)?;
        }
        Ok(())
    }

    /// The coordinates of the start that are on no axis.
    pub(crate) fn start(&self) -> StartPlan {
        self.start.unwrap_or_default()
    }

    /// The lengths of the transient and of the measurement.
    pub(crate) fn options(&self) -> ExponentOptions {
        let (impacts, transient) = self.lengths();
        ExponentOptions::new(impacts, transient)
    }
}

/// Minimum number of events of a measurement of a machine.
const FEWEST_EVENTS: u64 = 25;

impl LyapunovPlan<String> {
    /// The numbers of events of the measurement and of the transient, which were checked.
    pub(crate) fn events(&self) -> (u32, u32) {
        let count = |given: Option<u64>| given.map(|given| u32::try_from(given).unwrap_or(u32::MAX));
        let (impacts, transient) = (count(self.impacts), count(self.transient));
        (impacts.unwrap_or(DEFAULT_EVENTS), transient.unwrap_or(DEFAULT_MACHINE_TRANSIENT))
    }

    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
        if self.points.is_some() && machine.period().is_none() {
            let sentence = "the machine has no forcing, so its attractor has no section at a phase";
            return Err(PlanError::refused(sentence));
        }
        limits::section(self.points)?;
        limits::measured(self.impacts, FEWEST_EVENTS..=MOST_IMPACTS, self.transient)?;
        axis::check("study of exponents", &self.axes, (0, MOST_AXES))?;
        for axis in &self.axes {
            if StartAxis::found(machine, &axis.vary)?.is_none() {
                source.number(&axis.vary)?;
            }
        }
        Ok(())
    }
}
