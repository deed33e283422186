//! A map in memory: its tiles are joined.

use crate::limits::MOST_CELLS;
use crate::map::{MapPlan, MapPoint, RegionMap};
use crate::study::{Cell, MapFill, on_axis, tiles_of};
use crate::{Control, RunError, SystemPlan, axis};

/// Number of points of a tile along each axis, for one axis and more.
const TILE: [u32; 4] = [400, 20, 7, 4];

/// Settles several starts at every point of the plane, without refinement.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped.
pub(crate) fn map(system: &SystemPlan, plan: &MapPlan, control: &Control<'_>) -> Result<RegionMap, RunError> {
    plan.check(system)?;
    if plan.points() > MOST_CELLS {
        return Err(axis::too_many("points", &plan.axes).into());
    }
    let all = MapPlan { refine: None, ..plan.clone() };
    // the starts of a tile share lanes; smaller tiles leave more lanes empty, and larger ones leave threads without work
    let task = MapFill::new(system, &all, Some(TILE[plan.axes.len().min(TILE.len()) - 1]));
    let whole = axis::whole(&plan.axes);
    let mut points: Vec<Option<MapPoint>> = (0..whole.points()).map(|_| None).collect();
    for (block, tile) in tiles_of(&task, control)? {
        for (k, cell) in tile.into_iter().enumerate() {
            let index = block.index(k);
            let at = plan.axes.iter().enumerate().map(|(k, axis)| axis.over.at(on_axis(&index, k))).collect();
            // without refinement every point is computed
            if let Cell::Computed(found) = cell {
                points[whole.number(&index)] = Some(MapPoint { at, motions: found? });
            }
        }
    }
    Ok(RegionMap { plan: plan.clone(), points: points.into_iter().flatten().collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_in_order_with_shares_that_add_up() {
        let system = SystemPlan { inverse_beta: Some(1.0), gap: 0.0, restitution: 0.5, ..SystemPlan::default() };
        let plan = MapPlan::plane("0.6:1.4:5".parse().unwrap(), "-0.5:2:3".parse().unwrap(), 6, 1);
        let run = |threads| map(&system, &plan, &Control { threads, ..Control::default() });
        let one = run(1).unwrap();
        assert_eq!(one.points.len(), 15);
        assert_eq!(one.points[0].at, [0.6, -0.5]);
        assert_eq!(one.points[1].at, [plan.axes[0].over.at(1), -0.5]);
        assert_eq!(one.points[14].at, [1.4, 2.0]);
        for point in &one.points {
            assert!((point.motions.iter().map(|m| m.share).sum::<f64>() - 1.0).abs() < 1e-12);
        }
        assert_eq!(run(3).unwrap(), one);
    }
}
