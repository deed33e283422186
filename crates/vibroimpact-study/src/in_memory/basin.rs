//! A basin in memory: its tiles are joined, and the motions are in the order of the first start that leads to each.

use crate::basin::{Basin, BasinPlan, start};
use crate::map::options;
use crate::quantity::values_of;
use crate::study::{BasinFill, BasinTile, Basins, Cell, Fill, MachineBasin, tiles_of};
use crate::{Block, Control, PlanError, RunError, Stopped, SystemPlan, axis};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{Census, CountedMotion, System, Undecided, UndecidedCause, Verdict, settle, settle_machine};

/// Approximate number of starts of a tile: large enough that joining takes no noticeable time, small enough to stop
/// quickly and to use all threads.
const TILE: u32 = 8192;

/// Settles every start of the basin of one system, without refinement.
pub(crate) fn basin(system: &SystemPlan, plan: &BasinPlan, control: &Control<'_>) -> Result<Basin, RunError> {
    in_tiles(system, plan, control, TILE)
}

fn in_tiles(system: &SystemPlan, plan: &BasinPlan, control: &Control<'_>, tile: u32) -> Result<Basin, RunError> {
    let osc = &system.oscillator()?;
    if let Some(axis) = plan.axes.iter().find(|axis| !axis.vary.is_start()) {
        let (task, name) = ("basin of one system", axis.vary.name().into());
        return Err(PlanError::WrongAxis { task, name, known: "x, v and phase" }.into());
    }
    if plan.points.is_some() {
        let (task, name) = ("basin of one system", "point".into());
        return Err(PlanError::WrongAxis { task, name, known: "x, v and phase" }.into());
    }
    axis::check_memory("starts", &plan.axes)?;
    let dimensions = i32::try_from(plan.axes.len()).unwrap_or(1);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at least 1, at most 4096
    let side = f64::from(tile).powf(1.0 / f64::from(dimensions)).round().max(1.0) as u32;
    let task = BasinFill::plane(system, &BasinPlan { refine: None, ..plan.clone() }, Some(side))?;
    let first = |k: usize| settle(osc, start(osc, plan, k as u64), &options(plan.impacts)).verdict;
    let Joined { motions, cells } = all(&task, first, |_, _| {}, control)?;
    let quantities = |motion: &CountedMotion| {
        let found = if plan.fields.is_empty() { None } else { of_verdict_only(osc, &motion.verdict, &plan.fields) };
        found.map_or_else(Vec::new, |found| plan.fields.iter().map(|field| found.get(*field)).collect())
    };
    Ok(Basin::new(plan.clone(), (motions, cells), Vec::new(), quantities)?)
}

/// The same of a machine.
pub(crate) fn machine_basin(
    problem: (&Machine, &Start),
    plan: &BasinPlan<String, String>,
    control: &Control<'_>,
) -> Result<Basin<Machine, String, String>, RunError> {
    axis::check_memory("starts", &plan.axes)?;
    let task = BasinFill::of_machine(problem, &BasinPlan { refine: None, ..plan.clone() }, None)?;
    let whole = task.over().grid.whole();
    let mut seen_events = vec![None; whole.points()];
    // a start that has a motion was settled before
    let unknown = Verdict::Undecided(Undecided { why: UndecidedCause::Budget, impacts: 0, spectrum: None });
    let first = |k| {
        let settled = settle_machine(problem.0, &task.of.start(&whole.index(k)), &options(plan.impacts));
        settled.map_or_else(|_| unknown.clone(), |settled| settled.verdict)
    };
    let seen = |block: &Block, tile: &BasinTile<MachineBasin>| {
        for (k, events) in &tile.notes {
            seen_events[whole.number(&block.index(*k))] = Some(*events);
        }
    };
    let Joined { motions, cells } = all(&task, first, seen, control)?;
    let quantities = |motion: &CountedMotion<Machine>| values_of(problem.0, &motion.verdict, &plan.fields);
    Ok(Basin::new(plan.clone(), (motions, cells), seen_events, quantities)?)
}

/// The motions of all tiles, and for each start the index of its motion.
struct Joined<S: System> {
    motions: Vec<CountedMotion<S>>,
    cells: Vec<Option<usize>>,
}

/// The motions of all starts. `settled` returns the verdict on the start at a point of the grid; `note` is called for each tile.
///
/// The verdict on a motion is that of its first start, so it does not depend on the tiles.
fn all<B: Basins>(
    task: &BasinFill<B>,
    settled: impl Fn(usize) -> Verdict<B::System>,
    mut note: impl FnMut(&Block, &BasinTile<B>),
    control: &Control<'_>,
) -> Result<Joined<B::System>, Stopped> {
    let whole = task.over().grid.whole();
    let mut merged = Census::default();
    let mut cells: Vec<Option<usize>> = vec![None; whole.points()];
    // for each motion, the start whose verdict is in the census
    let mut sources: Vec<usize> = Vec::new();
    for (block, tile) in tiles_of(&task.over().grid, control, |block, tick| task.compute(block, tick))? {
        note(&block, &tile);
        let numbers: Vec<usize> = tile.met.motions().iter().map(|found| merged.add_found(found)).collect();
        for (k, cell) in tile.cells.iter().enumerate() {
            // without refinement every start is settled; some have no motion
            let Cell::Computed(Some(local)) = cell else { continue };
            let (place, number) = (whole.number(&block.index(k)), numbers[*local as usize]);
            if number == sources.len() {
                sources.push(place);
            }
            cells[place] = Some(number);
        }
    }
    let mut order: Vec<(usize, usize)> = Vec::new();
    let mut renumbered = vec![None; sources.len()];
    for (place, cell) in cells.iter_mut().enumerate() {
        *cell = cell.map(|number| {
            *renumbered[number].get_or_insert_with(|| {
                order.push((number, place));
                order.len() - 1
            })
        });
    }
    let motions = order.into_iter().map(|(number, first)| {
        let found = &merged.motions()[number];
        let verdict = if sources[number] == first { found.verdict.clone() } else { settled(first) };
        CountedMotion { verdict, count: found.count }
    });
    Ok(Joined { motions: motions.collect(), cells })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same result for any tiles and threads as when the starts are settled one after another, without lanes and trapping
    /// regions.
    #[test]
    fn the_same_as_one_by_one() {
        let system = SystemPlan::from_inverse_beta(1.7, 2.25, 0.5);
        let osc = system.oscillator().unwrap();
        let plan = BasinPlan::plane("-4:2.25:40".parse().unwrap(), "-4:4:30".parse().unwrap(), 0.5);
        let mut census = Census::default();
        let one_by_one = |k| {
            let verdict = settle(&osc, start(&osc, &plan, k), &options(plan.impacts));
            census.add(&verdict.verdict)
        };
        let cells: Vec<usize> = (0..1200).map(one_by_one).collect();
        for (tile, threads) in [(TILE, 1), (1, 2), (7, 3), (64, 8), (999, 2), (100_000, 2)] {
            let got = in_tiles(&system, &plan, &Control { threads, ..Control::default() }, tile).unwrap();
            assert_eq!(got.cells.iter().map(|&cell| usize::from(cell)).collect::<Vec<_>>(), cells, "{tile}");
            assert_eq!(got.motions, census.motions(), "{tile}");
        }
    }
}
