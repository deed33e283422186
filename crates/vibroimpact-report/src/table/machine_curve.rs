//! Curves of events of machines: one row for each point.

use super::Table;
use super::machine_branch::{closing_columns, closings};
use super::machine_tables::{numbered, push};
use crate::number::Number;
use vibroimpact::machine::Machine;
use vibroimpact_study::{CurvePlan, MachineEventCurve, Name, Variable};

/// One row a point: both numbers, label, whether it is admissible, event, stop of the event, residual of the condition, phase of
/// the touch, multipliers, of each closing besides the touch the phase, speed and stop, and without
/// forcing the period.
pub(crate) fn table<'a>(machine: &'a Machine, plan: &CurvePlan<Variable>, found: &'a MachineEventCurve) -> Table<'a> {
    let names = [
        plan.vary.parameter.text(),
        plan.and.parameter.text(),
        "label",
        "admissible",
        "event",
        "stop",
        "residual",
        "touch",
    ];
    let header = names.map(str::to_owned).into_iter().chain(numbered(machine)).chain(closing_columns(machine));
    let header = header.collect::<Vec<_>>().join(",");
    let rows = found.points.iter().map(|point| {
        let (p, q) = point.values;
        let event = point.event.map_or("", |event| event.name());
        let stop = point.event.and_then(|event| event.place()).map_or("", |place| machine.name_of(place));
        let touch = point.touch.map_or_else(String::new, |phase| Number(phase).to_string());
        let (label, residual) = (point.cycle.label, Number(point.residual));
        let mut row = format!("{},{},{label},true,{event},{stop},{residual},{touch}", Number(p), Number(q));
        push(&mut row, Some(&point.cycle.multipliers), machine.n());
        row.push_str(&closings(machine, &point.cycle));
        row
    });
    Table::new(header, rows)
}
