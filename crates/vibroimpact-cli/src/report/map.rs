//! The motions of a map as text.

use crate::report::stored::label_table;
use crate::report::words::table;
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact_report::json::map::{LabelCount, counts};
use vibroimpact_report::number::percent;
use vibroimpact_study::{ImpactsByStop, RegionMap, counted};

/// The number of points with so many starts each, and one row for each label; with the impacts on each of two stops.
pub(crate) fn text<V, F>(found: &RegionMap<V, F>, starts: u64, two_stops: bool) -> String {
    let labels = counts(found);
    let table = if two_stops { by_stop(found, &labels) } else { label_table(&labels) };
    let text = head(found.points.len(), starts, found.coexisting()) + &table;
    match found.points.iter().filter(|motions| motions.is_empty()).count() {
        0 => text,
        refused => text + &format!("  {} refused\n", counted(refused as u64, "point")),
    }
}

/// The number of events over which chaos was seen.
pub(crate) fn seen<V, F>(found: &RegionMap<V, F>) -> String {
    let text = |events| format!("  chaos was seen over at least {}\n", counted(events, "event"));
    found.seen_events().map_or_else(String::new, text)
}

fn head(points: usize, starts: u64, several: usize) -> String {
    let (points, starts) = (counted(points as u64, "point"), counted(starts, "start"));
    format!("{points}, {starts} each; several motions coexist at {several} of them\n\n")
}

/// The table of labels with the impacts of their motions on each stop.
fn by_stop<V, F>(found: &RegionMap<V, F>, labels: &[LabelCount]) -> String {
    let mut seen: BTreeMap<String, BTreeSet<ImpactsByStop>> = BTreeMap::new();
    for motion in found.motions() {
        if let Some(by_stop) = motion.by_stop {
            seen.entry(motion.label.clone().into_owned()).or_default().insert(by_stop);
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
