//! The motions at each point of a parameter plane.

mod plan;

pub use plan::MapPlan;
pub(crate) use plan::{check_impacts, check_refine, options};

use crate::study::code;
use crate::{Axis, Coordinate, ImpactsByStop, ListedColumn, Quantity};
use std::borrow::Cow;
use vibroimpact::Oscillator;
use vibroimpact::chaos::Arrivals;
use vibroimpact::lanes::Width;
use vibroimpact::math::sort_by_key;
use vibroimpact::quantities::of_arrivals;
use vibroimpact::verdict::{
    CountedMotion, SettleOptions, Settlement, StartBox, Verdict, scattered_starts, settle_each,
};

/// A motion at a point of any system, with the share of starts that lead to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Share {
    /// Its label.
    pub label: Cow<'static, str>,
    /// The [code](crate::study::code) of its label.
    pub code: i32,
    /// The share of the starts that lead to it, from 0 to 1.
    pub share: f64,
    /// The largest speed of a closing; not-a-number unless it is a cycle.
    pub speed: f64,
    /// The largest modulus of the multipliers; not-a-number where it has none.
    pub multiplier: f64,
    /// The stops that stay closed for ever, by their numbers from 0.
    pub stops: Vec<usize>,
    /// The number of events (of an oscillator: impacts) over which chaos was seen; `None` unless it is chaotic.
    pub seen_events: Option<u64>,
    /// The impacts of a cycle of an oscillator on each stop.
    pub by_stop: Option<ImpactsByStop>,
    /// A value of each field of the plan, not-a-number where it is not defined; empty if none is.
    pub quantities: Vec<f64>,
}

/// The motions at each point of a grid of numbers, or of a list of points.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionMap<V = Coordinate, F = Quantity> {
    /// The axes; the first varies fastest.
    pub axes: Vec<Axis<V>>,
    /// The points as columns, where they are no grid; empty for a grid.
    pub columns: Vec<ListedColumn<V>>,
    /// The distinct motions at each point, the most frequent first. Two motions of one label have an entry each. Empty where the
    /// numbers are not allowed.
    pub points: Vec<Vec<Share>>,
    /// The quantities that the plan asks for.
    pub fields: Vec<F>,
}

impl<V, F> RegionMap<V, F> {
    /// What varies.
    pub fn varied(&self) -> impl Iterator<Item = &V> {
        self.axes.iter().map(|axis| &axis.vary).chain(self.columns.iter().map(|column| &column.vary))
    }

    /// All motions, point by point.
    pub fn motions(&self) -> impl Iterator<Item = &Share> {
        self.points.iter().flatten()
    }

    /// The smallest number of events over which chaos was seen at a point; `None` if it was seen at none.
    #[must_use]
    pub fn seen_events(&self) -> Option<u64> {
        self.motions().filter_map(|motion| motion.seen_events).min()
    }

    /// The number of points where several motions coexist.
    #[must_use]
    pub fn coexisting(&self) -> usize {
        self.points.iter().filter(|motions| motions.len() > 1).count()
    }
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
        let found = if plan.fields.is_empty() { None } else { of_arrivals(osc, verdict, tail, &plan.fields) };
        found.map_or_else(Vec::new, |found| plan.fields.iter().map(|field| found.get(*field)).collect())
    };
    let share = |(CountedMotion { verdict, count }, tail): (CountedMotion, Arrivals)| {
        let cycle = if let Verdict::Periodic(cycle) = &verdict { Some(cycle) } else { None };
        Share {
            label: verdict.label(),
            code: code(&verdict),
            share: share(count),
            speed: cycle.map_or(f64::NAN, |cycle| cycle.fastest()),
            multiplier: verdict.multipliers(osc).map_or(f64::NAN, |[a, b]| a.modulus().max(b.modulus())),
            stops: if let Verdict::Stuck(side) = &verdict { vec![side.place()] } else { Vec::new() },
            seen_events: verdict.seen_events(),
            by_stop: cycle.map(ImpactsByStop::of_cycle),
            quantities: quantities(&verdict, &tail),
        }
    };
    found.into_iter().map(share).collect()
}
