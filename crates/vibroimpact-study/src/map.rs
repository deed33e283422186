//! Which motions there are at each point of a parameter plane.

use crate::basin::RunError;
use crate::{Control, MapPlan, SystemPlan, tiles};
use vibroimpact::Oscillator;
use vibroimpact::lanes::Width;
use vibroimpact::verdict::{Atlas, Found, SettleOptions, StartBox, Verdict, scattered_starts, settle_many};

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
    /// $`1/\beta`$.
    pub inverse_beta: f64,
    /// $`\delta`$.
    pub gap: f64,
    /// The distinct motions, the most frequent first.
    pub motions: Vec<Share>,
}

/// All points: rows of rising gap index, inverse frequencies in order within a row.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionMap {
    /// The points asked for.
    pub plan: MapPlan,
    /// Their motions.
    pub points: Vec<MapPoint>,
}

/// Settles several starts at every point of the plane.
///
/// # Errors
/// [`RunError`] for a plan that makes no sense, or when stopped.
pub fn map(
    system: &SystemPlan,
    plan: &MapPlan,
    options: &SettleOptions,
    control: &Control<'_>,
) -> Result<RegionMap, RunError> {
    let total = plan.oscillators(system)?;
    let columns = u64::from(plan.inverse_beta.count());
    let parts = tiles(total, 4, control, |range, tick| {
        let mut points = Vec::new();
        for k in range {
            #[allow(clippy::cast_possible_truncation)]
            // indices of a grid with at most 1e6 values a side
            let (x, gap) = (plan.inverse_beta.at((k % columns) as u32), plan.gap.at((k / columns) as u32));
            points.push(MapPlan::point(system, x, gap).map(|osc| {
                let mut found = settlement(&osc, plan, options);
                found.sort_by_key(|found| core::cmp::Reverse(found.count));
                #[allow(clippy::cast_precision_loss)] // counts below 2^53
                let share = |count: u64| count as f64 / plan.starts as f64;
                let motions = found.into_iter().map(|f| Share { verdict: f.verdict, share: share(f.count) }).collect();
                MapPoint { inverse_beta: x, gap, motions }
            }));
            if tick() {
                break;
            }
        }
        points
    })?;
    let points = parts.into_iter().flatten().collect::<Result<Vec<_>, _>>()?;
    Ok(RegionMap { plan: *plan, points })
}

fn settlement(osc: &Oscillator, plan: &MapPlan, options: &SettleOptions) -> Vec<Found> {
    let area = StartBox::natural(osc);
    let start = |index: u64| scattered_starts(osc, area, plan.seed, index);
    settle_many(osc, 0..plan.starts, start, &Atlas::default(), options, Width::best(), &|| false).motions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_in_order_with_shares_that_add_up() {
        let system = SystemPlan { inverse_beta: Some(1.0), gap: 0.0, restitution: 0.5, ..SystemPlan::default() };
        let plan = MapPlan {
            inverse_beta: "0.6:1.4:5".parse().unwrap(),
            gap: "-0.5:2:3".parse().unwrap(),
            starts: 6,
            seed: 1,
        };
        let run = |threads| map(&system, &plan, &SettleOptions::default(), &Control { threads, ..Control::default() });
        let one = run(1).unwrap();
        assert_eq!(one.points.len(), 15);
        assert_eq!((one.points[0].inverse_beta, one.points[0].gap), (0.6, -0.5));
        assert_eq!((one.points[14].inverse_beta, one.points[14].gap), (1.4, 2.0));
        for point in &one.points {
            assert!((point.motions.iter().map(|m| m.share).sum::<f64>() - 1.0).abs() < 1e-12);
        }
        assert_eq!(run(3).unwrap(), one);
    }
}
