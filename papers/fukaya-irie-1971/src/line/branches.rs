//! The branches of the line, and the events on them without duplicates.

use crate::{EPS, Error};
use std::ops::RangeInclusive;
use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, SolutionPoint};
use vibroimpact::math::{sort_by, sort_by_key};
use vibroimpact::orbit::{Cycle, FindOptions, find};
use vibroimpact::system::phase;
use vibroimpact::{Label, Oscillator, Parameter, scenario};

/// The oscillator at a gap.
pub(crate) fn at(gap: f64) -> Result<Oscillator, Error> {
    Ok(Oscillator::from_inverse_beta(scenario::T.inverse_beta, gap, EPS)?)
}

/// Range of the gap: from where the force never lifts the mass off the stop to beyond |f|.
const GAPS: RangeInclusive<f64> = -1.0..=6.0;
/// The orbits at which branches begin, and their gaps.
const BEGIN: [(u32, u32, f64); 4] = [(1, 1, 1.0), (1, 2, 2.4), (1, 3, 4.0), (1, 4, 5.0)];
/// Maximum number of impacts of an orbit; towards a complete chatter there is no limit.
const IMPACTS: u32 = 8;

fn options() -> BranchOptions {
    BranchOptions { impacts: IMPACTS, ..BranchOptions::default() }
}

/// The branch of the admissible orbit m/n at a gap, in one direction.
pub(crate) fn branch((m, n): (u32, u32), gap: f64, direction: Direction) -> Result<Vec<SolutionPoint>, Error> {
    let osc = at(gap)?;
    let orbits = find(&osc, Label::new(m, n), FindOptions::default());
    let orbit = orbits.iter().find(|o| o.physical).ok_or(Error::Unexpected("an orbit of the line is not there"))?;
    Branch::new(&osc, &orbit.cycle, Parameter::Gap, GAPS, direction, options())
        .map(to_chatter)
        .map_err(|_| Error::Unexpected("a branch of the line does not begin"))
}

/// A branch up to the complete chatter that it tends to.
fn to_chatter(branch: Branch) -> Vec<SolutionPoint> {
    let mut points: Vec<SolutionPoint> = branch.collect();
    let chatter = points.iter().position(|point| matches!(point.event, Some(BranchEvent::Sticking { .. })));
    points.truncate(chatter.map_or(points.len(), |last| last + 1));
    points
}

/// The branches of 1/1 to 1/4 in both directions, and the branches of twice the period from their flips.
pub(crate) fn all() -> Result<Vec<Vec<SolutionPoint>>, Error> {
    let mut branches = Vec::new();
    for (m, n, gap) in BEGIN {
        for direction in [Direction::Down, Direction::Up] {
            branches.push(branch((m, n), gap, direction)?);
        }
    }
    let mut flips: Vec<SolutionPoint> = Vec::new();
    for point in branches.iter().flatten().filter(|p| p.event == Some(BranchEvent::Flip)) {
        if !flips.iter().any(|known| same(known.value, point.value)) {
            flips.push(point.clone());
        }
    }
    for flip in flips {
        // twice the maximum number of impacts, so that grazing events of doubled orbits are found too
        let options = BranchOptions { impacts: 2 * IMPACTS, ..options() };
        let branch = Branch::from_flip(&at(flip.value)?, &flip, Parameter::Gap, GAPS, options)
            .map_err(|_| Error::Unexpected("a doubled branch of the line does not begin"))?;
        branches.push(to_chatter(branch));
    }
    Ok(branches)
}

/// Two events of one kind closer than this are the same event, found on two branches.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-10
}

/// The kind of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Flip,
    Fold,
    Grazing,
    LossOfContact,
}

/// An event of the line.
#[derive(Clone, Debug)]
pub(crate) struct Event {
    pub(crate) kind: Kind,
    pub(crate) gap: f64,
    /// The orbits that meet here.
    pub(crate) orbits: Vec<Guess>,
}

/// An orbit near an event.
#[derive(Clone, Debug)]
pub(crate) struct Guess {
    /// The orbit at the event.
    at: Cycle,
    /// The orbit on the branch near the event, where the gap differs by `span`.
    beside: Cycle,
    span: f64,
}

impl Guess {
    fn exactly(cycle: &Cycle) -> Self {
        Self { at: cycle.clone(), beside: cycle.clone(), span: 1.0 }
    }

    /// A guess at the distance `h` in the gap: at folds and flips an orbit changes with the square root of the
    /// distance.
    pub(crate) fn near(&self, h: f64) -> Cycle {
        let share = (h / self.span).sqrt().min(1.0);
        let mut cycle = self.at.clone();
        for (point, beside) in cycle.points.iter_mut().zip(&self.beside.points) {
            let turn = phase::difference(beside.state.phase, point.state.phase);
            point.state.phase = phase::wrap(point.state.phase + share * turn);
            point.state.velocity += share * (beside.state.velocity - point.state.velocity);
            point.interval += share * (beside.interval - point.interval);
        }
        cycle
    }

    pub(crate) fn label(&self) -> Label {
        self.at.label
    }
}

/// All events in the order of their gaps.
pub(crate) fn events(branches: &[Vec<SolutionPoint>]) -> Vec<Event> {
    let mut events: Vec<Event> = Vec::new();
    for (branch, k) in branches.iter().flat_map(|branch| (0..branch.len()).map(move |k| (branch, k))) {
        let point = &branch[k];
        let next = branch.get(k + 1);
        let (kind, orbits) = match point.event {
            Some(BranchEvent::Flip) => (Kind::Flip, vec![Guess::exactly(&point.cycle)]),
            Some(BranchEvent::LossOfContact { .. }) => (Kind::LossOfContact, vec![Guess::exactly(&point.cycle)]),
            Some(event @ BranchEvent::Grazing { .. }) => {
                // none if the orbit would have too many impacts
                let after = event.detail().and_then(|detail| detail.labels.1);
                let after = next.filter(|p| Some(p.cycle.label) == after);
                (Kind::Grazing, [Some(point), after].into_iter().flatten().map(|p| Guess::exactly(&p.cycle)).collect())
            }
            Some(BranchEvent::Fold) => {
                let sides = [k.checked_sub(1).and_then(|k| branch.get(k)), next].into_iter().flatten();
                let of = |p: &SolutionPoint| Guess {
                    at: point.cycle.clone(),
                    beside: p.cycle.clone(),
                    span: (p.value - point.value).abs(),
                };
                (Kind::Fold, sides.map(of).collect())
            }
            _ => continue,
        };
        add(&mut events, Event { kind, gap: point.value, orbits });
    }
    for branch in branches {
        // the flip at which the branch begins
        let begins = |e: &&mut Event| e.kind == Kind::Flip && same(e.gap, branch[0].value);
        let Some(event) = events.iter_mut().find(begins) else { continue };
        let mut twice = event.orbits[0].at.clone();
        twice.points.extend(event.orbits[0].at.points.clone());
        let span = |p: &SolutionPoint| (p.value - branch[0].value).abs();
        let young = branch.iter().skip(1).take_while(|p| p.event.is_none());
        let Some(beside) = young.take_while(|p| span(p) < YOUNG).last().or_else(|| branch.get(1)) else { continue };
        if event.orbits.len() == 1 && twice.points.len() == beside.cycle.points.len() {
            twice.label = beside.cycle.label;
            event.orbits.push(Guess { at: twice, beside: beside.cycle.clone(), span: span(beside) });
        }
    }
    for event in &mut events {
        if event.kind != Kind::Flip {
            sort_by_key(&mut event.orbits, |orbit| (orbit.label().periods, orbit.label().impacts));
        }
    }
    sort_by(&mut events, |a, b| a.gap.total_cmp(&b.gap));
    events
}

/// Distance from a flip up to which a doubled orbit grows with the square root of the distance.
const YOUNG: f64 = 1e-2;

/// Adds an event, or adds missing orbits to an event that is known.
fn add(events: &mut Vec<Event>, event: Event) {
    let Some(known) = events.iter_mut().find(|e| e.kind == event.kind && same(e.gap, event.gap)) else {
        events.push(event);
        return;
    };
    for orbit in event.orbits {
        if !known.orbits.iter().any(|o| o.label() == orbit.label()) {
            known.orbits.push(orbit);
        }
    }
}
