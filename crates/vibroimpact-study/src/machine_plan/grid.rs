//! Basins over coordinates, and maps over numbers, of a machine.

use super::axis::MachineAxis;
use super::verdicts::{check_starts, each_verdict, number};
use crate::limits::MOST_CELLS;
use crate::machine::MachineSource;
use crate::map::check_impacts;
use crate::{Control, PlanError, RunError};
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{MachineVerdict, scattered_machine_starts};

/// The motion of each start of a grid.
#[derive(Clone, Debug)]
pub struct MachineBasin {
    /// The axes; the first varies fastest.
    pub axes: Vec<MachineAxis>,
    /// The motions, in the order of their first start.
    pub motions: Vec<MachineVerdict>,
    /// The motion of each start as an index; `None` where a start lies beyond a rigid stop.
    pub cells: Vec<Option<usize>>,
}

/// The motions at each point of a grid of numbers.
#[derive(Clone, Debug)]
pub struct MachineMap {
    /// The axes; the first varies fastest.
    pub axes: Vec<MachineAxis>,
    /// At each point the labels and the shares of the starts that lead to them, the most frequent first. Two motions of one
    /// label have a row each. Empty where the numbers are not allowed.
    pub cells: Vec<Vec<(String, f64)>>,
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
    /// The number of points at which each label occurs.
    #[must_use]
    pub fn labels(&self) -> BTreeMap<&str, u64> {
        let mut labels = BTreeMap::new();
        for cell in &self.cells {
            // two motions at a point can have one label
            let here: BTreeSet<&str> = cell.iter().map(|(label, _)| label.as_str()).collect();
            here.into_iter().for_each(|label| *labels.entry(label).or_insert(0) += 1);
        }
        labels
    }
}

/// The number of points of a grid.
fn points(axes: &[MachineAxis]) -> u64 {
    axes.iter().fold(1, |product, axis| product.saturating_mul(u64::from(axis.over.count())))
}

/// Where an axis of a basin stands in a start.
enum Place {
    Q(usize),
    Qdot(usize),
    Phase,
}

fn place(machine: &Machine, vary: &str) -> Result<Place, PlanError> {
    let names = &machine.parts().coordinates;
    let of = |name: &str| names.iter().position(|known| known == name);
    let found = match vary.split_once('.') {
        Some(("q", name)) => of(name).map(Place::Q),
        Some(("qdot", name)) => of(name).map(Place::Qdot),
        None if vary == "phase" => Some(Place::Phase),
        _ => None,
    };
    found.ok_or_else(|| PlanError::MachineStartAxis { given: vary.to_owned(), coordinates: names.join(", ") })
}

fn check_axes(axes: &[MachineAxis], starts: u64) -> Result<(), PlanError> {
    if axes.is_empty() || axes.len() > 4 {
        return Err(PlanError::MachineAxes(axes.len()));
    }
    if let Some(twice) =
        axes.iter().enumerate().find(|(k, axis)| axes[..*k].iter().any(|other| other.vary == axis.vary))
    {
        return Err(PlanError::MachineAxisTwice(twice.1.vary.clone()));
    }
    let total = points(axes).saturating_mul(starts);
    if total > MOST_CELLS { Err(PlanError::Memory { numbers: total, most: MOST_CELLS }) } else { Ok(()) }
}

pub(super) fn check_basin(machine: &Machine, axes: &[MachineAxis], impacts: Option<u32>) -> Result<(), PlanError> {
    check_axes(axes, 1)?;
    for axis in axes {
        place(machine, &axis.vary)?;
    }
    check_impacts(impacts)
}

pub(super) fn check_map(
    source: &MachineSource,
    axes: &[MachineAxis],
    (starts, impacts): (u64, Option<u32>),
) -> Result<(), PlanError> {
    check_axes(axes, starts)?;
    for axis in axes {
        source.number(&axis.vary)?;
    }
    check_starts(starts, impacts)
}

/// Settles every start of a grid.
pub(super) fn basin(
    (machine, start): (&Machine, &MachineStart),
    axes: &[MachineAxis],
    impacts: Option<u32>,
    control: &Control<'_>,
) -> Result<MachineBasin, RunError> {
    let places: Vec<Place> = axes.iter().map(|axis| place(machine, &axis.vary)).collect::<Result<_, _>>()?;
    let n = machine.n();
    let problem = |k| {
        let mut start = start.clone();
        start.q.resize(n, 0.0);
        start.qdot.resize(n, 0.0);
        for (place, value) in places.iter().zip(MachineAxis::at(axes, k)) {
            match place {
                Place::Q(i) => start.q[*i] = value,
                Place::Qdot(i) => start.qdot[*i] = value,
                Place::Phase => start.phase = value,
            }
        }
        Some((machine.clone(), start))
    };
    let mut motions = Vec::new();
    let verdicts = each_verdict(points(axes), control, problem, impacts)?;
    let cells = verdicts.iter().map(|verdict| verdict.as_ref().map(|verdict| number(&mut motions, verdict))).collect();
    Ok(MachineBasin { axes: axes.to_vec(), motions, cells })
}

/// Settles scattered starts at every point of a grid of numbers.
pub(super) fn map(
    source: &MachineSource,
    axes: &[MachineAxis],
    (starts, seed, impacts): (u64, u64, Option<u32>),
    control: &Control<'_>,
) -> Result<MachineMap, RunError> {
    let problem = |k: u64| {
        let mut source = source.clone();
        for (axis, value) in axes.iter().zip(MachineAxis::at(axes, k / starts)) {
            source = source.with(&axis.vary, value).ok()?;
        }
        let machine = source.machine().ok()?;
        let start = scattered_machine_starts(&machine, seed, k % starts);
        Some((machine, start))
    };
    let verdicts = each_verdict(points(axes) * starts, control, problem, impacts)?;
    let cells = verdicts
        .chunks(usize::try_from(starts).unwrap_or(1))
        .map(|at| {
            let mut motions = Vec::new();
            let mut counts: Vec<u64> = Vec::new();
            for verdict in at.iter().flatten() {
                let k = number(&mut motions, verdict);
                counts.resize(motions.len(), 0);
                counts[k] += 1;
            }
            let total: u64 = counts.iter().sum();
            #[allow(clippy::cast_precision_loss)] // counts of starts
            let share = |count: u64| count as f64 / total as f64;
            let mut found: Vec<(String, f64)> =
                motions.iter().zip(counts).map(|(motion, count)| (motion.label(), share(count))).collect();
            found.sort_by(|a, b| b.1.total_cmp(&a.1));
            found
        })
        .collect();
    Ok(MachineMap { axes: axes.to_vec(), cells })
}
