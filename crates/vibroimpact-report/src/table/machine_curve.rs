//! Curves of events of machines: one row for each point.

use super::Table;
use super::machine_branch::{CLOSINGS, closings};
use super::machine_tables::{numbered, push};
use crate::number::Number;
use vibroimpact::machine::Machine;
use vibroimpact_study::{MachineCurvePlan, MachineEventCurve};

/// One row a point: both numbers, label, whether it is stable, event, stop of the event, residual of the condition, phase of
/// the touch, period, multipliers, and of each closing besides the touch the phase, speed and stop.
pub(crate) fn table<'a>(machine: &'a Machine, plan: &MachineCurvePlan, found: &'a MachineEventCurve) -> Table<'a> {
    let numbers = [plan.vary.path.as_str(), plan.and.path.as_str()].into_iter();
    let names = numbers.chain(["label", "event", "stop", "residual", "touch", "period"]);
    let header = names.map(str::to_owned).chain(numbered(machine)).chain(CLOSINGS.map(str::to_owned));
    let header = header.collect::<Vec<_>>().join(",");
    let rows = found.points.iter().map(|point| {
        let (p, q) = point.values;
        let event = point.event.map_or("", |event| event.name());
        let stop = point.event.and_then(|event| event.place()).map_or("", |place| machine.name_of(place));
        let touch = point.touch.map_or_else(String::new, |phase| Number(phase).to_string());
        let (label, residual, period) = (point.cycle.label, Number(point.residual), Number(point.cycle.period));
        let mut row = format!("{},{},{label},{event},{stop},{residual},{touch},{period}", Number(p), Number(q));
        push(&mut row, Some(&point.cycle.multipliers), machine.n());
        row.push_str(&closings(machine, &point.cycle));
        row
    });
    Table::new(header, rows)
}
