//! Regions of existence and stability: one row for each vertex.

use super::Table;
use crate::Units;
use crate::json::region::{sheet, unit};
use crate::number::Number;
use vibroimpact::continuation::Region;
use vibroimpact_study::{MachineRegionPlan, RegionPlan, Regions};

/// Both regions with their names.
#[must_use]
pub fn both(found: &Regions) -> [(&'static str, &Region); 2] {
    [("existence", &found.existence), ("stability", &found.stability)]
}

/// The table of `vibro region`.
#[must_use]
pub fn table<'a>(found: &'a Regions, plan: &RegionPlan, units: &Units) -> Table<'a> {
    let names = [plan.across.parameter, plan.up.parameter].map(|parameter| units.column_of(parameter));
    Table::new(columns(names), rows(found, unit(plan, units)))
}

/// The same of a machine.
#[must_use]
pub fn of_machine<'a>(found: &'a Regions, plan: &MachineRegionPlan) -> Table<'a> {
    Table::new(columns([&plan.across.path, &plan.up.path]), rows(found, (1.0, 1.0)))
}

/// The columns of the table.
fn columns([across, up]: [impl core::fmt::Display; 2]) -> String {
    format!("region,polygon,hole,sheet,{across},{up},bound")
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
