//! The motions of a map as text.

use crate::report::stored::label_table;
use crate::report::words::table;
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact::verdict::Verdict;
use vibroimpact_report::json::map::{LabelCount, coexisting, counts, counts_of_machine};
use vibroimpact_report::number::percent;
use vibroimpact_study::{ImpactsByStop, MachineMap, RegionMap, counted};

/// The number of points, and one row for each label.
pub(crate) fn text(found: &RegionMap, two_stops: bool) -> String {
    let labels = counts(found);
    let table = if two_stops { by_stop(found, &labels) } else { label_table(&labels) };
    head(found.points.len(), found.plan.starts, coexisting(found)) + &table
}

/// The same of a machine, with as many starts at each point.
pub(crate) fn of_machine(found: &MachineMap, starts: u64) -> String {
    let several = found.cells.iter().filter(|cell| cell.len() > 1).count();
    let mut text = head(found.cells.len(), starts, several) + &label_table(&counts_of_machine(found));
    let refused = found.cells.iter().filter(|cell| cell.is_empty()).count();
    if refused > 0 {
        text.push_str(&format!("  {} refused\n", counted(refused as u64, "point")));
    }
    if let Some(events) = found.seen_events() {
        text.push_str(&format!("  chaos was seen over at least {}\n", counted(events, "event")));
    }
    text
}

fn head(points: usize, starts: u64, several: usize) -> String {
    let (points, starts) = (counted(points as u64, "point"), counted(starts, "start"));
    format!("{points}, {starts} each; several motions coexist at {several} of them\n\n")
}

/// The table of labels with the impacts of their motions on each stop.
fn by_stop(found: &RegionMap, labels: &[LabelCount]) -> String {
    let mut seen: BTreeMap<String, BTreeSet<ImpactsByStop>> = BTreeMap::new();
    for motion in found.points.iter().flat_map(|point| &point.motions) {
        if let Verdict::Periodic(cycle) = &motion.verdict {
            seen.entry(motion.verdict.label().into_owned()).or_default().insert(ImpactsByStop::of_cycle(cycle));
        }
    }
    let told = |label: &str| {
        let all = seen.get(label).into_iter().flatten().map(|by| format!("({by})"));
        all.collect::<Vec<_>>().join(" or ")
    };
    let heads = ["<label", "points", "share of starts", "<impacts"].map(str::to_owned);
    let row = |of: &LabelCount| vec![of.label.clone(), of.points.to_string(), percent(of.share), told(&of.label)];
    table(&heads, &labels.iter().map(row).collect::<Vec<_>>())
}
