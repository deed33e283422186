//! A map: one row for each motion at each point.

use super::Table;
use super::quantities::{cells, columns};
use crate::Units;
use crate::number::Number;
use vibroimpact_study::RegionMap;

/// The table of `vibro map`: the quantities that vary, the label, and its share of the starts.
#[must_use]
pub fn table(found: &RegionMap) -> Table<'_> {
    let names: Vec<&str> = found.plan.axes.iter().map(|axis| axis.vary.name()).collect();
    let rows = found.points.iter().flat_map(|point| {
        point.motions.iter().map(|motion| {
            let place: Vec<String> = point.at.iter().map(|at| Number(*at).to_string()).collect();
            let own = cells(&found.plan.fields, motion.quantities, &Units::default());
            format!("{},{},{}{own}", place.join(","), motion.verdict.label(), Number(motion.share))
        })
    });
    let columns = columns(&found.plan.fields, &Units::default());
    Table::new(format!("{},label,share{columns}", names.join(",")), rows)
}
