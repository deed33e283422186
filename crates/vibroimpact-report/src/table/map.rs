//! A map: one row for each motion at each point.

use super::Table;
use super::quantities::{cells, columns, finite};
use super::remarks::Remarks;
use crate::Units;
use crate::number::Number;
use vibroimpact::machine::Machine;
use vibroimpact_study::{MachineMap, MachineShare, PlanError, RegionMap};

/// The table of `vibro map`: the quantities that vary, in the units and with exactly the numbers of the question, the
/// label, its share of the starts, and the quantities that the plan asks for.
///
/// # Errors
/// [`PlanError`] if a value of an axis overflows in these units.
pub fn table(found: &RegionMap, units: Units) -> Result<Table<'_>, PlanError> {
    let axes = &found.plan.axes;
    let names: Vec<&str> = axes.iter().map(|axis| units.column_of_coordinate(axis.vary)).collect();
    let values = axes.iter().map(|axis| Ok(units.shown(axis)?.all()));
    let values = values.collect::<Result<Vec<Vec<f64>>, PlanError>>()?;
    let rows = found.points.iter().enumerate().flat_map(move |(k, point)| {
        let mut rest = k;
        let mut place = String::new();
        for values in &values {
            place.push_str(&format!("{},", Number(values[rest % values.len()])));
            rest /= values.len();
        }
        let units = units.over(axes, |axis| point.at[axis]);
        point.motions.iter().map(move |motion| {
            let own = cells(&found.plan.fields, motion.quantities, &units);
            format!("{place}{},{}{own}", motion.verdict.label(), Number(motion.share))
        })
    });
    Ok(Table::new(format!("{},label,share{}", names.join(","), columns(&found.plan.fields, &units)), rows))
}

/// One row a motion at a point: what varies, label, share, what stops and events say more of the label, and quantities. Of points that
/// are no grid their number comes first, and there is no share.
pub(crate) fn of_machine<'a>(machine: &'a Machine, found: &'a MachineMap) -> Table<'a> {
    let motions = found.cells.iter().flatten();
    let remarks = Remarks::of(motions.map(|motion| (motion.stops.as_slice(), motion.seen_events)));
    let grid = found.points.is_empty();
    let rows = found.cells.iter().enumerate().flat_map(move |(k, cell)| {
        let number = if grid { String::new() } else { format!("{},", k + 1) };
        let at: String = found.at(k).into_iter().map(|value| format!("{},", Number(value))).collect();
        let row = |motion: &MachineShare| {
            let share = if grid { format!(",{}", Number(motion.share)) } else { String::new() };
            let remarks = remarks.cells(machine, &motion.stops, motion.seen_events);
            format!("{number}{at}{}{share}{remarks}{}", motion.label(), finite(&motion.quantities))
        };
        let mut rows: Vec<String> = cell.iter().map(row).collect();
        if rows.is_empty() && !grid {
            // numbers that are not allowed, or a start beyond a stop
            let empty = ",".repeat(remarks.heads().count() + found.fields.len());
            rows.push(format!("{number}{at}refused{empty}"));
        }
        rows
    });
    let own: Vec<&str> = ["label", "share"].into_iter().take(if grid { 2 } else { 1 }).chain(remarks.heads()).collect();
    let head = if grid { vec![] } else { vec!["sample"] };
    let fields = found.fields.iter().map(String::as_str);
    let header = head.into_iter().chain(found.varied()).chain(own).chain(fields).collect::<Vec<_>>().join(",");
    Table::new(header, rows)
}
