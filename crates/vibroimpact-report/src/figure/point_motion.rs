//! The motions at points, as figures need them: the label, the share, and the value of a quantity; and the legend of labels.

use crate::figure::coloured::Value;
use crate::{FieldName, Units, Varied, figure};
use std::collections::BTreeMap;
use vibroimpact::math::sort_by_key;
use vibroimpact_plot::{Entry, GROUPS, Key, Legend, legend_group, legend_text, unforced};
use vibroimpact_study::RegionMap;

/// Maximum number of labels with an entry of their own in a legend; if there are more, their groups have entries.
const NAMED: usize = 14;
/// Maximum number of labels that the entry of a group names.
const NAMED_OF_GROUP: usize = 4;
/// Motions m/T with so many closings or more have one entry among those of groups, because their colours are similar.
const MANY: u64 = 4;

/// A motion at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// The number of its label.
    pub class: usize,
    /// The share of starts that lead to it.
    pub share: f64,
    /// The value of a quantity, if the figure shows one.
    pub value: Value,
}

/// The motions at each of many points, the most frequent first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointMotions {
    /// The distinct labels.
    pub labels: Vec<String>,
    /// The motions.
    pub points: Vec<Vec<PointMotion>>,
    numbers: BTreeMap<String, usize>,
}

impl PointMotions {
    /// The number of a label, which is added if it is new.
    pub(crate) fn class(&mut self, label: &str) -> usize {
        self.numbers.get(label).copied().unwrap_or_else(|| {
            self.numbers.insert(label.to_owned(), self.labels.len());
            self.labels.push(label.to_owned());
            self.labels.len() - 1
        })
    }

    /// Adds a point with the labels, shares and values of its motions.
    pub(crate) fn push<'a>(&mut self, motions: impl Iterator<Item = (&'a str, f64, Value)>) {
        let point = motions.map(|(label, share, value)| PointMotion { class: self.class(label), share, value });
        let point = point.collect();
        self.points.push(point);
    }

    /// The labels of the first `most` motions at each point, those of one label as one motion. Without a label there is no motion.
    pub(crate) fn by_label(&self, most: usize) -> Self {
        let mut all = Self::default();
        for motions in &self.points {
            let mut point: Vec<PointMotion> = Vec::new();
            for motion in motions.iter().take(most).filter(|motion| !self.labels[motion.class].is_empty()) {
                let class = all.class(&self.labels[motion.class]);
                match point.iter_mut().find(|other| other.class == class) {
                    Some(whole) => whole.share += motion.share,
                    None => point.push(PointMotion { class, ..*motion }),
                }
            }
            all.points.push(point);
        }
        all
    }

    /// The motions of a map, with the values of a field of the plan in these units.
    pub(crate) fn of_map<V: Varied, F: FieldName>(
        found: &RegionMap<V, F>,
        field: Option<usize>,
        units: &Units,
    ) -> Self {
        let mut all = Self::default();
        for (k, motions) in found.points.iter().enumerate() {
            let there = units.at_point(&found.axes, k);
            all.push(motions.iter().map(|motion| {
                let value = |field: usize| Some(motion.quantities.get(field)? * found.fields[field].unit(&there));
                (&*motion.label, motion.share, Value::of(&motion.label, field.and_then(value)))
            }));
        }
        all
    }

    /// The numbers of the labels in the order of a legend.
    pub(crate) fn in_order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.labels.len()).collect();
        sort_by_key(&mut order, |class| rank(&self.labels[*class]));
        order
    }
}

/// The place of a label in a legend: that of its group, and its numbers of periods and impacts.
fn rank(label: &str) -> (usize, u64, u64) {
    let group = GROUPS.iter().position(|group| *group == legend_group(label)).unwrap_or(GROUPS.len());
    let (m, n) = label.split_once('/').unwrap_or((label, ""));
    (group, n.parse().unwrap_or(0), m.parse().unwrap_or(0))
}

/// The legend of labels, whose signs are those of `key`. With many labels those of a group share an entry.
pub(crate) fn legend<'a>(labels: impl Iterator<Item = &'a str>, key: impl Fn(&str) -> Key) -> Legend {
    let mut labels: Vec<&str> = labels.collect();
    sort_by_key(&mut labels, |label| rank(label));
    let mut entries: Vec<Entry> = Vec::new();
    if labels.len() <= NAMED {
        for label in labels {
            let (key, word) = (key(label), words(legend_group(label), &[label]));
            // labels of one group that have the same style, because a group has five, share an entry
            match entries.iter_mut().find(|other| other.key == key) {
                Some(other) => other.label.push_str(&format!(", {word}")),
                None => entries.push(Entry { key, label: word }),
            }
        }
        return Legend { entries, ..Legend::below() };
    }
    // motions m/T have no group
    let closings: Vec<u64> = labels.iter().filter_map(|label| unforced(label)).collect();
    let grouped: Vec<&str> = labels.into_iter().filter(|label| unforced(label).is_none()).collect();
    for group in GROUPS {
        let own: Vec<&str> = grouped.iter().copied().filter(|label| legend_group(label) == group).collect();
        if !own.is_empty() {
            entries.push(Entry { key: key(group), label: words(group, &own) });
        }
    }
    for m in (0..MANY).filter(|m| closings.contains(m)) {
        entries.push(Entry { key: key(&format!("{m}/T")), label: format!("{m}/T") });
    }
    if closings.iter().any(|m| *m >= MANY) {
        entries.push(Entry { key: key(&format!("{MANY}/T")), label: format!("*m*/T, *m* ≥ {MANY}") });
    }
    Legend { entries, ..Legend::below() }
}

/// The words of a group for these labels in it: they are named, or some of many.
fn words(group: &str, labels: &[&str]) -> String {
    if !group.contains('/') && !labels.iter().any(|label| unforced(label).is_some()) {
        return legend_text(group).to_owned();
    }
    let named: Vec<String> = labels.iter().take(NAMED_OF_GROUP).map(|label| figure::label(label)).collect();
    let more = labels.len() - named.len();
    if more == 0 { named.join(", ") } else { format!("{} and {more} more", named.join(", ")) }
}
