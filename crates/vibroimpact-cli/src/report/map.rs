//! The motions of a map as text.

use crate::report::stored::label_table;
use crate::report::words::table;
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact::verdict::Verdict;
use vibroimpact_report::json::map::{LabelCount, coexisting, counts};
use vibroimpact_report::number::percent;
use vibroimpact_study::{ImpactsByStop, RegionMap, counted};

/// The number of points, and one row for each label.
pub(crate) fn text(found: &RegionMap, two_stops: bool) -> String {
    let labels = counts(found);
    format!(
        "{}, {} each; several motions coexist at {} of them\n\n{}",
        counted(found.points.len() as u64, "point"),
        counted(found.plan.starts, "start"),
        coexisting(found),
        if two_stops { by_stop(found, &labels) } else { label_table(&labels) }
    )
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
