//! A basin: one row for each start, in the order of the cells.

use super::Table;
use super::quantities::{cells, columns, finite};
use super::remarks::remarks;
use crate::Units;
use crate::number::Number;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::of_verdict;
use vibroimpact::verdict::{CountedMotion, Verdict};
use vibroimpact_study::{Axis, Basin, MachineBasin, PlanError};

/// The table of `vibro basin`: the quantities that vary, in the units and with exactly the numbers of the question, the
/// label, and the quantities that the plan asks for.
///
/// # Errors
/// [`PlanError`] if a value of an axis overflows in these units.
pub fn table<'a>(found: &'a Basin, osc: &Oscillator, units: &Units) -> Result<Table<'a>, PlanError> {
    let axes = &found.plan.axes;
    let names: Vec<&str> = axes.iter().map(|axis| units.column_of_coordinate(axis.vary)).collect();
    let texts = axes.iter().map(|axis| {
        let values = units.shown(axis)?;
        Ok(values.all().into_iter().map(|value| Number(value).to_string()).collect())
    });
    let texts = texts.collect::<Result<Vec<Vec<String>>, PlanError>>()?;
    let fields = &found.plan.fields;
    let ending = |motion: &CountedMotion| {
        let quantities = if fields.is_empty() { None } else { of_verdict(osc, &motion.verdict) };
        format!("{}{}", motion.verdict.label(), cells(fields, quantities, units))
    };
    let endings: Vec<String> = found.motions.iter().map(ending).collect();
    let rows = found.cells.iter().enumerate().map(move |(k, motion)| {
        let mut rest = k;
        let mut row = String::new();
        for values in &texts {
            row.push_str(&values[rest % values.len()]);
            row.push(',');
            rest /= values.len();
        }
        row + &endings[usize::from(*motion)]
    });
    Ok(Table::new(format!("{},label{}", names.join(","), columns(fields, units)), rows))
}

/// One row a start: what varies, the label, what stops and events say more of it, and quantities; `refused` beyond a rigid stop.
pub(crate) fn of_machine<'a>(machine: &'a Machine, found: &'a MachineBasin) -> Table<'a> {
    let remarks = remarks(found.motions.iter());
    let rows = found.cells.iter().enumerate().map(move |(k, cell)| {
        let motion = cell.map(|cell| &found.motions[cell]);
        let label = motion.map_or_else(|| "refused".into(), Verdict::label);
        let closed = motion.map_or_else(Vec::new, Verdict::closed);
        let remarks = remarks.cells(machine, &closed, found.seen_events[k]);
        let fields = cell.map_or_else(|| ",".repeat(found.fields.len()), |cell| finite(&found.quantities[cell]));
        format!("{}{label}{remarks}{fields}", values(&found.axes, k))
    });
    let own: Vec<&str> = core::iter::once("label").chain(remarks.heads()).collect();
    let header =
        found.axes.iter().map(|axis| axis.vary.as_str()).chain(own).chain(found.fields.iter().map(String::as_str));
    Table::new(header.collect::<Vec<_>>().join(","), rows)
}

/// The values at point `k`, each followed by a comma.
fn values(axes: &[Axis<String>], k: usize) -> String {
    Axis::<String>::at(axes, k as u64).into_iter().map(|value| format!("{},", Number(value))).collect()
}
