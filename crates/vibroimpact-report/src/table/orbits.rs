//! The orbits with a label: one row for each.

use super::Table;
use super::cycle::Columns;
use crate::Units;
use crate::number::Number;
use crate::solutions::OrbitView;
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;

/// The table of `vibro orbit`: number, label, whether it is admissible and stable, its stability, fastest closing, multipliers, and
/// of each closing the phase, speed and stop; of a machine without forcing the period.
#[must_use]
pub fn table<'a>(orbits: Vec<OrbitView<'a>>, machine: Option<&Machine>, units: &Units) -> Table<'a> {
    let columns = Columns::new(machine, units, false);
    let fastest = units.column("fastest", QuantityKind::Velocity);
    let header = format!("orbit,label,admissible,stable,stability,{fastest},{}", columns.names());
    let rows = orbits.into_iter().enumerate().map(move |(k, OrbitView { cycle, admissible, .. })| {
        let (label, stability, fastest) = (cycle.label(), cycle.stability(), Number(cycle.fastest()));
        let (stable, cells) = (admissible && stability.is_stable(), columns.cells(&cycle));
        format!("{},{label},{admissible},{stable},{stability},{fastest}{cells}", k + 1)
    });
    Table::new(header, rows)
}
