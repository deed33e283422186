//! Branches of periodic orbits: one row for each point.

use super::Table;
use super::cycle::{Cells, Columns};
use crate::Units;
use crate::json::event::side;
use crate::number::Number;
use vibroimpact::QuantityKind;
use vibroimpact::continuation::SolutionPoint;
use vibroimpact::continuation::machine;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact_study::{Branches, Cut, EventRecord};

/// A point of a branch of any system.
struct Row<'a> {
    branch: usize,
    /// The values of what varies, in the units of the results.
    values: Vec<f64>,
    label: String,
    admissible: bool,
    stable: bool,
    stability: &'static str,
    event: &'static str,
    /// The stop of the event.
    stop: &'a str,
    fastest: f64,
    cycle: Cells<'a>,
}

/// The table with these names of what varies, of the fastest closing, and of the columns of cycles.
fn written<'a>(
    varied: impl Iterator<Item = String>,
    fastest: &str,
    columns: Columns,
    rows: impl Iterator<Item = Row<'a>> + 'a,
) -> Table<'a> {
    let (varied, cycle) = (varied.collect::<Vec<_>>().join(","), columns.names());
    let header = format!("branch,{varied},label,admissible,stable,stability,event,stop,{fastest},{cycle}");
    let rows = rows.map(move |row| {
        let Row { branch, label, admissible, stable, stability, event, stop, .. } = &row;
        let values: String = row.values.iter().map(|value| format!("{},", Number(*value))).collect();
        let (fastest, cycle) = (Number(row.fastest), columns.cells(&row.cycle));
        format!("{branch},{values}{label},{admissible},{stable},{stability},{event},{stop},{fastest}{cycle}")
    });
    Table::new(header, rows)
}

/// The table of `vibro branch`.
#[must_use]
pub fn table<'a>(found: &'a Branches, cut: &Cut, units: &'a Units) -> Table<'a> {
    let cut = *cut;
    let row = move |branch: usize, point: &'a SolutionPoint| {
        let there = units.at(cut.vary, point.value);
        Row {
            branch,
            values: cut.names().zip(cut.values(point.value)).map(|(number, value)| value * there.of(*number)).collect(),
            label: point.cycle.label.to_string(),
            admissible: point.physical,
            stable: point.stable(),
            stability: point.stability().name(),
            event: point.event.map_or("", |event| event.name()),
            stop: point.event.and_then(|event| EventRecord::of(point, &event).side).map_or("", side),
            fastest: point.cycle.fastest() * there.velocity(),
            cycle: Cells::of_oscillator(&point.cycle, &there),
        }
    };
    let branches = found.followed.iter().enumerate();
    let rows = branches.flat_map(move |(k, branch)| branch.points.iter().map(move |point| row(k + 1, point)));
    let varied: Vec<String> = cut.names().map(|parameter| units.column_of(*parameter).to_owned()).collect();
    let fastest = units.column("fastest", QuantityKind::Velocity);
    written(varied.into_iter(), &fastest, Columns::of_oscillator(units), rows)
}

/// The same of a machine, with the drift of one that can be translated, and without forcing with the period.
pub(crate) fn of_machine<'a>(
    machine: &'a Machine,
    cut: &Cut<String>,
    found: &'a Branches<Cycle, machine::SolutionPoint>,
) -> Table<'a> {
    let all = || found.followed.iter().map(|branch| &branch.points);
    let drifting = all().flatten().any(|point| point.cycle.translations() > 0);
    let varied: Vec<String> = cut.names().cloned().collect();
    let cut = cut.clone();
    let points = all().enumerate().flat_map(|(k, points)| points.iter().map(move |point| (k + 1, point)));
    let rows = points.map(move |(branch, machine::SolutionPoint { value, cycle, event, .. })| Row {
        branch,
        values: cut.values(*value).collect(),
        label: cycle.label.to_string(),
        // a branch ends where its orbit ceases to be admissible
        admissible: true,
        stable: cycle.stable(),
        stability: cycle.stability().name(),
        event: event.map_or("", |event| event.name()),
        stop: event.and_then(|event| event.place()).map_or("", |place| machine.name_of(place)),
        fastest: cycle.fastest(),
        cycle: Cells::of_machine(cycle, machine),
    });
    written(varied.into_iter(), "fastest", Columns::of_machine(machine, drifting), rows)
}
