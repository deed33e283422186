//! Branches of periodic orbits: one row a point.

use super::Table;
use crate::Units;
use crate::json::motion::pairs;
use crate::number::Number;
use vibroimpact::Parameter;
use vibroimpact::orbit::Cycle;
use vibroimpact_study::Branches;

/// The table of `vibro branch`.
#[must_use]
pub fn table<'a>(found: &'a Branches, vary: Parameter, units: &'a Units) -> Table<'a> {
    Table::new(columns(vary), rows(found, vary, units))
}

/// The columns of the table.
fn columns(vary: Parameter) -> String {
    format!("branch,{},label,physical,stable,event,re_1,im_1,re_2,im_2,phases,velocities", vary.name())
}

/// One row a point; phases and velocities are lists with blanks between.
fn rows<'a>(found: &'a Branches, vary: Parameter, units: &'a Units) -> impl Iterator<Item = String> + 'a {
    let unit = units.of(vary);
    found.followed.iter().enumerate().flat_map(move |(k, branch)| {
        branch.points.iter().map(move |point| {
            let event = point.event.map_or("", |event| event.name());
            format!(
                "{},{},{},{},{},{event},{}",
                k + 1,
                Number(point.value * unit),
                point.cycle.label,
                point.physical,
                point.stable(),
                cells(&point.cycle, units)
            )
        })
    })
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
        Number(a),
        Number(b),
        Number(c),
        Number(d),
        list(&|point| point.state.phase),
        list(&|point| point.state.velocity * units.velocity())
    )
}
