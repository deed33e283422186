//! Which motion each start of a plane leads to.

use crate::{BasinPlan, Control, PlanError, Stopped, tiles};
use vibroimpact::lanes::Width;
use vibroimpact::verdict::{Atlas, Census, Found, SettleOptions, settle_many};
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
const TILE: u64 = 4096;
/// Starts settled beforehand, spread over the plane, to know its cycles and their traps.
const SURVEY: u64 = 24;

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
    in_tiles(osc, plan, options, control, TILE)
}

fn in_tiles(
    osc: &Oscillator,
    plan: &BasinPlan,
    options: &SettleOptions,
    control: &Control<'_>,
    tile: u64,
) -> Result<Basin, RunError> {
    let total = plan.starts(osc)?;
    let start = |k: u64| Basin::start(plan, osc, k);
    let atlas = Atlas::survey(osc, (0..SURVEY.min(total)).map(|k| start(total / SURVEY.min(total) * k)), options);
    let parts = tiles(total, tile, control, |range, tick| {
        let settlement = settle_many(osc, range, start, &atlas, options, Width::best(), tick);
        let cells: Vec<u16> = settlement.cells.iter().map(|&cell| u16::try_from(cell).unwrap_or(u16::MAX)).collect();
        (settlement.motions, cells)
    })?;
    let mut merged = Census::default();
    let mut all = Vec::with_capacity(usize::try_from(total).unwrap_or(0));
    for (motions, cells) in parts {
        let numbers: Vec<u16> =
            motions.iter().map(|found| u16::try_from(merged.add_found(found)).unwrap_or(u16::MAX)).collect();
        all.extend(cells.into_iter().map(|local| numbers[usize::from(local)]));
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
        for tile in [1, 7, 64, 999, 100_000] {
            let control = Control { threads: 2, ..Control::default() };
            assert_eq!(in_tiles(&osc, &plan, &SettleOptions::default(), &control, tile).unwrap(), one, "{tile}");
        }
    }

    /// As one start after another, without lanes and traps.
    #[test]
    fn the_same_as_one_by_one() {
        let osc = vibroimpact::scenario::R.oscillator();
        let plan = BasinPlan { x: "-4:2.25:40".parse().unwrap(), v: "-4:4:30".parse().unwrap(), phase: 0.5 };
        let got = basin(&osc, &plan, &SettleOptions::default(), &Control::default()).unwrap();
        let mut census = Census::default();
        let one_by_one = |k| {
            let verdict = vibroimpact::verdict::settle(&osc, Basin::start(&plan, &osc, k), &SettleOptions::default());
            census.add(&verdict.verdict)
        };
        let cells: Vec<usize> = (0..1200).map(one_by_one).collect();
        assert_eq!(got.cells.iter().map(|&cell| usize::from(cell)).collect::<Vec<_>>(), cells);
        assert_eq!(got.motions, census.motions());
    }
}
