//! The orbits with a label: one row for each.

use super::Table;
use super::cycle::{Cells, Columns};
use crate::Units;
use crate::number::Number;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{Orbit, machine::Cycle};
use vibroimpact::verdict::Stability;
use vibroimpact::{Label, QuantityKind};

/// An orbit of any system.
struct Row<'a> {
    label: Label,
    admissible: bool,
    stability: Stability,
    fastest: f64,
    cycle: Cells<'a>,
}

/// Number, label, whether it is admissible and stable, its stability, fastest closing, multipliers, and of each closing the phase,
/// speed and stop.
fn written<'a>(fastest: &str, columns: Columns, rows: impl Iterator<Item = Row<'a>> + 'a) -> Table<'a> {
    let header = format!("orbit,label,admissible,stable,stability,{fastest},{}", columns.names());
    let rows = rows.enumerate().map(move |(k, Row { label, admissible, stability, fastest, cycle })| {
        let (stable, cycle) = (admissible && stability.is_stable(), columns.cells(&cycle));
        format!("{},{label},{admissible},{stable},{stability},{}{cycle}", k + 1, Number(fastest))
    });
    Table::new(header, rows)
}

/// The table of `vibro orbit`.
#[must_use]
pub fn table<'a>(found: &'a [Orbit], units: &'a Units) -> Table<'a> {
    let rows = found.iter().map(|orbit| Row {
        label: orbit.cycle.label,
        admissible: orbit.physical,
        stability: orbit.cycle.stability(),
        fastest: orbit.cycle.fastest() * units.velocity(),
        cycle: Cells::of_oscillator(&orbit.cycle, units),
    });
    written(&units.column("fastest", QuantityKind::Velocity), Columns::of_oscillator(units), rows)
}

/// The same of a machine, and without forcing the period.
#[must_use]
pub fn of_machine<'a>(found: &'a [Cycle], machine: &'a Machine) -> Table<'a> {
    let rows = found.iter().map(|cycle| Row {
        label: cycle.label,
        // others are not found
        admissible: true,
        stability: cycle.stability(),
        fastest: cycle.fastest(),
        cycle: Cells::of_machine(cycle, machine),
    });
    written("fastest", Columns::of_machine(machine, false), rows)
}
