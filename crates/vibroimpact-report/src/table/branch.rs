//! Branches of periodic orbits: one row for each point.

use super::Table;
use crate::Units;
use crate::json::motion::pairs;
use crate::number::Number;
use vibroimpact::QuantityKind;
use vibroimpact::orbit::Cycle;
use vibroimpact_study::{Branches, Cut};

/// The table of `vibro branch`.
#[must_use]
pub fn table<'a>(found: &'a Branches, cut: &Cut, units: &'a Units) -> Table<'a> {
    Table::new(columns(cut, units), rows(found, *cut, units))
}

/// The columns of the table.
fn columns(cut: &Cut, units: &Units) -> String {
    let names: Vec<&str> = cut.parameters().map(|parameter| units.column_of(parameter)).collect();
    let velocities = units.column("velocities", QuantityKind::Velocity);
    format!("branch,{},label,physical,stable,stability,event,re_1,im_1,re_2,im_2,phases,{velocities}", names.join(","))
}

/// One row for each point. Phases and velocities are lists separated by blanks.
fn rows<'a>(found: &'a Branches, cut: Cut, units: &'a Units) -> impl Iterator<Item = String> + 'a {
    found.followed.iter().enumerate().flat_map(move |(k, branch)| {
        branch.points.iter().map(move |point| {
            let event = point.event.map_or("", |event| event.name());
            format!(
                "{},{},{},{},{},{},{event},{}",
                k + 1,
                values(&cut, point.value, units),
                point.cycle.label,
                point.physical,
                point.stable(),
                point.stability(),
                cells(&point.cycle, &units.at(cut.vary, point.value))
            )
        })
    })
}

/// The parameters at a point of a line, in the units of the results.
fn values(cut: &Cut, value: f64, units: &Units) -> String {
    let cells = cut.values(value).map(|(parameter, value)| Number(value * units.of(parameter)).to_string());
    cells.collect::<Vec<_>>().join(",")
}

/// The text of a number; empty for a number that is not finite.
fn finite(x: f64) -> String {
    if x.is_finite() { Number(x).to_string() } else { String::new() }
}

/// Multipliers, phases and velocities of a cycle.
pub(super) fn cells(cycle: &Cycle, units: &Units) -> String {
    let list = |of: &dyn Fn(&vibroimpact::orbit::CyclePoint) -> f64| {
        let cells: Vec<String> = cycle.points.iter().map(|point| Number(of(point)).to_string()).collect();
        cells.join(" ")
    };
    let [[a, b], [c, d]] = pairs(cycle.multipliers);
    format!(
        "{},{},{},{},{},{}",
        finite(a),
        finite(b),
        finite(c),
        finite(d),
        list(&|point| point.state.phase),
        list(&|point| point.state.velocity * units.velocity())
    )
}
