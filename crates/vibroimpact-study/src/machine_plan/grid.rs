//! Plans and results of basins over coordinates, and of maps over numbers, of a machine.

use super::axis::MachineAxis;
use super::verdicts::check_starts;
use crate::limits::MOST_CELLS;
use crate::machine::MachineSource;
use crate::map::{check_impacts, check_refine};
use crate::study::label_of;
use crate::{ListedColumn, PlanError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::{machine_quantities, machine_quantity};
use vibroimpact::verdict::Verdict;

/// Starts of a machine over a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineBasinPlan {
    /// One to four of `q.COORDINATE`, `qdot.COORDINATE` and `phase`; the first varies fastest. The others are those of the
    /// start.
    pub axes: Vec<MachineAxis>,
    /// Where results are stored: compute every K-th point first, K being this number, and the points between only where neighbours
    /// differ. All of them when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refine: Option<u32>,
    /// Budget of events for each start: 1 to 1000000. 20000 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
    /// Quantities of each motion to report beside its label, by path: `power`, `stop.wall.impact_speed_max`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<String>,
}

/// Scattered starts at each point of a grid over numbers of a machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineMapPlan {
    /// One to four paths; the first varies fastest.
    pub axes: Vec<MachineAxis>,
    /// The number of starts at each point.
    pub starts: u64,
    /// Which sequence of starts.
    #[serde(default = "one")]
    pub seed: u64,
    /// As for a basin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refine: Option<u32>,
    /// Budget of events for each start: 1 to 1000000. 20000 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
    /// Quantities of each motion to report beside its label, by path: `power`, `stop.wall.impact_speed_max`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<String>,
}

const fn one() -> u64 {
    1
}

/// The motion of each start of a grid.
#[derive(Clone, Debug)]
pub struct MachineBasin {
    /// The axes; the first varies fastest.
    pub axes: Vec<MachineAxis>,
    /// The motions, in the order of their first start.
    pub motions: Vec<Verdict<Machine>>,
    /// The motion of each start as an index; `None` where a start lies beyond a rigid stop.
    pub cells: Vec<Option<usize>>,
    /// The number of events over which chaos was seen from each start; `None` unless its motion is chaotic.
    pub seen_events: Vec<Option<u64>>,
    /// The paths of the quantities that the plan asks for, and the values of each motion.
    pub fields: Vec<String>,
    /// For each motion a value of each field; not-a-number where it is not defined.
    pub quantities: Vec<Vec<f64>>,
}

/// The motions at each point of a grid of numbers.
#[derive(Clone, Debug)]
pub struct MachineMap {
    /// The axes; the first varies fastest.
    pub axes: Vec<MachineAxis>,
    /// The points as columns, where they are no grid; empty for a grid.
    pub points: Vec<ListedColumn<String>>,
    /// The motions at each point, the most frequent first. Two motions of one label have a row each. Empty where the numbers
    /// are not allowed.
    pub cells: Vec<Vec<MachineShare>>,
    /// The paths of the quantities that the plan asks for.
    pub fields: Vec<String>,
}

/// A motion at a point of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineShare {
    /// The [code](crate::study::code) of its label.
    pub code: i32,
    /// The share of the starts that lead to it, from 0 to 1.
    pub share: f64,
    /// The largest speed of a closing; not-a-number unless it is a cycle.
    pub speed: f64,
    /// The largest modulus of the multipliers; not-a-number unless it is a cycle.
    pub multiplier: f64,
    /// The stops that stay closed for ever, by their numbers from 0.
    pub stops: Vec<usize>,
    /// The number of events over which chaos was seen; `None` unless it is chaotic.
    pub seen_events: Option<u64>,
    /// A value of each field of the plan; not-a-number where it is not defined.
    pub quantities: Vec<f64>,
}

impl MachineShare {
    /// The label as text.
    #[must_use]
    pub fn label(&self) -> String {
        label_of(self.code).unwrap_or_default()
    }
}

impl MachineBasin {
    /// For each motion the number of starts that lead to it, and their share of all that are allowed.
    #[must_use]
    #[allow(clippy::cast_precision_loss)] // counts of starts
    pub fn shares(&self) -> Vec<(u64, f64)> {
        let mut counts = vec![0_u64; self.motions.len()];
        self.cells.iter().flatten().for_each(|cell| counts[*cell] += 1);
        let total: u64 = counts.iter().sum();
        counts.into_iter().map(|count| (count, count as f64 / total.max(1) as f64)).collect()
    }

    /// The number of starts beyond a rigid stop.
    #[must_use]
    pub fn refused(&self) -> usize {
        self.cells.iter().filter(|cell| cell.is_none()).count()
    }
}

impl MachineMap {
    /// What varies.
    pub fn varied(&self) -> impl Iterator<Item = &str> {
        let columns = self.points.iter().map(|column| column.vary.as_str());
        self.axes.iter().map(|axis| axis.vary.as_str()).chain(columns)
    }

    /// Its values at point number `k`.
    #[must_use]
    pub fn at(&self, k: usize) -> Vec<f64> {
        let columns = self.points.iter().map(|column| column.values[k]);
        MachineAxis::at(&self.axes, k as u64).into_iter().chain(columns).collect()
    }

    /// The smallest number of events over which chaos was seen at a point; `None` if it was seen at none.
    #[must_use]
    pub fn seen_events(&self) -> Option<u64> {
        self.cells.iter().flatten().filter_map(|motion| motion.seen_events).min()
    }

    /// The number of points at which each label occurs.
    #[must_use]
    pub fn labels(&self) -> BTreeMap<String, u64> {
        let mut labels = BTreeMap::new();
        for cell in &self.cells {
            // two motions at a point can have one label
            let here: BTreeSet<String> = cell.iter().map(MachineShare::label).collect();
            here.into_iter().for_each(|label| *labels.entry(label).or_insert(0) += 1);
        }
        labels
    }
}

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
    pub(crate) fn set(&self, start: &mut MachineStart, value: f64) {
        match self {
            Self::Q(i) => start.q[*i] = value,
            Self::Qdot(i) => start.qdot[*i] = value,
            Self::Phase => start.phase = value,
        }
    }
}

pub(super) fn check_axes(axes: &[MachineAxis]) -> Result<(), PlanError> {
    if axes.is_empty() || axes.len() > 4 {
        return Err(PlanError::MachineAxes(axes.len()));
    }
    axes.iter().try_for_each(|axis| axis.over.check())?;
    none_twice(axes.iter().map(|axis| axis.vary.clone()))
}

/// Refuses a path that varies twice.
pub(super) fn none_twice(varied: impl Iterator<Item = String>) -> Result<(), PlanError> {
    let mut paths: Vec<String> = Vec::new();
    for path in varied {
        if paths.contains(&path) {
            return Err(PlanError::MachineAxisTwice(path));
        }
        paths.push(path);
    }
    Ok(())
}

/// Refuses a grid whose results do not fit in memory; a store has no such limit.
pub(crate) fn check_memory(axes: &[MachineAxis], starts: u64) -> Result<(), PlanError> {
    let total = MachineAxis::points(axes).saturating_mul(starts);
    if total > MOST_CELLS { Err(PlanError::Memory { numbers: total, most: MOST_CELLS }) } else { Ok(()) }
}

impl MachineBasinPlan {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, machine: &Machine) -> Result<(), PlanError> {
        check_axes(&self.axes)?;
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

impl MachineMapPlan {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        check_axes(&self.axes)?;
        for axis in &self.axes {
            source.number(&axis.vary)?;
        }
        check_fields(&source.machine()?, &self.fields)?;
        check_refine(self.refine)?;
        check_starts(self.starts, self.impacts)
    }
}
