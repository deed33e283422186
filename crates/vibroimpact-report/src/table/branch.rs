//! Branches of periodic orbits: one row for each point.

use super::Table;
use crate::Units;
use crate::json::motion::pairs;
use crate::number::Number;
use vibroimpact::QuantityKind;
use vibroimpact::orbit::Cycle;
use vibroimpact_study::{Branches, Cut, Parameter};

/// The table of `vibro branch`.
#[must_use]
pub fn table<'a>(found: &'a Branches, cut: &Cut, units: &'a Units) -> Table<'a> {
    Table::new(columns(cut, units), rows(found, *cut, units))
}

/// The columns of the table.
fn columns(cut: &Cut, units: &Units) -> String {
    let names: Vec<&str> = cut.parameters().map(|parameter| units.column_of(parameter)).collect();
    let velocities = units.column("velocities", QuantityKind::Velocity);
    format!("branch,{},label,physical,stable,event,re_1,im_1,re_2,im_2,phases,{velocities}", names.join(","))
}

/// One row for each point. Phases and velocities are lists separated by blanks.
fn rows<'a>(found: &'a Branches, cut: Cut, units: &'a Units) -> impl Iterator<Item = String> + 'a {
    found.followed.iter().enumerate().flat_map(move |(k, branch)| {
        branch.points.iter().map(move |point| {
            let event = point.event.map_or("", |event| event.name());
            format!(
                "{},{},{},{},{},{event},{}",
                k + 1,
                values(&cut, point.value, units),
                point.cycle.label,
                point.physical,
                point.stable(),
                cells(&point.cycle, &units.at(cut.vary, point.value))
            )
        })
    })
}

/// The parameters at a point of a line, in the units of the results; at its ends as they were given: 20 Hz where 20 was
/// typed, and not 20.000000000000004.
pub(super) fn values(cut: &Cut, value: f64, units: &Units) -> String {
    let end = value == cut.ends.0 || value == cut.ends.1;
    let cell = |(parameter, value): (Parameter, f64)| {
        let unit = units.of(parameter);
        Number(if end { typed(value, unit) } else { value * unit }).to_string()
    };
    cut.values(value).map(cell).collect::<Vec<_>>().join(",")
}

/// A value that was typed in another unit, to fifteen digits: the conversion there and back is not exact to more.
fn typed(value: f64, unit: f64) -> f64 {
    let product = value * unit;
    if unit == 1.0 { value } else { format!("{product:.14e}").parse().unwrap_or(product) }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typed_frequency_comes_back() {
        // beta of 20 Hz for a mass of 0.8 kg on 12000 N/m, and the natural frequency in Hz
        let natural = (12_000.0_f64 / 0.8).sqrt();
        let beta = core::f64::consts::TAU * 20.0 / natural;
        assert_eq!(typed(beta, natural / core::f64::consts::TAU), 20.0);
        assert_eq!(typed(0.1 + 0.2, 1.0), 0.1 + 0.2);
    }
}
