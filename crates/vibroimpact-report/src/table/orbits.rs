//! The orbits with a label: one row for each.

use super::Table;
use super::branch::{cells, cycle_columns};
use super::machine_branch::{closing_columns, closings};
use super::machine_tables::{numbered, push};
use crate::Units;
use crate::number::Number;
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{MachineCycle, Orbit};

/// Number, label, whether it is admissible and stable, its stability, fastest closing, multipliers, and of each closing the phase,
/// speed and stop.
#[must_use]
pub fn table<'a>(found: &'a [Orbit], units: &'a Units) -> Table<'a> {
    let fastest = units.column("fastest", QuantityKind::Velocity);
    let rows = found.iter().enumerate().map(move |(k, orbit)| {
        let (cycle, stable) = (&orbit.cycle, orbit.physical && orbit.cycle.stable());
        let fastest = Number(cycle.fastest() * units.velocity());
        let head = format!("{},{},{},{stable},{}", k + 1, cycle.label, orbit.physical, cycle.stability());
        format!("{head},{fastest},{}", cells(cycle, units))
    });
    Table::new(format!("orbit,label,admissible,stable,stability,{fastest},{}", cycle_columns(units)), rows)
}

/// The same of a machine, and without forcing the period.
#[must_use]
pub fn of_machine<'a>(found: &'a [MachineCycle], machine: &'a Machine) -> Table<'a> {
    let own = ["orbit", "label", "admissible", "stable", "stability", "fastest"].into_iter().map(str::to_owned);
    let header = own.chain(numbered(machine)).chain(closing_columns(machine)).collect::<Vec<_>>().join(",");
    let rows = found.iter().enumerate().map(move |(k, cycle)| {
        let (stable, stability) = (cycle.stable(), cycle.stability());
        let mut row = format!("{},{},true,{stable},{stability},{}", k + 1, cycle.label, Number(cycle.fastest()));
        push(&mut row, Some(&cycle.multipliers), machine.n());
        row.push_str(&closings(machine, cycle));
        row
    });
    Table::new(header, rows)
}
