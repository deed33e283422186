//! The orbits with a label: one row for each.

use super::Table;
use super::cycle::Columns;
use crate::Units;
use crate::json::event::fastest;
use crate::json::orbit::{OrbitAnswer, OrbitObject};
use crate::number::Number;
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;

/// The table of `vibro orbit`: number, label, whether it is admissible and stable, its stability, fastest closing, multipliers, and
/// of each closing the phase, speed and stop; of a machine without forcing the period.
pub(crate) fn table<'a>(answer: OrbitAnswer<'a>, machine: Option<&Machine>, units: &Units) -> Table<'a> {
    let columns = Columns::new(machine, units, false);
    let speed = units.column("fastest", QuantityKind::Velocity);
    let header = format!("orbit,label,admissible,stable,stability,{speed},{}", columns.names());
    let rows = answer.orbits.into_iter().enumerate().map(move |(k, OrbitObject { motion, admissible, .. })| {
        let cycle = (motion.cycle.as_slice(), motion.period.unwrap_or(f64::NAN));
        let cells = columns.cells(cycle, motion.multipliers.as_deref().unwrap_or_default(), None);
        let (stable, stability) = (admissible && motion.stable == Some(true), motion.stability.unwrap_or_default());
        let (label, fastest) = (motion.label, Number(fastest(&motion.cycle)));
        format!("{},{label},{admissible},{stable},{stability},{fastest}{cells}", k + 1)
    });
    Table::new(header, rows)
}
