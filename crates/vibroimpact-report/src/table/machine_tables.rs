//! Tables of machines: attractors, basins and maps.

use super::Table;
use crate::number::Number;
use vibroimpact::machine::Machine;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::quantities::{machine_quantities, machine_quantity_paths};
use vibroimpact::verdict::{Census, Verdict};
use vibroimpact_study::{MachineAxis, MachineBasin, MachineMap, MachineShare};

/// The names of stops with blanks between, after a comma.
fn stops_of(machine: &Machine, stops: &[usize]) -> String {
    format!(",{}", stops.iter().map(|stop| machine.name_of(*stop)).collect::<Vec<_>>().join(" "))
}

/// The columns that say more of some labels than the label, where such motions are in a table: the stops that stay closed for ever,
/// and the number of events over which chaos was seen.
#[derive(Clone, Copy)]
struct Remarks {
    stops: bool,
    events: bool,
}

impl Remarks {
    fn of<'a>(motions: impl Iterator<Item = (&'a [usize], Option<u64>)>) -> Self {
        motions.fold(Self { stops: false, events: false }, |so_far, (stops, events)| Self {
            stops: so_far.stops || !stops.is_empty(),
            events: so_far.events || events.is_some(),
        })
    }

    fn heads(self) -> impl Iterator<Item = &'static str> {
        [("stop", self.stops), ("seen_events", self.events)].into_iter().filter_map(|(name, here)| here.then_some(name))
    }

    /// The cells of a motion, each after a comma.
    fn cells(self, machine: &Machine, stops: &[usize], events: Option<u64>) -> String {
        let mut cells = String::new();
        if self.stops {
            cells.push_str(&stops_of(machine, stops));
        }
        if self.events {
            cells.push_str(&events.map_or_else(|| ",".to_owned(), |events| format!(",{events}")));
        }
        cells
    }
}

/// The remarks on the motions of a table of verdicts.
fn remarks<'a>(verdicts: impl Iterator<Item = &'a Verdict<Machine>>) -> Remarks {
    let closed: Vec<(Vec<usize>, Option<u64>)> = verdicts.map(|one| (one.closed(), one.seen_events())).collect();
    Remarks::of(closed.iter().map(|(stops, events)| (stops.as_slice(), *events)))
}

/// One row a motion: label, share, starts, counts of each stop, real and imaginary part of all multipliers, the drift of a
/// machine that can be translated, all quantities by path.
pub(crate) fn attractors<'a>(machine: &'a Machine, census: &'a Census<Machine>) -> Table<'a> {
    let stops = machine.stops().iter().map(|stop| format!("count.{}", stop.name));
    let paths = machine_quantity_paths(machine);
    let undefined = vec![f64::NAN; paths.len()];
    let header = ["label", "share", "starts"].into_iter().map(str::to_owned).chain(stops).chain(numbered(machine));
    let drifting =
        census.motions().iter().any(|found| cycle_of(&found.verdict).is_some_and(|cycle| cycle.translations() > 0));
    let remarks = remarks(census.motions().iter().map(|found| &found.verdict));
    let header = header.chain(drifts(machine, drifting)).chain(remarks.heads().map(str::to_owned));
    let header = header.chain(paths).collect::<Vec<_>>().join(",");
    let rows = census.by_share().into_iter().map(move |found| {
        let mut row = format!("{},{},{}", found.verdict.label(), Number(census.share(found)), found.count);
        let cycle = cycle_of(&found.verdict);
        let (counts, multipliers) = (cycle.map(|cycle| &cycle.counts), cycle.map(|cycle| &cycle.multipliers));
        for k in 0..machine.stops().len() {
            row.push_str(&counts.map_or_else(|| ",".to_owned(), |counts| format!(",{}", counts[k])));
        }
        push(&mut row, multipliers, machine.n());
        if drifting {
            push_drift(&mut row, cycle, machine.n());
        }
        row.push_str(&remarks.cells(machine, &found.verdict.closed(), found.verdict.seen_events()));
        let values = machine_quantities(machine, &found.verdict)
            .map_or_else(|| undefined.clone(), |found| found.iter().map(|(.., measured)| measured.value).collect());
        row.push_str(&quantities(&values));
        row
    });
    Table::new(header, rows)
}

const fn cycle_of(verdict: &Verdict<Machine>) -> Option<&MachineCycle> {
    match verdict {
        Verdict::Periodic(cycle) => Some(cycle),
        _ => None,
    }
}

/// The names of the columns of the drift, if there are any.
pub(super) fn drifts(machine: &Machine, drifting: bool) -> impl Iterator<Item = String> {
    machine.parts().coordinates.iter().filter(move |_| drifting).map(|name| format!("drift.{name}"))
}

pub(super) fn push_drift(row: &mut String, cycle: Option<&MachineCycle>, n: usize) {
    match cycle {
        Some(cycle) => cycle.drift.iter().for_each(|drift| row.push_str(&format!(",{}", Number(*drift)))),
        None => row.push_str(&",".repeat(n)),
    }
}

/// The names of the columns of multipliers.
pub(super) fn numbered(machine: &Machine) -> impl Iterator<Item = String> {
    (1..=2 * machine.n()).flat_map(|k| [format!("multiplier_{k}_re"), format!("multiplier_{k}_im")])
}

pub(super) fn push(row: &mut String, multipliers: Option<&Vec<Multiplier>>, n: usize) {
    for k in 0..2 * n {
        match multipliers.and_then(|all| all.get(k)) {
            Some(multiplier) => row.push_str(&format!(",{},{}", Number(multiplier.re), Number(multiplier.im))),
            None => row.push_str(",,"),
        }
    }
}

fn heads(axes: &[MachineAxis]) -> Vec<&str> {
    axes.iter().map(|axis| axis.vary.as_str()).collect()
}

/// The values at point `k`, each followed by a comma.
fn values(axes: &[MachineAxis], k: usize) -> String {
    MachineAxis::at(axes, k as u64).into_iter().map(|value| format!("{},", Number(value))).collect()
}

/// The values of quantities, each after a comma; empty where they are not defined or infinite.
fn quantities(values: &[f64]) -> String {
    let cell = |value: &f64| if value.is_finite() { format!(",{}", Number(*value)) } else { ",".to_owned() };
    values.iter().map(cell).collect()
}

fn header<'a>(axes: &'a [MachineAxis], own: &[&'a str], fields: &'a [String]) -> String {
    let fields = fields.iter().map(String::as_str);
    heads(axes).into_iter().chain(own.iter().copied()).chain(fields).collect::<Vec<_>>().join(",")
}

/// One row a start: what varies, the label, what stops and events say more of it, and quantities; `refused` beyond a rigid stop.
pub(crate) fn basin<'a>(machine: &'a Machine, found: &'a MachineBasin) -> Table<'a> {
    let remarks = remarks(found.motions.iter());
    let rows = found.cells.iter().enumerate().map(move |(k, cell)| {
        let motion = cell.map(|cell| &found.motions[cell]);
        let label = motion.map_or_else(|| "refused".into(), Verdict::label);
        let closed = motion.map_or_else(Vec::new, Verdict::closed);
        let remarks = remarks.cells(machine, &closed, found.seen_events[k]);
        let values = cell.map_or_else(|| ",".repeat(found.fields.len()), |cell| quantities(&found.quantities[cell]));
        format!("{}{label}{remarks}{values}", self::values(&found.axes, k))
    });
    let own: Vec<&str> = core::iter::once("label").chain(remarks.heads()).collect();
    Table::new(header(&found.axes, &own, &found.fields), rows)
}

/// One row a motion at a point: what varies, label, share, what stops and events say more of the label, and quantities. Of points that
/// are no grid their number comes first, and there is no share.
pub(crate) fn map<'a>(machine: &'a Machine, found: &'a MachineMap) -> Table<'a> {
    let motions = found.cells.iter().flatten();
    let remarks = Remarks::of(motions.map(|motion| (motion.stops.as_slice(), motion.seen_events)));
    let grid = found.points.is_empty();
    let rows = found.cells.iter().enumerate().flat_map(move |(k, cell)| {
        let number = if grid { String::new() } else { format!("{},", k + 1) };
        let at: String = found.at(k).into_iter().map(|value| format!("{},", Number(value))).collect();
        let row = |motion: &MachineShare| {
            let share = if grid { format!(",{}", Number(motion.share)) } else { String::new() };
            let remarks = remarks.cells(machine, &motion.stops, motion.seen_events);
            format!("{number}{at}{}{share}{remarks}{}", motion.label(), quantities(&motion.quantities))
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
