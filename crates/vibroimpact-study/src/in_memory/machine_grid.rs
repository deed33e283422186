//! Basins, maps and points of machines in memory: their tiles are joined.

use super::join::{Joined, Part, joined};
use crate::machine::MachineSource;
use crate::machine_plan::{MachineBasin, MachineMap, MachineShare, check_memory, tile, values_of};
use crate::study::{Along, Cell, Fill, MachineBasinFill, MapFill, Mapped, tiles_of};
use crate::{BasinPlan, Control, ListedColumn, ManyPlan, MapPlan, RunError};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Undecided, UndecidedCause, Verdict};

/// Settles every start of a grid, without refinement.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
pub(crate) fn machine_basin(
    problem: (&Machine, &MachineStart),
    plan: &BasinPlan<String, String>,
    control: &Control<'_>,
) -> Result<MachineBasin, RunError> {
    check_memory(&plan.axes, 1)?;
    let task = MachineBasinFill::new(problem, &BasinPlan { refine: None, ..plan.clone() }, None)?;
    let whole = task.grid().whole();
    let mut seen_events = vec![None; whole.points()];
    let parts = tiles_of(&task, control)?.into_iter().map(|(block, tile)| {
        for (k, events) in &tile.seen {
            seen_events[whole.number(&block.index(*k))] = Some(*events);
        }
        // without refinement every start is settled
        let number = |cell: &Cell<Option<u32>>| if let Cell::Computed(number) = cell { *number } else { None };
        Part { block, cells: tile.cells.iter().map(number).collect(), met: tile.met }
    });
    // a start that has a motion was settled before
    let unknown = Verdict::Undecided(Undecided { why: UndecidedCause::Budget, impacts: 0, spectrum: None });
    let first = |k| task.settled(&whole.index(k)).unwrap_or_else(|| unknown.clone());
    let Joined { motions, cells } = joined(&whole, parts, first);
    let motions: Vec<Verdict<Machine>> = motions.into_iter().map(|found| found.verdict).collect();
    let quantities = motions.iter().map(|verdict| values_of(problem.0, verdict, &plan.fields)).collect();
    let (axes, fields) = (plan.axes.clone(), plan.fields.clone());
    Ok(MachineBasin { axes, motions, cells, seen_events, fields, quantities })
}

/// Settles scattered starts at every point of a grid of numbers, without refinement.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
pub(crate) fn machine_map(
    source: &MachineSource,
    plan: &MapPlan<String, String>,
    control: &Control<'_>,
) -> Result<MachineMap, RunError> {
    check_memory(&plan.axes, plan.starts)?;
    // one point a tile, because one point may take a thousand times as long as another; oscillators share lanes
    let alone = source.machine().is_ok_and(|machine| machine.reduced().is_none());
    let tile = if alone { Some(1) } else { None };
    let task = MapFill::of_machine(source, &MapPlan { refine: None, ..plan.clone() }, tile);
    let cells = motions_of(&task, control)?;
    Ok(MachineMap { axes: plan.axes.clone(), points: Vec::new(), cells, fields: plan.fields.clone() })
}

/// Settles the start at each of many points of a machine.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
pub(crate) fn machine_points(
    source: &MachineSource,
    problem: (&Machine, &MachineStart),
    plan: &ManyPlan<String>,
    control: &Control<'_>,
) -> Result<MachineMap, RunError> {
    let task = MapFill::of_points(source, problem, plan, Some(tile(problem.0)))?;
    let cells = motions_of(&task, control)?;
    let column = |along: Along| ListedColumn { vary: along.name, values: along.values };
    let points = task.coordinates().into_iter().map(column).collect();
    Ok(MachineMap { axes: Vec::new(), points, cells, fields: plan.fields.clone() })
}

/// The motions at each point of a study without refinement; none where the numbers are not allowed.
fn motions_of<M: Mapped<Motion = MachineShare>>(
    task: &MapFill<M>,
    control: &Control<'_>,
) -> Result<Vec<Vec<MachineShare>>, RunError> {
    let whole = task.grid().whole();
    let mut cells: Vec<Vec<MachineShare>> = vec![Vec::new(); whole.points()];
    for (block, tile) in tiles_of(task, control)? {
        for (k, cell) in tile.into_iter().enumerate() {
            if let Cell::Computed(Ok(motions)) = cell {
                cells[whole.number(&block.index(k))] = motions;
            }
        }
    }
    Ok(cells)
}
