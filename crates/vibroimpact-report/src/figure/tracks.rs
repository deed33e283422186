//! The impacts of a branch, or its states at phase 0, as curves. Each impact is followed from point to point, and a
//! curve changes its look where the stability changes. Branches of oscillators and of machines have the same points here.

use crate::json::branch::{BranchObject, PointObject};
use crate::json::event::closings;
use crate::number::Number;
use std::collections::BTreeMap;
use vibroimpact::continuation::BranchEvent;
use vibroimpact::system::phase;

/// The look of a part of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Look {
    Stable,
    Neutral,
    Unstable,
    /// An inadmissible solution.
    Virtual,
}

impl Look {
    fn of(point: &PointObject<'_>) -> Self {
        match point.stability {
            _ if !point.admissible => Self::Virtual,
            "stable" => Self::Stable,
            "neutral" => Self::Neutral,
            _ => Self::Unstable,
        }
    }
}

/// The curves with each label and look: abscissae and ordinates, separated by `NaN`.
pub(crate) type Curves = BTreeMap<(String, Look), (Vec<f64>, Vec<f64>)>;

/// A point of a branch, as a figure needs it.
pub(crate) struct TrackPoint {
    /// The value of what varies.
    pub(crate) value: f64,
    pub(crate) label: String,
    pub(crate) look: Look,
    /// The name of the event at this point.
    pub(crate) event: Option<&'static str>,
    /// Whether the branch was followed both ways from here.
    pub(crate) start: bool,
    /// Two numbers that identify each impact or state; the second one is the ordinate.
    list: Vec<(f64, f64)>,
    /// Identifies the impacts or states across points.
    places: Vec<(usize, usize)>,
    /// Whether the list may begin with another impact or state at the next point.
    turns: bool,
    /// Whether other impacts with the same label may follow.
    changes: bool,
}

/// A branch, as a figure needs it.
pub(crate) struct Track {
    pub(crate) points: Vec<TrackPoint>,
    /// Whether its ordinates are positions, and not speeds.
    pub(crate) positions: bool,
}

/// Whether a cycle that sticks may have other closings with the same label beyond an event.
const fn changes_closings(event: BranchEvent) -> bool {
    matches!(
        event,
        BranchEvent::Grazing { .. }
            | BranchEvent::SoftLanding { .. }
            | BranchEvent::Sticking { .. }
            | BranchEvent::Corner { .. }
            | BranchEvent::Change { .. }
    )
}

impl TrackPoint {
    /// The ordinates of all impacts or states.
    pub(crate) fn ordinates(&self) -> Vec<f64> {
        self.list.iter().map(|(_, ordinate)| *ordinate).collect()
    }

    /// Point number `k` of a branch.
    fn of(branch: &BranchObject<'_>, k: usize, what: Shown) -> Self {
        let (point, event) = (&branch.points[k], branch.event_at(k));
        let (list, places) = what.list(point);
        let sticks = point.cycle.iter().any(|event| event.kind == "stick");
        let changes = event.is_some_and(|event| changes_closings(event.event));
        Self {
            value: point.parameter,
            label: point.label.clone(),
            look: Look::of(point),
            event: event.map(|event| event.kind),
            start: branch.start == Some(k),
            list,
            places,
            turns: what != Shown::Speeds || !sticks,
            changes: changes && sticks && what != Shown::Quantity,
        }
    }
}

impl Track {
    /// The sides of a branch on the way from its start, and what is shown of its cycles.
    pub(crate) fn of(branch: &BranchObject<'_>, what: Shown) -> Vec<Self> {
        let points = |side: Vec<usize>| side.into_iter().map(|k| TrackPoint::of(branch, k, what)).collect();
        let track = |side| Self { points: points(side), positions: what != Shown::Speeds };
        branch.sides().into_iter().map(track).collect()
    }

    /// The square of the distance between two impacts or states.
    fn apart(&self, a: &(f64, f64), b: &(f64, f64)) -> f64 {
        let first = if self.positions { a.0 - b.0 } else { phase::difference(a.0, b.0) };
        first.powi(2) + (a.1 - b.1).powi(2)
    }

    /// The ordinates of all impacts or states over the parameter.
    pub(crate) fn curves(&self) -> Curves {
        let mut curves = Curves::new();
        let mut rest = self.points.as_slice();
        while let Some(first) = rest.first() {
            let other = rest.iter().position(|point| point.label != first.label).unwrap_or(rest.len());
            let end = rest.iter().position(|point| point.changes).map_or(other, |k| other.min(k + 1));
            let (run, others) = rest.split_at(end);
            for ordinates in self.ordinates(run) {
                add(&mut curves, &first.label, run, &ordinates);
            }
            rest = others;
        }
        curves
    }

    /// The ordinate of each impact or state at all points of a run; `NaN` where it is not listed.
    fn ordinates(&self, run: &[TrackPoint]) -> Vec<Vec<f64>> {
        let mut tracks: BTreeMap<(usize, usize), Vec<f64>> = BTreeMap::new();
        let mut before: Option<Vec<(f64, f64)>> = None;
        for (n, point) in run.iter().enumerate() {
            let mut here = point.list.clone();
            if point.turns {
                // the list begins with the fastest impact, which may change from point to point; choose the closest shift
                let off = |shift: &usize| -> f64 {
                    let before = before.iter().flatten();
                    before.zip(here.iter().cycle().skip(*shift)).map(|(a, b)| self.apart(a, b)).sum()
                };
                let shift = (0..here.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
                here.rotate_left(shift);
            }
            for (place, one) in point.places.iter().zip(&here) {
                tracks.entry(*place).or_insert_with(|| vec![f64::NAN; run.len()])[n] = one.1;
            }
            if !here.is_empty() {
                before = Some(here);
            }
        }
        tracks.into_values().collect()
    }
}

/// What is shown of the cycles of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shown {
    /// The speed of each closing.
    Speeds,
    /// The position at phase 0 of the force in each of its periods, of an oscillator.
    Strobes,
    /// The quantity of a machine.
    Quantity,
}

/// Two numbers that identify each closing, state or value of a point, the second of which is the ordinate, and what identifies it
/// across points.
type Listed = (Vec<(f64, f64)>, Vec<(usize, usize)>);

impl Shown {
    fn list(self, point: &PointObject<'_>) -> Listed {
        let list = match self {
            Self::Speeds => return speeds(point),
            Self::Strobes => point.strobes.clone(),
            Self::Quantity => vec![(0.0, point.quantity())],
        };
        let places = (0..list.len()).map(|k| (0, k)).collect();
        (list, places)
    }

    /// The cells of each closing, state or value in a table.
    pub(crate) fn cells(self, point: &PointObject<'_>) -> Vec<String> {
        match self {
            Self::Speeds => closings(&point.cycle)
                .map(|at| format!("{},{},{}", at.stop, Number(at.phase.unwrap_or(0.0)), Number(at.speed)))
                .collect(),
            Self::Strobes => point.strobes.iter().map(|(v, x)| format!("{},{}", Number(*x), Number(*v))).collect(),
            Self::Quantity => vec![Number(point.quantity()).to_string()],
        }
    }
}

/// The phase and the speed of each closing, and the number of times that the motion sticks before it, and of closings since then: the
/// number of listed impacts of a chatter varies from point to point. The list begins after the motion sticks on the first of the stops.
fn speeds(point: &PointObject<'_>) -> Listed {
    let sticks = point.cycle.iter().enumerate().filter(|(_, event)| event.kind == "stick");
    let begin = sticks.min_by_key(|(_, event)| event.stop).map_or(0, |(k, _)| k + 1);
    let (before, after) = point.cycle.split_at(begin);
    let mut place = (0, 0);
    let (mut list, mut places) = (Vec::new(), Vec::new());
    for event in after.iter().chain(before) {
        match event.kind {
            "impact" | "close" => {
                list.push((event.phase.unwrap_or(0.0), event.speed));
                places.push(place);
                place.1 += 1;
            }
            "stick" => place = (place.0 + 1, 0),
            _ => {}
        }
    }
    (list, places)
}

/// Divides a track where its look changes. Consecutive parts share a point.
fn add(curves: &mut Curves, label: &str, run: &[TrackPoint], track: &[f64]) {
    let mut last = None;
    for (k, pair) in run.windows(2).enumerate() {
        let look = between(&pair[0], &pair[1]);
        let (xs, ys) = curves.entry((label.to_owned(), look)).or_default();
        if last != Some(look) {
            xs.extend([f64::NAN, pair[0].value]);
            ys.extend([f64::NAN, track[k]]);
        }
        xs.push(pair[1].value);
        ys.push(track[k + 1]);
        last = Some(look);
    }
}

/// The look of the part between two points. If one of them is an event, the other one decides.
fn between(a: &TrackPoint, b: &TrackPoint) -> Look {
    if b.event.is_some() && a.event.is_none() { a.look } else { b.look }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use crate::json::branch::Along;
    use vibroimpact::continuation::{Branch, BranchOptions, Direction, SolutionPoint};
    use vibroimpact::orbit::{FindOptions, find};
    use vibroimpact::{Label, Oscillator, Parameter};
    use vibroimpact_study::{Cut, SecondStop, SystemPlan};

    /// The branch of an oscillator with these points.
    fn with_points<'a>(points: &'a [SolutionPoint], vary: Parameter, along: Along<'a, SystemPlan>) -> BranchObject<'a> {
        let cut = Cut { vary: vary.into(), ends: (0.0, 1.0), also: None };
        BranchObject::new::<SystemPlan>(along, (points, None), &cut, None)
    }

    /// A cycle that sticks on both stops: the impacts of each chatter are identified even if the number of impacts
    /// listed before them changes.
    #[test]
    fn the_impacts_of_a_chatter_stay_apart() {
        use vibroimpact::Side;
        let osc = Oscillator::from_inverse_beta(2.5, 0.25, 0.5).unwrap().with_second_stop(0.25, 0.5).unwrap();
        let cycle = vibroimpact::orbit::from_release(&osc, Side::Upper, 4000).unwrap();
        let (range, options) = (0.0..=2.0, BranchOptions::default());
        let branch = Branch::new(&osc, &cycle, Parameter::SecondGap, range, Direction::Up, options).unwrap();
        let points: Vec<SolutionPoint> = branch.collect();
        let second_stop = Some(SecondStop { gap: 0.25, restitution: 0.5 });
        let system =
            SystemPlan { inverse_beta: Some(2.5), gap: 0.25, restitution: 0.5, second_stop, ..SystemPlan::default() };
        let units = Units::default();
        let branch = with_points(&points, Parameter::SecondGap, (&system, &osc, &units));
        let [one, two] = [branch.points.first(), branch.points.last()].map(|point| speeds(point.unwrap()).1);
        assert!(one.len() != two.len() && one.iter().filter(|place| place.1 == 0).count() == 2, "{one:?}");
        let curves = Track::of(&branch, Shown::Speeds)[0].curves();
        let (_, ys) = &curves[&("inf/1".to_owned(), Look::Stable)];
        let steps: Vec<f64> = ys.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|s| !s.is_nan()).collect();
        assert!(steps.len() > 500 && steps.iter().all(|step| *step < 0.05), "{:?}", steps.len());
    }

    /// The faster impact of 2/1 becomes the slower one along the branch: the curves cross and do not jump.
    #[test]
    fn curves_are_continuous_and_change_their_look_at_a_flip() {
        for (inverse, gap, to, label) in [(1.11, 1.5, 2.5, (1, 1)), (1.3, 0.75, 1.2, (2, 1))] {
            let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
            let orbits = find(&osc, Label::new(label.0, label.1), FindOptions::default());
            let orbit = orbits.into_iter().rev().find(|o| o.physical).unwrap();
            let (range, options) = (gap..=to, BranchOptions::default());
            let branch = Branch::new(&osc, &orbit.cycle, Parameter::Gap, range, Direction::Up, options).unwrap();
            let points: Vec<SolutionPoint> = branch.collect();
            let (system, units) = (SystemPlan::from_inverse_beta(inverse, gap, 0.5), Units::default());
            let curves =
                Track::of(&with_points(&points, Parameter::Gap, (&system, &osc, &units)), Shown::Speeds)[0].curves();
            for (xs, ys) in curves.values() {
                for pair in xs.iter().zip(ys).collect::<Vec<_>>().windows(2) {
                    let step = (pair[1].1 - pair[0].1).abs();
                    assert!(step.is_nan() || step < 0.1, "{step} at {}", pair[0].0);
                }
            }
            if label == (1, 1) {
                let looks: Vec<Look> = curves.keys().map(|(_, look)| *look).collect();
                assert_eq!(looks, [Look::Stable, Look::Unstable]);
                let end = curves[&("1/1".to_owned(), Look::Stable)].0.last().copied().unwrap();
                assert!((end - 1.829_006).abs() < 1e-5);
            }
        }
    }
}
