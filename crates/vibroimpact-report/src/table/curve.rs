//! Curves of events in a plane of two parameters: one row for each point.

use super::Table;
use super::cycle::{Cells, Columns};
use crate::Units;
use crate::json::curve::values;
use crate::number::Number;
use vibroimpact::continuation::machine::{CurvePoint, SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact_study::{CurvePlan, EventCurve};

/// The table of `vibro curve`.
#[must_use]
pub fn table<'a>(found: &'a EventCurve, plan: CurvePlan, units: &'a Units) -> Table<'a> {
    let (p, q) = (units.column_of(plan.vary.parameter), units.column_of(plan.and.parameter));
    let columns = Columns::of_oscillator(units);
    let header = format!("{p},{q},label,admissible,event,{}", columns.names());
    let rows = found.points.iter().map(move |point| {
        let [p, q] = values(point.values, &plan, units);
        let event = point.event.map_or("", |event| event.name());
        let there = units.at_both((plan.vary.parameter, plan.and.parameter), point.values);
        let cycle = columns.cells(&Cells::of_oscillator(&point.cycle, &there));
        format!("{},{},{},{},{event}{cycle}", Number(p), Number(q), point.cycle.label, point.physical)
    });
    Table::new(header, rows)
}

/// The same of a machine, with the stop of an event, the residual of the condition and the phase of the touch, which is none of the
/// closings, and without forcing with the period.
pub(crate) fn of_machine<'a>(
    machine: &'a Machine,
    plan: &CurvePlan<String>,
    found: &'a EventCurve<Cycle, SolutionPoint, CurvePoint>,
) -> Table<'a> {
    let (p, q) = (&plan.vary.parameter, &plan.and.parameter);
    let columns = Columns::of_machine(machine, false);
    let header = format!("{p},{q},label,admissible,event,stop,residual,touch,{}", columns.names());
    let rows = found.points.iter().map(move |point| {
        let (p, q) = point.values;
        let event = point.event.map_or("", |event| event.name());
        let stop = point.event.and_then(|event| event.place()).map_or("", |place| machine.name_of(place));
        let touch = point.touch.map_or_else(String::new, |phase| Number(phase).to_string());
        let (label, residual) = (point.cycle.label, Number(point.residual));
        let cycle = columns.cells(&Cells::of_machine(&point.cycle, machine));
        format!("{},{},{label},true,{event},{stop},{residual},{touch}{cycle}", Number(p), Number(q))
    });
    Table::new(header, rows)
}
