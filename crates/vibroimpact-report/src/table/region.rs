//! Regions of existence and stability: one row for each vertex.

use super::Table;
use crate::json::region::{sheet, unit};
use crate::number::Number;
use crate::{Units, Varied};
use vibroimpact::continuation::Region;
use vibroimpact_study::{RegionPlan, Regions};

/// Both regions with their names.
#[must_use]
pub fn both(found: &Regions) -> [(&'static str, &Region); 2] {
    [("existence", &found.existence), ("stability", &found.stability)]
}

/// The table of `vibro region`.
pub(crate) fn table<'a, V: Varied>(found: &'a Regions, plan: &RegionPlan<V>, units: &Units) -> Table<'a> {
    let (across, up) = (plan.across.parameter.column(units), plan.up.parameter.column(units));
    Table::new(format!("region,polygon,hole,sheet,{across},{up},bound"), rows(found, unit(plan, units)))
}

/// One row for each vertex.
fn rows(found: &Regions, (x, y): (f64, f64)) -> impl Iterator<Item = String> + '_ {
    both(found).into_iter().flat_map(move |(name, region)| {
        region.polygons.iter().enumerate().flat_map(move |(k, polygon)| {
            let head = format!("{name},{},{},{}", k + 1, polygon.hole, sheet(polygon));
            polygon.vertices.iter().map(move |vertex| {
                let (p, q) = vertex.values;
                format!("{head},{},{},{}", Number(p * x), Number(q * y), vertex.bound.name())
            })
        })
    })
}
