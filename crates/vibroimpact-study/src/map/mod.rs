//! The motions at each point of a parameter plane.

mod plan;

pub use plan::MapPlan;
pub(crate) use plan::{check_impacts, check_refine, options};

use vibroimpact::Oscillator;
use vibroimpact::chaos::Arrivals;
use vibroimpact::lanes::Width;
use vibroimpact::math::sort_by_key;
use vibroimpact::quantities::{Quantities, of_arrivals};
use vibroimpact::verdict::{
    CountedMotion, SettleOptions, Settlement, StartBox, Verdict, scattered_starts, settle_each,
};

/// A motion at a point, with the share of starts that lead to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Share {
    /// The motion.
    pub verdict: Verdict,
    /// The share of starts that lead to it, from 0 to 1.
    pub share: f64,
    /// Its quantities, if the plan asks for any and they are defined.
    pub quantities: Option<Quantities>,
}

/// A point of the map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPoint {
    /// The values of the axes at this point, in the order of the axes.
    pub at: Vec<f64>,
    /// The distinct motions, the most frequent first.
    pub motions: Vec<Share>,
}

/// All points; the first axis varies fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionMap {
    /// The plan of the map.
    pub plan: MapPlan,
    /// The points with their motions.
    pub points: Vec<MapPoint>,
}

/// The motions at each of some points, the most frequent first, with their shares of the starts. `done` is called for
/// each point that is settled, with its number; returns false if `done` returned true, which stops the computation.
pub(crate) fn motions(
    systems: &[Oscillator],
    plan: &MapPlan,
    options: &SettleOptions,
    mut done: impl FnMut(usize, Vec<Share>) -> bool,
) -> bool {
    let counted: Vec<(Oscillator, u64)> = systems.iter().map(|osc| (*osc, plan.starts)).collect();
    let areas: Vec<StartBox> = systems.iter().map(StartBox::natural).collect();
    let start = |k: usize, index: u64| scattered_starts(&systems[k], areas[k], plan.seed, index);
    let tails = !plan.fields.is_empty();
    settle_each(&counted, &start, options, tails, Width::best(), &mut |k, settlement| {
        done(k, shares(&systems[k], plan, settlement))
    })
}

/// The motions of a settlement, the most frequent first.
fn shares(osc: &Oscillator, plan: &MapPlan, settlement: Settlement) -> Vec<Share> {
    let mut found: Vec<(CountedMotion, Arrivals)> = settlement.motions.into_iter().zip(settlement.tails).collect();
    sort_by_key(&mut found, |(found, _)| core::cmp::Reverse(found.count));
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let share = |count: u64| count as f64 / plan.starts as f64;
    let quantities = |verdict: &Verdict, tail: &Arrivals| {
        if plan.fields.is_empty() { None } else { of_arrivals(osc, verdict, tail, &plan.fields) }
    };
    let share = |(found, tail): (CountedMotion, Arrivals)| Share {
        quantities: quantities(&found.verdict, &tail),
        share: share(found.count),
        verdict: found.verdict,
    };
    found.into_iter().map(share).collect()
}
