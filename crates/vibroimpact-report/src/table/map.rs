//! A map: one row for each motion at each point.

use super::Table;
use super::quantities::{cells, columns};
use crate::Units;
use crate::number::Number;
use vibroimpact_study::{PlanError, RegionMap};

/// The table of `vibro map`: the quantities that vary, in the units and with exactly the numbers of the question, the
/// label, its share of the starts, and the quantities that the plan asks for.
///
/// # Errors
/// [`PlanError`] if a value of an axis overflows in these units.
pub fn table(found: &RegionMap, units: Units) -> Result<Table<'_>, PlanError> {
    let axes = &found.plan.axes;
    let names: Vec<&str> = axes.iter().map(|axis| units.column_of_coordinate(axis.vary)).collect();
    let values = axes.iter().map(|axis| Ok(units.shown(axis)?.all()));
    let values = values.collect::<Result<Vec<Vec<f64>>, PlanError>>()?;
    let rows = found.points.iter().enumerate().flat_map(move |(k, point)| {
        let mut rest = k;
        let mut place = String::new();
        for values in &values {
            place.push_str(&format!("{},", Number(values[rest % values.len()])));
            rest /= values.len();
        }
        let units = units.over(axes, |axis| point.at[axis]);
        point.motions.iter().map(move |motion| {
            let own = cells(&found.plan.fields, motion.quantities, &units);
            format!("{place}{},{}{own}", motion.verdict.label(), Number(motion.share))
        })
    });
    Ok(Table::new(format!("{},label,share{}", names.join(","), columns(&found.plan.fields, &units)), rows))
}
