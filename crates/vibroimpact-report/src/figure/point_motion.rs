//! The motions at the points of a map, as figures need them: the group, the share, and the value of a quantity.

use crate::figure::coloured::Value;
use crate::varied::units_over;
use crate::{FieldName, Units, Varied};
use vibroimpact_plot::{GROUPS, legend_group};
use vibroimpact_study::{Axis, RegionMap, Share};

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

/// The motions at each point of a map, the most frequent first, with the values of a field of the plan in these units.
#[must_use]
pub fn points<V: Varied, F: FieldName>(
    found: &RegionMap<V, F>,
    field: Option<usize>,
    units: &Units,
) -> Vec<Vec<PointMotion>> {
    let point = |(k, motions): (usize, &Vec<Share>)| {
        let there = units_over(units, &found.axes, &Axis::at(&found.axes, k as u64));
        let motion = |motion: &Share| {
            let value = |field: usize| Some(motion.quantities.get(field)? * found.fields[field].unit(&there));
            let value = Value::of(&motion.label, field.and_then(value));
            PointMotion { group: group(&motion.label), share: motion.share, value }
        };
        motions.iter().map(motion).collect()
    };
    found.points.iter().enumerate().map(point).collect()
}
