//! The motions at the points of a map, as figures need them: the group, the share, and the value of a quantity.

use crate::Units;
use crate::figure::coloured::Value;
use vibroimpact::quantities::Quantity;
use vibroimpact_plot::{GROUPS, legend_group};
use vibroimpact_study::{MapPoint, RegionMap};

/// The index of the group of a label in the legend.
#[must_use]
pub fn group(label: &str) -> usize {
    let group = legend_group(label);
    GROUPS.iter().position(|g| *g == group).unwrap_or(GROUPS.len() - 1)
}

/// A motion at a point of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// The index of its group in the legend.
    pub group: usize,
    /// The share of starts that lead to it.
    pub share: f64,
    /// The value of a quantity, if the figure shows one.
    pub value: Value,
}

/// The motions at each point of a map, the most frequent first, with the values of a quantity in these units.
#[must_use]
pub fn points(found: &RegionMap, quantity: Option<Quantity>, units: &Units) -> Vec<Vec<PointMotion>> {
    let motion = |motion: &vibroimpact_study::Share, units: &Units| {
        let label = motion.verdict.label();
        let number = quantity.and_then(|quantity| motion.quantities.map(|of| units.value_of(&of, quantity)));
        PointMotion { group: group(&label), share: motion.share, value: Value::of(&label, number) }
    };
    let point = |point: &MapPoint| {
        let units = units.over(&found.plan.axes, |axis| point.at[axis]);
        point.motions.iter().map(|one| motion(one, &units)).collect()
    };
    found.points.iter().map(point).collect()
}
