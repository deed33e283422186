//! Branches of periodic orbits: one row for each point.

use super::Table;
use super::cycle::Columns;
use crate::Varied;
use crate::number::Number;
use crate::solutions::{BranchesView, Event, PointView};
use vibroimpact::QuantityKind;

/// The table of `vibro branch`; of a machine that can be translated with the drift, and without forcing with the period.
#[must_use]
pub fn table<'a, V: Varied>(view: BranchesView<'a, V>) -> Table<'a> {
    let mut points = view.branches.iter().flat_map(|branch| &branch.points);
    let columns = Columns::new(view.machine, &view.units, points.any(|point| point.cycle.drift().is_some()));
    let fastest = view.units.column("fastest", QuantityKind::Velocity);
    let (varied, cycle) = (view.columns().join(","), columns.names());
    let header = format!("branch,{varied},label,admissible,stable,stability,event,stop,{fastest},{cycle}");
    let points = view.branches.into_iter().enumerate();
    let points = points.flat_map(|(k, branch)| branch.points.into_iter().map(move |point| (k + 1, point)));
    Table::new(header, points.map(move |(branch, point)| row(branch, &point, &columns)))
}

fn row(branch: usize, point: &PointView<'_>, columns: &Columns) -> String {
    let values: String = point.values.iter().map(|value| format!("{},", Number(*value))).collect();
    let (cycle, admissible, stable, event) = (&point.cycle, point.admissible, point.stable(), point.event_name());
    let stop = point.event.as_ref().and_then(Event::stop).unwrap_or_default();
    let (label, stability) = (cycle.label(), cycle.stability());
    let (fastest, cycle) = (Number(cycle.fastest()), columns.cells(cycle));
    format!("{branch},{values}{label},{admissible},{stable},{stability},{event},{stop},{fastest}{cycle}")
}
