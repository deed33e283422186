//! Branches of machines: one row for each point.

use super::Table;
use super::machine_tables::{drifts, numbered, push, push_drift};
use crate::number::Number;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::MachineCycle;
use vibroimpact_study::{Cut, MachineBranched};

/// The columns of the closings of stops, and without forcing of the period, which the label says otherwise.
pub(super) fn closing_columns(machine: &Machine) -> impl Iterator<Item = String> {
    let period = machine.period().is_none().then_some("period");
    ["phases", "speeds", "stops"].into_iter().chain(period).map(str::to_owned)
}

/// One row a point: number of the branch, the numbers that vary, label, whether it is admissible and stable, its stability, event,
/// stop of the event, fastest closing, multipliers, the drift of a machine that can be translated, of each closing the phase, speed and stop,
/// and without forcing the period.
pub(crate) fn table<'a>(machine: &'a Machine, cut: &Cut<String>, found: &'a MachineBranched) -> Table<'a> {
    let own = ["label", "admissible", "stable", "stability", "event", "stop", "fastest"];
    let heads = core::iter::once("branch").chain(cut.paths()).chain(own).map(str::to_owned);
    let drifting = found.all().flatten().any(|point| point.cycle.translations() > 0);
    let header = heads
        .chain(numbered(machine))
        .chain(drifts(machine, drifting))
        .chain(closing_columns(machine))
        .collect::<Vec<_>>()
        .join(",");
    let cut = cut.clone();
    let points = found.all().enumerate().flat_map(|(k, points)| points.iter().map(move |point| (k + 1, point)));
    let rows = points.map(move |(number, point)| {
        let event = point.event.map_or("", |event| event.name());
        let stop = point.event.and_then(|event| event.place()).map_or("", |place| machine.name_of(place));
        let cycle = &point.cycle;
        let values: String = cut.values(point.value).map(|value| format!("{},", Number(value))).collect();
        // a branch ends where its orbit ceases to be admissible
        let (stable, stability, fastest) = (cycle.stable(), cycle.stability(), Number(cycle.fastest()));
        let mut row = format!("{number},{values}{},true,{stable},{stability},{event},{stop},{fastest}", cycle.label);
        push(&mut row, Some(&cycle.multipliers), machine.n());
        if drifting {
            push_drift(&mut row, Some(cycle), machine.n());
        }
        row.push_str(&closings(machine, cycle));
        row
    });
    Table::new(header, rows)
}

/// Phases, speeds and stops of the closings of a cycle, lists with blanks between, and without forcing its period, each after a
/// comma.
pub(super) fn closings(machine: &Machine, cycle: &MachineCycle) -> String {
    let list = |of: &dyn Fn(&vibroimpact::events::MachineEvent) -> String| {
        cycle.events.iter().filter(|event| event.closes()).map(of).collect::<Vec<_>>().join(" ")
    };
    let period = machine.period().map_or_else(|| format!(",{}", Number(cycle.period)), |_| String::new());
    format!(
        ",{},{},{}{period}",
        list(&|event| Number(event.phase).to_string()),
        list(&|event| Number(event.speed).to_string()),
        list(&|event| machine.name_of(event.place).to_owned())
    )
}
