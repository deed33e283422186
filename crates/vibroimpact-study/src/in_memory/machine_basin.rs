//! A basin of a machine in memory: its tiles are joined.

use super::join::{Joined, Part, joined};
use crate::quantity::values_of;
use crate::study::{Cell, Fill, MachineBasinFill, tiles_of};
use crate::{Basin, BasinPlan, Control, RunError, axis};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{CountedMotion, Undecided, UndecidedCause, Verdict};

/// Settles every start of a grid, without refinement.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
pub(crate) fn machine_basin(
    problem: (&Machine, &Start),
    plan: &BasinPlan<String, String>,
    control: &Control<'_>,
) -> Result<Basin<Machine, String, String>, RunError> {
    axis::check_memory("starts", &plan.axes)?;
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
    let quantities = |motion: &CountedMotion<Machine>| values_of(problem.0, &motion.verdict, &plan.fields);
    Ok(Basin::new(plan.clone(), (motions, cells), seen_events, quantities)?)
}
