//! Curves of events in a plane of two parameters: one row for each point.

use super::Table;
use super::cycle::Columns;
use crate::Varied;
use crate::number::Number;
use crate::solutions::{CurvePointView, CurveView};

/// The table of `vibro curve`. Of a machine with the stop of an event, the residual of the condition and the phase of the touch,
/// which is none of the closings, and without forcing with the period.
#[must_use]
pub fn table<'a, V: Varied>(view: CurveView<'a, V>) -> Table<'a> {
    let columns = Columns::new(view.machine, &view.units, false);
    let [p, q] = view.sides().map(|side| side.parameter.column(&view.units));
    let more = if view.machine.is_some() { ",stop,residual,touch" } else { "" };
    let header = format!("{p},{q},label,admissible,event{more},{}", columns.names());
    let more = !more.is_empty();
    Table::new(header, view.points.into_iter().map(move |point| row(&point, &columns, more)))
}

fn row(point: &CurvePointView<'_>, columns: &Columns, more: bool) -> String {
    let ([p, q], cell) =
        (point.values.map(Number), |x: Option<f64>| x.map_or_else(String::new, |x| Number(x).to_string()));
    let (event, stop) = point.event.unwrap_or_default();
    let more = more.then(|| {
        let stop = stop.unwrap_or_default();
        format!(",{stop},{},{}", cell(point.residual), cell(point.touch))
    });
    let (label, cycle) = (point.cycle.label(), columns.cells(&point.cycle));
    format!("{p},{q},{label},{},{event}{}{cycle}", point.admissible, more.unwrap_or_default())
}
