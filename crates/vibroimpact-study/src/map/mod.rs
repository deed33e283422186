//! Which motions there are at each point of a parameter plane.

mod plan;

pub use plan::MapPlan;
pub(crate) use plan::{check_impacts, check_refine};

use crate::limits::MOST_CELLS;
use crate::study::{Cell, MapFill, tiles_of};
use crate::{Control, RunError, SystemPlan, axis};
use vibroimpact::Oscillator;
use vibroimpact::lanes::Width;
use vibroimpact::verdict::{
    CountedMotion, KnownAttractors, SettleOptions, StartBox, Verdict, scattered_starts, settle_many,
};

/// A motion at a point, and the share of starts that led to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Share {
    /// The motion.
    pub verdict: Verdict,
    /// Its share of the starts.
    pub share: f64,
}

/// A point of the map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPoint {
    /// Its values on the axes, in their order.
    pub at: Vec<f64>,
    /// The distinct motions, the most frequent first.
    pub motions: Vec<Share>,
}

/// All points, the first axis running fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionMap {
    /// The points asked for.
    pub plan: MapPlan,
    /// Their motions.
    pub points: Vec<MapPoint>,
}

/// Settles several starts at every point of the plane; all of them, without refinement.
///
/// # Errors
/// [`RunError`] for a plan that makes no sense, or when stopped.
pub(crate) fn map(system: &SystemPlan, plan: &MapPlan, control: &Control<'_>) -> Result<RegionMap, RunError> {
    plan.check(system)?;
    if plan.points() > MOST_CELLS {
        return Err(axis::too_many("points", &plan.axes).into());
    }
    let all = MapPlan { refine: None, ..plan.clone() };
    // small tiles, because one point may take a thousand times as long as another
    let task = MapFill::new(system, &all, Some(if plan.axes.len() > 1 { 2 } else { 4 }));
    let whole = axis::whole(&plan.axes);
    let mut points: Vec<Option<MapPoint>> = (0..whole.points()).map(|_| None).collect();
    for (block, tile) in tiles_of(&task, control)? {
        for (k, cell) in tile.into_iter().enumerate() {
            let index = block.index(k);
            let place = |axis: usize| index[index.len() - 1 - axis];
            let at = plan.axes.iter().enumerate().map(|(k, axis)| axis.over.at(place(k))).collect();
            // without refinement every point is computed
            if let Cell::Computed(found) = cell {
                points[whole.number(&index)] = Some(MapPoint { at, motions: found? });
            }
        }
    }
    Ok(RegionMap { plan: plan.clone(), points: points.into_iter().flatten().collect() })
}

/// The motions at one point, the most frequent first, and their shares of the starts.
pub(crate) fn motions(osc: &Oscillator, plan: &MapPlan, options: &SettleOptions) -> Vec<Share> {
    let area = StartBox::natural(osc);
    let start = |index: u64| scattered_starts(osc, area, plan.seed, index);
    let mut found: Vec<CountedMotion> =
        settle_many(osc, 0..plan.starts, start, &KnownAttractors::default(), options, Width::best(), &|| false).motions;
    found.sort_by_key(|found| core::cmp::Reverse(found.count));
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let share = |count: u64| count as f64 / plan.starts as f64;
    found.into_iter().map(|f| Share { verdict: f.verdict, share: share(f.count) }).collect()
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
