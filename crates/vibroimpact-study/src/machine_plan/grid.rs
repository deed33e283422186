//! Plans and results of basins over coordinates, and of maps over numbers, of a machine.

use super::verdicts::check_starts;
use crate::limits::MOST_CELLS;
use crate::machine::MachineSource;
use crate::map::{check_impacts, check_refine};
use crate::{Axis, BasinPlan, MapPlan, PlanError};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::{machine_quantities, machine_quantity};
use vibroimpact::verdict::Verdict;

/// Where an axis of a basin stands in a start.
pub(crate) enum StartAxis {
    Q(usize),
    Qdot(usize),
    Phase,
}

impl StartAxis {
    /// The place with this name.
    ///
    /// # Errors
    /// [`PlanError::MachineStartAxis`] if it is no part of a start of the machine.
    pub(crate) fn of(machine: &Machine, vary: &str) -> Result<Self, PlanError> {
        Self::found(machine, vary)?.ok_or_else(|| Self::unknown(machine, vary))
    }

    /// The place with this name; `None` for the path of something else.
    ///
    /// # Errors
    /// [`PlanError::MachineStartAxis`] for a coordinate or velocity that the machine does not have.
    pub(crate) fn found(machine: &Machine, vary: &str) -> Result<Option<Self>, PlanError> {
        let names = &machine.parts().coordinates;
        let of = |name: &str| {
            let place = names.iter().position(|known| known == name);
            place.ok_or_else(|| Self::unknown(machine, vary))
        };
        Ok(match vary.split_once('.') {
            Some(("q", name)) => Some(Self::Q(of(name)?)),
            Some(("qdot", name)) => Some(Self::Qdot(of(name)?)),
            None if vary == "phase" => Some(Self::Phase),
            _ => None,
        })
    }

    fn unknown(machine: &Machine, vary: &str) -> PlanError {
        PlanError::MachineStartAxis { given: vary.to_owned(), coordinates: machine.parts().coordinates.join(", ") }
    }

    /// Puts a value there.
    pub(crate) fn set(&self, start: &mut Start, value: f64) {
        match self {
            Self::Q(i) => start.q[*i] = value,
            Self::Qdot(i) => start.qdot[*i] = value,
            Self::Phase => start.phase = value,
        }
    }
}

/// Checks the axes of a grid.
pub(super) fn check_axes(task: &'static str, axes: &[Axis<String>]) -> Result<(), PlanError> {
    let (given, least, most) = (axes.len(), 1, 4);
    if !(least..=most).contains(&given) {
        return Err(PlanError::Axes { given, task, least, most });
    }
    axes.iter().try_for_each(|axis| axis.over.check())?;
    none_twice(axes.iter().map(|axis| axis.vary.clone()))
}

/// Refuses a path that varies twice.
pub(super) fn none_twice(varied: impl Iterator<Item = String>) -> Result<(), PlanError> {
    let mut paths: Vec<String> = Vec::new();
    for path in varied {
        if paths.contains(&path) {
            return Err(PlanError::SameParameter(path.clone().into(), path.into()));
        }
        paths.push(path);
    }
    Ok(())
}

/// Refuses a grid whose results do not fit in memory; a store has no such limit.
pub(crate) fn check_memory(axes: &[Axis<String>], starts: u64) -> Result<(), PlanError> {
    let total = crate::axis::points(axes).saturating_mul(starts);
    if total > MOST_CELLS { Err(PlanError::Memory { numbers: total, most: MOST_CELLS }) } else { Ok(()) }
}

impl BasinPlan<String, String> {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, machine: &Machine) -> Result<(), PlanError> {
        if self.points.is_some() || self.transient {
            return Err(PlanError::NoPoints);
        }
        check_axes("basin", &self.axes)?;
        for axis in &self.axes {
            StartAxis::of(machine, &axis.vary)?;
        }
        check_fields(machine, &self.fields)?;
        check_refine(self.refine)?;
        check_impacts(self.impacts)
    }
}

/// Checks that the paths lead to quantities of a machine.
pub(super) fn check_fields(machine: &Machine, fields: &[String]) -> Result<(), PlanError> {
    let known = |path: &String| machine_quantity(machine, path).map(|_| ());
    fields.iter().try_for_each(known).map_err(|error| PlanError::Machine(error.into()))
}

/// The values of the fields for a motion; not-a-number where they are not defined.
pub(crate) fn values_of(machine: &Machine, verdict: &Verdict<Machine>, fields: &[String]) -> Vec<f64> {
    if fields.is_empty() {
        return Vec::new();
    }
    let found = machine_quantities(machine, verdict);
    let value = |path: &String| found.as_ref().and_then(|found| found.value(machine, path).ok()).unwrap_or(f64::NAN);
    fields.iter().map(value).collect()
}

impl MapPlan<String, String> {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        check_axes("map", &self.axes)?;
        for axis in &self.axes {
            source.number(&axis.vary)?;
        }
        check_fields(&source.machine()?, &self.fields)?;
        check_refine(self.refine)?;
        check_starts(self.starts, self.impacts)
    }
}
