//! Branches of periodic orbits: one row for each point.

use super::Table;
use super::cycle::Columns;
use crate::json::branch::{BranchAnswer, PointObject};
use crate::json::event::fastest;
use crate::number::Number;
use crate::{Units, Varied};
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;
use vibroimpact_study::Cut;

/// The table of `vibro branch`; of a machine that can be translated with the drift, and without forcing with the period.
pub(crate) fn table<'a, V: Varied>(
    answer: BranchAnswer<'a>,
    machine: Option<&Machine>,
    (cut, units): (&Cut<V>, &Units),
) -> Table<'a> {
    let mut points = answer.branches.iter().flat_map(|branch| &branch.points);
    let columns = Columns::new(machine, units, points.any(|point| point.drift.is_some()));
    let varied: Vec<&str> = cut.names().map(|name| name.column(units)).collect();
    let (varied, speed) = (varied.join(","), units.column("fastest", QuantityKind::Velocity));
    let header = format!("branch,{varied},label,admissible,stable,stability,event,stop,{speed},{}", columns.names());
    let rows = answer.branches.into_iter().enumerate().flat_map(move |(number, branch)| {
        let points = branch.points.iter().enumerate();
        let rows = points.map(|(k, point)| format!("{},{}", number + 1, row(point, branch.mark_at(k), &columns)));
        rows.collect::<Vec<_>>()
    });
    Table::new(header, rows)
}

fn row(point: &PointObject<'_>, (kind, stop): (&str, &str), columns: &Columns) -> String {
    let values: String = point.values().iter().map(|value| format!("{},", Number(*value))).collect();
    let PointObject { label, admissible, stable, stability, .. } = point;
    let cells = columns.cells((&point.cycle, point.period), &point.multipliers, point.drift.as_ref());
    let fastest = Number(fastest(&point.cycle));
    format!("{values}{label},{admissible},{stable},{stability},{kind},{stop},{fastest}{cells}")
}
