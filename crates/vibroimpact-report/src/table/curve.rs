//! Curves of events in a plane of two parameters: one row for each point.

use super::Table;
use super::cycle::Columns;
use crate::json::curve::CurveAnswer;
use crate::number::Number;
use crate::{Units, Varied};
use vibroimpact::machine::Machine;
use vibroimpact_study::CurvePlan;

/// The table of `vibro curve`. Of a machine with the stop of an event, the residual of the condition and the phase of the touch,
/// which is none of the closings, and without forcing with the period.
pub(crate) fn table<'a, V: Varied>(
    answer: CurveAnswer<'a>,
    machine: Option<&Machine>,
    (plan, units): (&CurvePlan<V>, &Units),
) -> Table<'a> {
    let columns = Columns::new(machine, units, false);
    let (p, q) = (plan.vary.parameter.column(units), plan.and.parameter.column(units));
    let more = machine.is_some();
    let names = if more { ",stop,residual,touch" } else { "" };
    let header = format!("{p},{q},label,admissible,event{names},{}", columns.names());
    Table::new(header, (0..answer.points.len()).map(move |k| row(&answer, k, &columns, more)))
}

fn row(answer: &CurveAnswer<'_>, k: usize, columns: &Columns, more: bool) -> String {
    let (point, event) = (&answer.points[k], answer.event_at(k));
    let cell = |x: Option<f64>| x.map_or_else(String::new, |x| Number(x).to_string());
    let more = more.then(|| {
        let stop = event.and_then(|event| event.stop).unwrap_or_default();
        format!(",{stop},{},{}", cell(point.residual), cell(point.touch))
    });
    let cycle = columns.cells((&point.cycle, point.period), &point.multipliers, None);
    let ([p, q], kind) = (point.values.map(Number), event.map_or("", |event| event.kind));
    format!("{p},{q},{},{},{kind}{}{cycle}", point.label, point.admissible, more.unwrap_or_default())
}
