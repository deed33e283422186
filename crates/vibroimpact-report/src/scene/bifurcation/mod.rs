//! The bifurcation diagram along a line through one or two numbers that vary: the branches of several labels over the orbit diagram
//! from simulation.

mod machine;
mod oscillator;

pub use machine::machine_bifurcation;
pub(crate) use oscillator::strobes;
pub use oscillator::{bifurcation, labels};

use crate::figure::branch::{Picture, figure};
use crate::figure::tracks::Shown;
use crate::json::branch::{BranchEventObject, BranchObject, EventOf};
use crate::table::Table;
use crate::task::diagram;
use crate::{AnswerError, ReportError, ShownValue, Told, Units};
use std::collections::BTreeMap;
use vibroimpact::math::{sort_by, sort_by_key};
use vibroimpact_plot::Figure;
use vibroimpact_study::diagram::{Diagram, Shown as _};
use vibroimpact_study::{Control, Name, PointOf, Span, tiles};

/// Number of values along the line at which motions are searched, if no labels are given.
const SAMPLES: u32 = 24;
/// Number of motions whose branches are followed then: those of most starts.
const MOST_LABELS: usize = 6;
/// Number of values at which orbits of a label are searched.
const LOOKS: u32 = 25;
/// Maximum number of further branches from each orbit.
const FOLLOW: u32 = 3;
/// Maximum number of points of each branch.
const POINTS: u32 = 3_000;
/// Number of starts at each value, to find the labels that occur.
const STARTS: u64 = 4;
/// Seed of the sequence of starts.
const SEED: u64 = 1;
/// A value belongs to a branch if it is closer to it than this fraction of the range.
const NEAR: f64 = 1e-9;

/// An event on an admissible branch.
#[derive(Clone, Debug, PartialEq)]
pub struct BifurcationEvent {
    /// The label of the cycle at the event.
    pub label: String,
    /// The name of the event: fold, flip, grazing and so on.
    pub kind: &'static str,
    /// The value of what varies, as in the plan.
    pub value: f64,
}

/// The bifurcation diagram along a line.
#[derive(Clone, Debug)]
pub struct BifurcationDiagram<D: Told> {
    /// The orbit diagram behind the branches.
    pub behind: Diagram<D::Name, D::Shown>,
    /// The points of each branch, in order.
    pub branches: Vec<Vec<PointOf<D>>>,
    /// The name under which a machine was asked for, and the system as it is written.
    pub(crate) name: String,
    pub(crate) written: D,
    pub(crate) system: D::System,
    pub(crate) units: Units,
}

impl<D: Told> BifurcationDiagram<D> {
    /// Its figure: stable orbits are solid and unstable ones dashed.
    ///
    /// # Errors
    /// [`AnswerError`] if a value of what varies overflows in the units of the results.
    pub fn figure(&self) -> Result<Figure, AnswerError> {
        let (show, cut, units) = (&self.behind.plan.show, &self.behind.plan.cut(), &self.units);
        let picture = Picture {
            cut,
            units,
            shown: shown(show),
            ordinate: show.ordinate(units),
            behind: Some(&self.behind),
            inadmissible: false,
        };
        let varied: Vec<&str> = cut.names().map(Name::text).collect();
        Ok(figure(&self.objects(), &picture, self.written.title(&self.name, units, &varied))?)
    }

    /// Its table: the points from simulation, then those of the branches.
    ///
    /// # Errors
    /// As [`Self::figure`].
    pub fn table(&self) -> Result<Table<'static>, AnswerError> {
        let shown = shown(&self.behind.plan.show);
        let table = diagram::with_branches((&self.behind, &self.units), &self.system, &self.objects(), shown);
        Ok(table.map_err(ReportError::from)?)
    }

    /// The events on the branches, in the order of their values.
    #[must_use]
    pub fn events(&self) -> Vec<BifurcationEvent> {
        let branches = self.objects();
        let all = branches.iter().flat_map(|branch| branch.events.iter().map(move |event| (branch, event)));
        let happens = |(branch, event): &(&BranchObject<'_>, &BranchEventObject<'_>)| {
            branch.points[event.point].admissible && !event.event.ends_search()
        };
        let events = all.filter(happens).map(|(branch, event)| BifurcationEvent {
            label: branch.points[event.point].label.clone(),
            kind: event.kind,
            value: if let EventOf::Oscillator(point) = event.of { point.value } else { event.parameter },
        });
        let (from, to) = self.behind.plan.over.ends();
        distinct(events, NEAR * (to - from).abs())
    }

    fn objects(&self) -> Vec<BranchObject<'_>> {
        let (cut, along) = (self.behind.plan.cut(), (&self.written, &self.system, &self.units));
        let show = Some(&self.behind.plan.show).filter(|show| !show.is_closings());
        self.branches.iter().map(|points| BranchObject::new::<D>(along, (points, None), &cut, show)).collect()
    }
}

/// What is shown of each cycle where a diagram shows this.
fn shown(show: &impl ShownValue) -> Shown {
    match (show.is_closings(), show.is_states()) {
        (true, _) => Shown::Speeds,
        (_, true) => Shown::Strobes,
        _ => Shown::Quantity,
    }
}

/// Events in the order of their values, those that are nearer to each other than `near` once.
fn distinct(all: impl Iterator<Item = BifurcationEvent>, near: f64) -> Vec<BifurcationEvent> {
    let mut events: Vec<BifurcationEvent> = Vec::new();
    for event in all {
        let same = |other: &BifurcationEvent| {
            other.kind == event.kind && other.label == event.label && (other.value - event.value).abs() <= near
        };
        if !events.iter().any(same) {
            events.push(event);
        }
    }
    sort_by(&mut events, |a, b| a.value.total_cmp(&b.value));
    events
}

/// `count` values between two ends, each with what is found there.
fn along<T: Send>(
    (from, to): (f64, f64),
    count: u32,
    control: &Control<'_>,
    find: impl Fn(f64) -> T + Sync,
) -> Result<Vec<(f64, T)>, AnswerError> {
    let over = Span::new(from, to, if from == to { 1 } else { count.max(2) })?;
    let found = tiles(u64::from(over.count()), 1, control, |range, tick| {
        let mut found = Vec::new();
        for value in range.filter_map(|k| u32::try_from(k).ok()).map(|k| over.at(k)) {
            found.push((value, find(value)));
            if tick() {
                break;
            }
        }
        found
    })?;
    Ok(found.into_iter().flatten().collect())
}

/// Labels with numbers of starts: those of most starts first.
fn most_first(all: impl Iterator<Item = (String, u64)>) -> Vec<String> {
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    for (label, count) in all {
        *counts.entry(label).or_default() += count;
    }
    let mut list: Vec<(String, u64)> = counts.into_iter().collect();
    sort_by_key(&mut list, |(_, count)| core::cmp::Reverse(*count));
    list.into_iter().map(|(label, _)| label).collect()
}
