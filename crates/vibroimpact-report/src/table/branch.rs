//! Branches of periodic orbits: one row for each point.

use super::Table;
use crate::Units;
use crate::json::event::side;
use crate::number::Number;
use vibroimpact::QuantityKind;
use vibroimpact::orbit::{Cycle, CyclePoint};
use vibroimpact_study::{Branches, Cut, EventRecord};

/// The table of `vibro branch`.
#[must_use]
pub fn table<'a>(found: &'a Branches, cut: &Cut, units: &'a Units) -> Table<'a> {
    Table::new(columns(cut, units), rows(found, *cut, units))
}

/// The columns of the table.
fn columns(cut: &Cut, units: &Units) -> String {
    let names: Vec<&str> = cut.parameters().map(|parameter| units.column_of(parameter)).collect();
    let fastest = units.column("fastest", QuantityKind::Velocity);
    format!(
        "branch,{},label,admissible,stable,stability,event,stop,{fastest},{}",
        names.join(","),
        cycle_columns(units)
    )
}

/// The columns of the multipliers and impacts of a cycle.
pub(super) fn cycle_columns(units: &Units) -> String {
    let speeds = units.column("speeds", QuantityKind::Velocity);
    format!("multiplier_1_re,multiplier_1_im,multiplier_2_re,multiplier_2_im,phases,{speeds},stops")
}

/// One row for each point. Phases, speeds and stops are lists separated by blanks.
fn rows<'a>(found: &'a Branches, cut: Cut, units: &'a Units) -> impl Iterator<Item = String> + 'a {
    found.followed.iter().enumerate().flat_map(move |(k, branch)| {
        branch.points.iter().map(move |point| {
            let event = point.event.map_or("", |event| event.name());
            let stop = point.event.and_then(|event| EventRecord::of(point, &event).side).map_or("", side);
            let units = units.at(cut.vary, point.value);
            format!(
                "{},{},{},{},{},{},{event},{stop},{},{}",
                k + 1,
                values(&cut, point.value, &units),
                point.cycle.label,
                point.physical,
                point.stable(),
                point.stability(),
                Number(point.cycle.fastest() * units.velocity()),
                cells(&point.cycle, &units)
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

/// Multipliers, phases, speeds and stops of the impacts of a cycle.
pub(super) fn cells(cycle: &Cycle, units: &Units) -> String {
    let list = |of: &dyn Fn(&CyclePoint) -> String| cycle.points.iter().map(of).collect::<Vec<_>>().join(" ");
    let [a, b] = cycle.multipliers;
    format!(
        "{},{},{},{},{},{},{}",
        finite(a.re),
        finite(a.im),
        finite(b.re),
        finite(b.im),
        list(&|point| Number(point.state.phase).to_string()),
        list(&|point| Number(point.state.velocity * units.velocity()).to_string()),
        list(&|point| side(point.state.side).to_owned())
    )
}
