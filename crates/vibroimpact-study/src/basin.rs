//! Which motion each start of a plane leads to.

use crate::{BasinPlan, Control, PlanError, Stopped, tiles};
use vibroimpact::verdict::{Census, Found, SettleOptions, settle};
use vibroimpact::{Oscillator, Start};

/// The motions of a basin and, for every start, which of them it leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct Basin {
    /// The starts.
    pub plan: BasinPlan,
    /// The motions, in order of first appearance (rows of rising velocity, positions in order within a row).
    pub motions: Vec<Found>,
    /// The motion of each start as an index into `motions`; row by row, one row a velocity.
    pub cells: Vec<u16>,
}

/// Why a basin or map was not completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The plan makes no sense.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// It was stopped from outside.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl Basin {
    /// The start of cell number `k`.
    #[must_use]
    #[allow(clippy::cast_possible_truncation)] // indices of a grid with at most 1e6 values a side
    pub fn start(plan: &BasinPlan, osc: &Oscillator, k: u64) -> Start {
        let columns = u64::from(plan.x.count());
        let (lowest, highest) = Start::room(osc);
        Start {
            // the ends are within the stops; rounding in between must not leave them
            x: plan.x.at((k % columns) as u32).clamp(lowest, highest),
            v: plan.v.at((k / columns) as u32),
            phase: vibroimpact::system::phase::wrap(plan.phase),
        }
    }

    /// The label of cell number `k`.
    #[must_use]
    pub fn label(&self, k: usize) -> std::borrow::Cow<'static, str> {
        self.motions[usize::from(self.cells[k])].verdict.label()
    }

    /// The share of starts that lead to motion number `m`.
    #[must_use]
    #[allow(clippy::cast_precision_loss)]
    pub fn share(&self, m: usize) -> f64 {
        self.motions[m].count as f64 / self.cells.len() as f64
    }
}

/// Points of a tile: large enough that merging costs nothing, small enough to stop quickly and share evenly.
const TILE: u64 = 512;

/// Settles every start of the plane.
///
/// # Errors
/// [`RunError`] for a plan that makes no sense, or when stopped.
pub fn basin(
    osc: &Oscillator,
    plan: &BasinPlan,
    options: &SettleOptions,
    control: &Control<'_>,
) -> Result<Basin, RunError> {
    let total = plan.starts(osc)?;
    let parts = tiles(total, TILE, control, |range, tick| {
        let mut census = Census::default();
        let mut cells = Vec::new();
        for k in range {
            cells.push(census.add(&settle(osc, Basin::start(plan, osc, k), options).verdict));
            if tick() {
                break;
            }
        }
        (census, cells)
    })?;
    let mut merged = Census::default();
    let mut all = Vec::new();
    for (census, cells) in parts {
        let numbers: Vec<usize> = census.motions().iter().map(|found| merged.add_found(found)).collect();
        all.extend(cells.into_iter().map(|local| u16::try_from(numbers[local]).unwrap_or(u16::MAX)));
    }
    Ok(Basin { plan: *plan, motions: merged.motions().to_vec(), cells: all })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_for_any_number_of_threads() {
        let osc = vibroimpact::scenario::S.oscillator();
        let plan = BasinPlan { x: "-4:0.75:50".parse().unwrap(), v: "-4:4:40".parse().unwrap(), phase: 0.0 };
        let run = |threads| {
            basin(&osc, &plan, &SettleOptions::default(), &Control { threads, ..Control::default() }).unwrap()
        };
        let one = run(1);
        assert_eq!(one.cells.len(), 2000);
        assert_eq!(one.motions.iter().map(|m| m.count).sum::<u64>(), 2000);
        assert_eq!(one.motions.len(), 2);
        for threads in [2, 3, 8] {
            assert_eq!(run(threads), one);
        }
    }
}
