//! Branches along lines through two parameters: each event is one of the branch in either of them that crosses the line there.

use vibroimpact::continuation::{Branch, BranchError, BranchOptions, Direction, SolutionPoint};
use vibroimpact::orbit::{Cycle, FindOptions, find, refine};
use vibroimpact::{Label, Oscillator, Parameter, ParameterPath};

/// The branch of the fastest motion called `label` along a line through `osc`, as far as `to`.
fn branch(osc: &Oscillator, label: Label, line: &ParameterPath, to: f64) -> Vec<SolutionPoint> {
    let orbits = find(osc, label, FindOptions::default());
    let orbit = orbits.iter().rfind(|orbit| orbit.physical).unwrap();
    let from = line.get(osc).unwrap();
    let (range, way) = if to > from { (from..=to, Direction::Up) } else { (to..=from, Direction::Down) };
    Branch::new(osc, &orbit.cycle, line.clone(), range, way, BranchOptions::default()).unwrap().collect()
}

fn events(points: &[SolutionPoint]) -> Vec<&SolutionPoint> {
    points.iter().filter(|point| point.event.is_some_and(|event| !event.ends())).collect()
}

/// Points closer to an event than this are at it.
const ASIDE: f64 = 1e-3;

/// The branch in one parameter from a cycle near `near`, from one value past another.
fn alone(osc: &Oscillator, parameter: Parameter, from: f64, past: f64, near: &Cycle) -> Vec<SolutionPoint> {
    let Ok(start) = parameter.set(osc, from) else { return Vec::new() };
    let Some(orbit) = refine(&start, near) else { return Vec::new() };
    let far = 3.0 * (past - from).abs();
    let way = if past > from { Direction::Up } else { Direction::Down };
    let branch = Branch::new(&start, &orbit.cycle, parameter, from - far..=from + far, way, BranchOptions::default());
    branch.map_or_else(|_| Vec::new(), Iterator::collect)
}

/// How often an event on the line was met again in one of its parameters alone, from a little before it to a little behind:
/// all of them are, in each.
fn met_again(osc: &Oscillator, line: &ParameterPath, points: &[SolutionPoint]) -> usize {
    let mut met = 0;
    for (k, event) in points.iter().enumerate() {
        let Some(kind) = event.event.filter(|event| !event.ends()) else { continue };
        // in a cascade of added impacts the events lie closer than a way round them
        if event.cycle.points.len() > 4 {
            continue;
        }
        // the branch on its way to the event
        let on_the_way = |point: &&SolutionPoint| (point.value - event.value).abs() > ASIDE;
        let Some(beside) = points[..k].iter().rev().find(on_the_way) else { continue };
        let there = line.set(osc, event.value).unwrap();
        for (parameter, _) in line.rates(0.0).unwrap() {
            // that point's cycle, where only this parameter differs from the event: by as much, on the side where it is
            let at = parameter.get(&there).unwrap();
            let aside = parameter.get(&line.set(osc, beside.value).unwrap()).unwrap() - at;
            let tried = [aside, -aside].map(|aside| alone(&there, parameter, at + aside, at, &beside.cycle));
            let same = |point: &SolutionPoint| {
                point.event.is_some_and(|event| event.name() == kind.name()) && (point.value - at).abs() < 1e-9
            };
            assert!(
                tried.iter().flatten().any(same),
                "{} of {} at {} not met in {}",
                kind.name(),
                event.cycle.label,
                event.value,
                parameter.name()
            );
            met += 1;
        }
    }
    met
}

#[test]
fn events_are_those_of_either_parameter() {
    let osc = Oscillator::from_inverse_beta(1.0, 1.0, 0.5).unwrap();
    let with = |first: Parameter, other, rate| ParameterPath::from(first).with(other, rate).unwrap();
    let damped = Oscillator::from_inverse_beta(0.9, 3.0, 0.6).unwrap().with_damping(0.1).unwrap();
    for (osc, line, to, least) in [
        (osc, with(Parameter::InverseBeta, Parameter::Gap, 3.0), 1.4, 2),
        (osc, with(Parameter::Gap, Parameter::InverseBeta, 0.25), 3.0, 2),
        (osc, with(Parameter::Gap, Parameter::Restitution, 0.1), -0.9, 2),
        (damped, with(Parameter::Gap, Parameter::Damping, -0.01), 9.0, 2),
    ] {
        let points = branch(&osc, Label::new(1, 1), &line, to);
        let met = met_again(&osc, &line, &points);
        assert!(
            met >= least,
            "{met} of {:?}",
            events(&points).iter().map(|p| p.event.unwrap().name()).collect::<Vec<_>>()
        );
    }
}

/// The same line told by either of its parameters.
#[test]
fn either_parameter_tells_the_place() {
    let osc = Oscillator::from_inverse_beta(1.0, 1.0, 0.5).unwrap();
    let one = ParameterPath::from(Parameter::InverseBeta).with(Parameter::Gap, 4.0).unwrap();
    let other = ParameterPath::from(Parameter::Gap).with(Parameter::InverseBeta, 0.25).unwrap();
    let (by_frequency, by_gap) =
        (branch(&osc, Label::new(1, 1), &one, 1.4), branch(&osc, Label::new(1, 1), &other, 2.6));
    let (a, b) = (events(&by_frequency), events(&by_gap));
    assert!(!a.is_empty() && a.len() == b.len(), "{} and {}", a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!(a.event.unwrap().name(), b.event.unwrap().name());
        assert!((1.0 + 4.0 * (a.value - 1.0) - b.value).abs() < 1e-9, "{} {}", a.value, b.value);
    }
}

/// What does not change is no matter: a rate of zero is the parameter alone, to the last bit.
#[test]
fn a_rate_of_zero_is_the_parameter_alone() {
    let osc = Oscillator::from_inverse_beta(1.11, 1.5, 0.5).unwrap();
    let level = ParameterPath::from(Parameter::Gap).with(Parameter::Damping, 0.0).unwrap();
    let alone = branch(&osc, Label::new(1, 1), &Parameter::Gap.into(), 2.5);
    assert_eq!(branch(&osc, Label::new(1, 1), &level, 2.5), alone);
    assert_eq!(events(&alone).len(), 1);
}

/// A cycle that rests is followed by its release, along a line too: the end of its rest lies where simulation loses it.
#[test]
fn a_cycle_that_rests() {
    let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).unwrap();
    let line = ParameterPath::from(Parameter::Gap).with(Parameter::InverseBeta, 0.3).unwrap();
    let points = branch(&osc, "inf/1".parse().unwrap(), &line, -0.2);
    let end = points.last().unwrap();
    let alone = |osc: &Oscillator| {
        let points = branch(osc, "inf/1".parse().unwrap(), &Parameter::Gap.into(), -0.2);
        points.last().unwrap().value
    };
    // in the gap alone, at the frequency the line ends with
    let there = line.set(&osc, end.value).unwrap();
    let below = Parameter::Gap.set(&there, -0.5).unwrap();
    let names: Vec<_> = points.iter().filter_map(|point| point.event.map(|event| event.name())).collect();
    assert_eq!(names, ["sticking ends", "impact limit"]);
    assert!((alone(&below) - end.value).abs() < 1e-9, "{} {}", alone(&below), end.value);
}

#[test]
fn a_line_needs_the_stops_it_names() {
    let osc = Oscillator::from_inverse_beta(1.11, 1.5, 0.5).unwrap();
    let orbit = find(&osc, Label::new(1, 1), FindOptions::default()).pop().unwrap();
    let line = ParameterPath::from(Parameter::Gap).with(Parameter::SecondGap, 1.0).unwrap();
    let refused = Branch::new(&osc, &orbit.cycle, line, 0.0..=4.0, Direction::Up, BranchOptions::default());
    assert_eq!(refused.map(|_| ()), Err(BranchError::NoSuchParameter("second_gap")));
}
