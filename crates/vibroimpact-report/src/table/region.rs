//! Regions of existence and stability: one row for each vertex.

use super::Table;
use crate::Units;
use crate::json::region::{sheet, unit};
use crate::number::Number;
use vibroimpact::continuation::Region;
use vibroimpact_study::{RegionPlan, Regions};

/// Both regions with their names.
#[must_use]
pub fn both(found: &Regions) -> [(&'static str, &Region); 2] {
    [("existence", &found.existence), ("stability", &found.stability)]
}

/// The table of `vibro region`.
#[must_use]
pub fn table<'a>(found: &'a Regions, plan: &RegionPlan, units: &Units) -> Table<'a> {
    Table::new(columns(plan, units), rows(found, plan, units))
}

/// The columns of the table.
fn columns(plan: &RegionPlan, units: &Units) -> String {
    let (across, up) = (units.column_of(plan.across.parameter), units.column_of(plan.up.parameter));
    format!("region,polygon,hole,sheet,{across},{up},bound")
}

/// One row for each vertex.
fn rows<'a>(found: &'a Regions, plan: &RegionPlan, units: &Units) -> impl Iterator<Item = String> + 'a {
    let (x, y) = unit(plan, units);
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
