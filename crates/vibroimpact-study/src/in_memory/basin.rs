//! A basin in memory: its tiles are joined, and the motions are in the order of the first start that leads to each.

use crate::basin::{Basin, BasinPlan, start};
use crate::in_memory::join::{Joined, Part, joined};
use crate::quantity::values_of;
use crate::study::{BasinFill, BasinTile, Basins, Cell, Fill, MachineBasin, StoredMotion, tiles_of};
use crate::{Block, Control, PlanError, RunError, Stopped, SystemPlan, axis};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{CountedMotion, Undecided, UndecidedCause, Verdict, settle, settle_machine};

/// Approximate number of starts of a tile: large enough that joining takes no noticeable time, small enough to stop
/// quickly and to use all threads.
const TILE: u32 = 8192;

/// Settles every start of the basin of one system, without refinement.
///
/// # Errors
/// [`RunError`] for an invalid plan, for a plan that varies parameters, or when stopped.
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
    let first = |k: usize| settle(osc, start(osc, plan, k as u64), &plan.options()).verdict;
    let Joined { motions, cells } = all(&task, first, |_, _| {}, control)?;
    let quantities = |motion: &CountedMotion| {
        let found = if plan.fields.is_empty() { None } else { of_verdict_only(osc, &motion.verdict, &plan.fields) };
        found.map_or_else(Vec::new, |found| plan.fields.iter().map(|field| found.get(*field)).collect())
    };
    Ok(Basin::new(plan.clone(), (motions, cells), Vec::new(), quantities)?)
}

/// The same of a machine.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
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
        let settled = settle_machine(problem.0, &task.of.start(&whole.index(k)), &plan.options());
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

/// The motions of all starts. `first` returns the verdict on a start; `note` is called for each tile.
fn all<B: Basins>(
    task: &BasinFill<B>,
    first: impl Fn(usize) -> Verdict<B::System>,
    mut note: impl FnMut(&Block, &BasinTile<B>),
    control: &Control<'_>,
) -> Result<Joined<B::System>, Stopped>
where
    Verdict<B::System>: StoredMotion,
{
    let parts = tiles_of(&task.over().grid, control, |block, tick| task.compute(block, tick))?.into_iter().map(
        |(block, tile)| {
            note(&block, &tile);
            // without refinement every start is settled
            let number = |cell: &Cell<Option<u32>>| if let Cell::Computed(number) = cell { *number } else { None };
            Part { block, cells: tile.cells.iter().map(number).collect(), met: tile.met }
        },
    );
    Ok(joined(&task.over().grid.whole(), parts, first))
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::verdict::Census;

    #[test]
    fn the_same_for_any_number_of_threads() {
        let osc = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);
        let plan = BasinPlan::plane("-4:0.75:50".parse().unwrap(), "-4:4:40".parse().unwrap(), 0.0);
        let run = |threads| basin(&osc, &plan, &Control { threads, ..Control::default() }).unwrap();
        let one = run(1);
        assert_eq!(one.cells.len(), 2000);
        assert_eq!(one.motions.iter().map(|m| m.count).sum::<u64>(), 2000);
        assert_eq!(one.motions.len(), 2);
        for threads in [2, 3, 8] {
            assert_eq!(run(threads), one);
        }
        for tile in [1, 7, 64, 999, 100_000] {
            let control = Control { threads: 2, ..Control::default() };
            assert_eq!(in_tiles(&osc, &plan, &control, tile).unwrap(), one, "{tile}");
        }
    }

    /// The same result when the starts are settled one after another, without lanes and trapping regions.
    #[test]
    fn the_same_as_one_by_one() {
        let system = SystemPlan::from_inverse_beta(1.7, 2.25, 0.5);
        let osc = system.oscillator().unwrap();
        let plan = BasinPlan::plane("-4:2.25:40".parse().unwrap(), "-4:4:30".parse().unwrap(), 0.5);
        let got = basin(&system, &plan, &Control::default()).unwrap();
        let mut census = Census::default();
        let one_by_one = |k| {
            let verdict = settle(&osc, start(&osc, &plan, k), &plan.options());
            census.add(&verdict.verdict)
        };
        let cells: Vec<usize> = (0..1200).map(one_by_one).collect();
        assert_eq!(got.cells.iter().map(|&cell| usize::from(cell)).collect::<Vec<_>>(), cells);
        assert_eq!(got.motions, census.motions());
    }
}
