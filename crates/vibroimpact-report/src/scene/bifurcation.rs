//! The bifurcation diagram along a line through one or two parameters: the branches of several labels over the orbit
//! diagram from simulation.

use crate::figure::branch::figure;
use crate::table::{Table, bifurcation as bifurcation_table};
use crate::{AnswerError, Asked, ReportError};
use std::collections::BTreeMap;
use vibroimpact::Label;
use vibroimpact::continuation::BranchEvent as E;
use vibroimpact::math::{sort_by, sort_by_key};
use vibroimpact::verdict::{Count, SettleOptions, Verdict, attractors};
use vibroimpact_plot::Figure;
use vibroimpact_study::diagram::Diagram;
use vibroimpact_study::{
    BranchPlan, Control, DiagramPlan, Followed, Plan, Results, RunError, Span, Stopped, Target, run, tiles,
};

/// Number of values along the line at which motions are searched, if no labels are given.
pub(super) const SAMPLES: u32 = 24;
/// Number of motions whose branches are followed then: those of most starts.
pub(super) const MOST_LABELS: usize = 6;
/// Number of values at which orbits of a label are searched.
pub(super) const LOOKS: u32 = 25;
/// Maximum number of further branches from each orbit.
pub(super) const FOLLOW: u32 = 3;
/// Maximum number of points of each branch.
pub(super) const POINTS: u32 = 3_000;
/// Number of starts at each value, to find the labels that occur.
pub(super) const STARTS: u64 = 4;
/// Seed of the sequence of starts.
pub(super) const SEED: u64 = 1;
/// A value belongs to a branch if it is closer to it than this fraction of the range.
pub(super) const NEAR: f64 = 1e-9;

/// An event on an admissible branch.
#[derive(Clone, Debug, PartialEq)]
pub struct BifurcationEvent {
    /// The label of the cycle at the event.
    pub label: String,
    /// The name of the event: fold, flip, grazing and so on.
    pub kind: &'static str,
    /// The value of the parameter that varies.
    pub value: f64,
}

/// The bifurcation diagram along a line.
#[derive(Clone, Debug)]
pub struct BifurcationDiagram {
    /// The orbit diagram behind the branches.
    pub behind: Diagram,
    /// The branches.
    pub followed: Vec<Followed>,
    asked: Asked,
}

impl BifurcationDiagram {
    /// Its figure: stable orbits are solid and unstable ones dashed.
    ///
    /// # Errors
    /// [`AnswerError`] if a value of the parameter overflows in the units of the results.
    pub fn figure(&self) -> Result<Figure, AnswerError> {
        Ok(figure(&self.followed, &self.behind.plan.cut(), Some(&self.behind), false, &self.asked)?)
    }

    /// Its table: the points from simulation, then those of the branches.
    ///
    /// # Errors
    /// As [`Self::figure`].
    pub fn table(&self) -> Result<Table<'static>, AnswerError> {
        Ok(bifurcation_table::table(&self.behind, &self.followed, &self.asked).map_err(ReportError::from)?)
    }

    /// The events on the branches, in the order of their values.
    #[must_use]
    pub fn events(&self) -> Vec<BifurcationEvent> {
        events(&self.followed, self.behind.plan.over.ends())
    }
}

/// The branches of some labels over the orbit diagram of a plan, between the ends of its values. The plan also determines whether impact velocities or
/// positions at phase 0 are shown. Without labels they are those of the motions on the line with most starts. Each orbit found on a grid of
/// values is followed in both directions to the ends of the range, through its events. Of the branches that begin at
/// flips and branch points, those that reach one of the labels are drawn too.
///
/// Orbits to which neither a value of the grid nor such an event leads are missed.
///
/// # Errors
/// [`AnswerError`] for an invalid plan or label, or when stopped.
pub fn bifurcation(
    asked: &Asked,
    plan: &DiagramPlan,
    named: Option<&[String]>,
    control: &Control<'_>,
) -> Result<BifurcationDiagram, AnswerError> {
    let found;
    let labels = match named {
        Some(labels) => labels,
        None => {
            found = labels(asked, plan, SAMPLES, control)?;
            &found[..found.len().min(MOST_LABELS)]
        }
    };
    let Results::Diagram(behind) = run(&Plan::new(asked.system, plan.clone()), control)? else {
        // the task of this plan has no other result
        return Err(ReportError::NoLabels.into());
    };
    let mut followed = Vec::new();
    for label in labels {
        follow(asked, plan, label, &mut followed, control)?;
    }
    let known = |branch: &Followed| branch.points.iter().any(|point| labels.contains(&point.cycle.label.to_string()));
    followed.retain(known);
    Ok(BifurcationDiagram { behind, followed, asked: *asked })
}

/// The events on branches, each once.
fn events(followed: &[Followed], (from, to): (f64, f64)) -> Vec<BifurcationEvent> {
    let points = followed.iter().flat_map(|branch| &branch.points).filter(|point| point.physical);
    let events = points.filter_map(|point| {
        // where the search for a branch ends nothing happens to the motion
        let event = point.event.filter(|event| {
            !matches!(event, E::Closed | E::EndOfRange | E::StepLimit | E::ImpactLimit | E::NoConvergence)
        })?;
        Some(BifurcationEvent { label: point.cycle.label.to_string(), kind: event.name(), value: point.value })
    });
    distinct(events, NEAR * (to - from).abs())
}

/// Events in the order of their values, those that are nearer to each other than `near` once.
pub(super) fn distinct(all: impl Iterator<Item = BifurcationEvent>, near: f64) -> Vec<BifurcationEvent> {
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

/// Adds the branches of a label, unless an existing branch passes through its orbit.
fn follow(
    asked: &Asked,
    plan: &DiagramPlan,
    label: &str,
    followed: &mut Vec<Followed>,
    control: &Control<'_>,
) -> Result<(), AnswerError> {
    let name: Label = label.parse().map_err(vibroimpact_study::PlanError::from)?;
    let (from, to) = plan.over.ends();
    let looks = if from == to { return Ok(()) } else { Span::new(from, to, LOOKS)? };
    for (k, value) in (0_u64..).zip(looks.values()) {
        if control.stopping() {
            return Err(Stopped { done: k, total: u64::from(LOOKS) }.into());
        }
        if followed.iter().any(|branch| passes(branch, name, value, NEAR * (to - from).abs())) {
            continue;
        }
        let cut = plan.cut();
        let system = cut.system(&asked.system, value)?;
        for end in [from, to].into_iter().filter(|end| *end != value) {
            let also = cut.also.zip(cut.values(end).nth(1)).map(|(also, to)| Target { parameter: also.parameter, to });
            let label = Some(label.to_owned());
            let task = BranchPlan { label, vary: cut.vary, to: end, also, orbit: None, follow: FOLLOW, points: POINTS };
            match run(&Plan::new(system, task), control) {
                Ok(Results::Branch(found)) => followed.extend(found.followed),
                Ok(_) => {}
                Err(RunError::Stopped(stopped)) => return Err(stopped.into()),
                // an absent orbit is no error: the label exists only on a part of the line
                Err(RunError::Plan(_)) => {}
            }
        }
    }
    Ok(())
}

/// Whether a branch has a cycle with this label at a value.
fn passes(branch: &Followed, label: Label, value: f64, near: f64) -> bool {
    let points = branch.points.windows(2);
    points.filter(|pair| pair[0].cycle.label == label && pair[1].cycle.label == label).any(|pair| {
        let (a, b) = (pair[0].value, pair[1].value);
        a.min(b) - near <= value && value <= a.max(b) + near
    })
}

/// The labels of the cycles along the line of a diagram, those of most starts first. At `count` values a few starts are
/// settled.
///
/// # Errors
/// [`AnswerError`] for an invalid plan, or when stopped.
pub fn labels(
    asked: &Asked,
    plan: &DiagramPlan,
    count: u32,
    control: &Control<'_>,
) -> Result<Vec<String>, AnswerError> {
    plan.check(&asked.system)?;
    let (from, to) = plan.over.ends();
    let over = Span::new(from, to, if from == to { 1 } else { count.max(2) })?;
    let options = SettleOptions::default();
    let found = tiles(u64::from(over.count()), 1, control, |range, tick| {
        let mut found = Vec::new();
        for value in range.filter_map(|k| u32::try_from(k).ok()).map(|k| over.at(k)) {
            let osc = plan.cut().oscillator(&asked.system, value);
            found.push(osc.map(|osc| attractors(&osc, STARTS, SEED, &options)));
            if tick() {
                break;
            }
        }
        found
    })?;
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    for census in found.into_iter().flatten() {
        for motion in census?.motions() {
            // motions without impacts, or with infinitely many, have no branch of impacts
            if let Verdict::Periodic(cycle) = &motion.verdict
                && matches!(cycle.label.impacts, Count::Finite(1..))
            {
                *counts.entry(cycle.label.to_string()).or_default() += motion.count;
            }
        }
    }
    Ok(most_first(counts))
}

/// Labels with their numbers of starts: those of most starts first.
pub(super) fn most_first(counts: BTreeMap<String, u64>) -> Vec<String> {
    let mut list: Vec<(String, u64)> = counts.into_iter().collect();
    sort_by_key(&mut list, |(_, count)| core::cmp::Reverse(*count));
    list.into_iter().map(|(label, _)| label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use vibroimpact_plot::{Dash, Mark};
    use vibroimpact_study::diagram::{DiagramPoint, Show};
    use vibroimpact_study::{Parameter, Stretch, SystemPlan};

    #[test]
    fn f10b_the_branches_of_the_labels_on_a_line() {
        let system = SystemPlan { inverse_beta: Some(1.11), gap: 1.5, restitution: 0.5, ..SystemPlan::default() };
        let (asked, control) = (Asked { system, units: Units::default() }, Control::default());
        let task = r#"{"vary":"gap","over":"1.5:2.2:15","transient":100,"keep":8}"#;
        let plan: DiagramPlan = serde_json::from_str(task).unwrap();
        assert_eq!(plan.vary, Parameter::Gap);
        let found = labels(&asked, &plan, 8, &control).unwrap();
        assert!(found.iter().any(|label| label == "1/1"), "{found:?}");
        let diagram = bifurcation(&asked, &plan, Some(&["1/1".into(), "2/2".into()]), &control).unwrap();
        let svg = diagram.figure().unwrap().to_svg();
        // the closed form of the flip: docs/orbits.md
        let flips: Vec<f64> = (diagram.events().iter().filter(|event| event.kind == "flip" && event.label == "1/1"))
            .map(|event| event.value)
            .collect();
        assert!(flips.len() == 1 && (flips[0] - 1.829).abs() < 1e-3, "{flips:?}");
        assert!(diagram.events().is_sorted_by(|a, b| a.value <= b.value));
        // the table has the simulated points and the branches, with the flip in a row of its own
        let mut table = Vec::new();
        diagram.table().unwrap().write(&mut table).unwrap();
        let table = String::from_utf8(table).unwrap();
        assert!(table.starts_with("gap,sweep,kind,stop,phase,speed,label,event\n"), "{}", &table[..80]);
        let simulated = table.lines().filter(|row| row.ends_with(",,")).count();
        let stable = table.lines().filter(|row| row.contains(",stable,upper,") && row.ends_with(",1/1,")).count();
        let flip = table.lines().find(|row| row.ends_with(",1/1,flip")).unwrap();
        assert!(simulated >= 15 && stable > 3, "{simulated} {stable}");
        assert!((flip.split(',').next().unwrap().parse::<f64>().unwrap() - flips[0]).abs() < 1e-12, "{flip}");
        // 1/1 is stable up to its flip at 1.829, where 2/2 begins, which ends as 1/2
        for word in ["1/1", "2/2", "1/2", ">stable<", ">unstable<", ">flip<", ">simulation<"] {
            assert!(svg.contains(word), "{word}");
        }
        // along a line through two parameters, 1/1 flips where the line crosses its curve of flips
        let also = Stretch { parameter: Parameter::InverseBeta, from: 1.05, to: 1.12 };
        let line = DiagramPlan { also: Some(also), ..plan.clone() };
        let found = labels(&asked, &line, 8, &control).unwrap();
        assert!(found.iter().any(|label| label == "1/1"), "{found:?}");
        let svg = bifurcation(&asked, &line, Some(&found), &control).unwrap().figure().unwrap().to_svg();
        for word in [">flip<", "with", "1.05 to 1.12"] {
            assert!(svg.contains(word), "{word}");
        }
        // positions once in a period, if requested: 1/1 has one, which lies between the stop and the lowest position
        let strobes = DiagramPlan { show: Show::Strobe, ..plan.clone() };
        let figure = bifurcation(&asked, &strobes, Some(&["1/1".into()]), &control).unwrap().figure().unwrap();
        let svg = figure.to_svg();
        assert!(svg.contains("at phase 0") && !svg.contains("arrival velocity"), "{svg}");
        // the ordinates of the stable part, which simulation finds too
        let ordinates = |figure: &Figure| -> Vec<f64> {
            let lines = figure.panels[0].marks.iter().filter_map(|mark| match mark {
                Mark::Line(line) if line.stroke.dash == Dash::Solid => Some(line),
                _ => None,
            });
            lines.flat_map(|line| line.ys.clone()).filter(|y| !y.is_nan()).collect()
        };
        let behind = Plan::new(asked.system, strobes.clone());
        let Results::Diagram(behind) = run(&behind, &control).unwrap() else { panic!("another result") };
        let positions: Vec<f64> = behind
            .steps
            .iter()
            .flat_map(|step| &step.points)
            .filter_map(|point| match point {
                DiagramPoint::State { x, .. } => Some(*x),
                _ => None,
            })
            .collect();
        let drawn = ordinates(&figure);
        let near = |x: &f64| positions.iter().any(|y| (x - y).abs() < 0.2);
        assert!(drawn.len() > 3 && drawn.iter().all(near), "{drawn:?}");
        let bad = bifurcation(&asked, &plan, Some(&["1/0".into()]), &control);
        assert!(matches!(bad, Err(AnswerError::Plan(_))), "{bad:?}");
    }
}
