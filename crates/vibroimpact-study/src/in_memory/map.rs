//! A map in memory: its tiles are joined.

use crate::in_memory::attractors::tile;
use crate::machine::MachineSource;
use crate::map::{MapPlan, RegionMap, Share};
use crate::study::{Along, Cell, Fill, MapFill, Mapped, tiles_of};
use crate::{Control, ListedColumn, ManyPlan, RunError, SystemPlan, axis};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;

/// Number of points of a tile along each axis, for one axis and more.
const TILE: [u32; 4] = [400, 20, 7, 4];

/// Settles several starts at every point of the plane, without refinement.
pub(crate) fn map(system: &SystemPlan, plan: &MapPlan, control: &Control<'_>) -> Result<RegionMap, RunError> {
    axis::check_memory("points", &plan.axes)?;
    // the starts of a tile share lanes; smaller tiles leave more lanes empty, and larger ones leave threads without work
    let tile = Some(TILE[plan.axes.len().min(TILE.len()) - 1]);
    let task = MapFill::new(system, &MapPlan { refine: None, ..plan.clone() }, tile);
    Ok(joined(plan, points(&task, control)?))
}

/// The same of a machine.
pub(crate) fn machine_map(
    source: &MachineSource,
    plan: &MapPlan<String, String>,
    control: &Control<'_>,
) -> Result<RegionMap<String, String>, RunError> {
    axis::check_memory("points", &plan.axes)?;
    // one point a tile, because one point may take a thousand times as long as another; oscillators share lanes
    let alone = source.machine().is_ok_and(|machine| machine.reduced().is_none());
    let tile = if alone { Some(1) } else { None };
    let task = MapFill::of_machine(source, &MapPlan { refine: None, ..plan.clone() }, tile);
    Ok(joined(plan, points(&task, control)?))
}

/// The motion from the start at each of many points of a machine.
pub(crate) fn machine_points(
    source: &MachineSource,
    problem: (&Machine, &Start),
    plan: &ManyPlan<String>,
    control: &Control<'_>,
) -> Result<RegionMap<String, String>, RunError> {
    let task = MapFill::of_points(source, problem, plan, Some(tile(problem.0)))?;
    let column = |along: &Along| ListedColumn { vary: along.name.clone(), values: along.values.clone() };
    let columns = task.over().coordinates.iter().map(column).collect();
    Ok(RegionMap { axes: Vec::new(), columns, points: points(&task, control)?, fields: plan.fields.clone() })
}

fn joined<V: Clone, F: Clone>(plan: &MapPlan<V, F>, points: Vec<Vec<Share>>) -> RegionMap<V, F> {
    RegionMap { axes: plan.axes.clone(), columns: Vec::new(), points, fields: plan.fields.clone() }
}

/// The motions at all points; none at points whose numbers are not allowed.
fn points<M: Mapped>(task: &MapFill<M>, control: &Control<'_>) -> Result<Vec<Vec<Share>>, RunError> {
    let whole = task.over().grid.whole();
    let mut points: Vec<Vec<Share>> = vec![Vec::new(); whole.points()];
    for (block, tile) in tiles_of(&task.over().grid, control, |block, tick| task.compute(block, tick))? {
        for (k, cell) in tile.into_iter().enumerate() {
            // without refinement every point is computed
            if let Cell::Computed(Ok(motions)) = cell {
                points[whole.number(&block.index(k))] = motions;
            }
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_in_order_with_shares_that_add_up() {
        let system = SystemPlan::from_inverse_beta(1.0, 0.0, 0.5);
        let plan = MapPlan::plane("0.6:1.4:5".parse().unwrap(), "-0.5:2:3".parse().unwrap(), 6, 1);
        let run = |threads| map(&system, &plan, &Control { threads, ..Control::default() });
        let one = run(1).unwrap();
        assert_eq!(one.points.len(), 15);
        let at = |k| crate::Axis::at(&one.axes, k);
        assert_eq!(at(0), [0.6, -0.5]);
        assert_eq!(at(1), [plan.axes[0].over.at(1), -0.5]);
        assert_eq!(at(14), [1.4, 2.0]);
        for point in &one.points {
            assert!((point.iter().map(|motion| motion.share).sum::<f64>() - 1.0).abs() < 1e-12);
        }
        // numbers that are not defined are not equal to themselves
        assert_eq!(format!("{:?}", run(3).unwrap()), format!("{one:?}"));
    }
}
