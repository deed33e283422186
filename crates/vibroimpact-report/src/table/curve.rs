//! Curves of events in a plane of two parameters: one row for each point.

use super::Table;
use super::branch::{cells, cycle_columns};
use crate::Units;
use crate::json::curve::values;
use crate::number::Number;
use vibroimpact_study::{CurvePlan, EventCurve};

/// The table of `vibro curve`.
#[must_use]
pub fn table<'a>(found: &'a EventCurve, plan: CurvePlan, units: &'a Units) -> Table<'a> {
    Table::new(columns(&plan, units), rows(found, plan, units))
}

/// The columns of the table.
fn columns(plan: &CurvePlan, units: &Units) -> String {
    let (p, q) = (units.column_of(plan.vary.parameter), units.column_of(plan.and.parameter));
    format!("{p},{q},label,admissible,event,{}", cycle_columns(units))
}

/// One row for each point, from one end to the other.
fn rows<'a>(found: &'a EventCurve, plan: CurvePlan, units: &'a Units) -> impl Iterator<Item = String> + 'a {
    found.points.iter().map(move |point| {
        let [p, q] = values(point, &plan, units);
        let event = point.event.map_or("", |event| event.name());
        let head = format!("{},{},{},{},{event}", Number(p), Number(q), point.cycle.label, point.physical);
        let units = units.at_both((plan.vary.parameter, plan.and.parameter), point.values);
        format!("{head},{}", cells(&point.cycle, &units))
    })
}
