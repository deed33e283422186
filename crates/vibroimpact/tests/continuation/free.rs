//! The steady motion without impacts on branches, from and to its touch of a stop.

use vibroimpact::continuation::{
    Branch, BranchError, BranchEvent, BranchOptions, Direction, EventDetail, SolutionPoint,
};
use vibroimpact::orbit::{FindOptions, find, without_impacts};
use vibroimpact::verdict::{SettleOptions, Verdict, settle};
use vibroimpact::{Label, Oscillator, Parameter, Start};

/// The branch of the motion without impacts.
fn branch(osc: &Oscillator, parameter: Parameter, range: (f64, f64), direction: Direction) -> Vec<SolutionPoint> {
    let cycle = without_impacts(osc).unwrap();
    Branch::new(osc, &cycle, parameter, range.0..=range.1, direction, BranchOptions::default()).unwrap().collect()
}

fn names(points: &[SolutionPoint]) -> Vec<(&'static str, String)> {
    points.iter().filter_map(|p| Some((p.event?.name(), p.cycle.label.to_string()))).collect()
}

/// What simulation settles into from the motion itself, aside a little.
fn settled(osc: &Oscillator, start: Start) -> String {
    match settle(osc, start, &SettleOptions::default()).verdict {
        Verdict::Periodic(cycle) => cycle.label.to_string(),
        other => other.label().to_string(),
    }
}

#[test]
fn from_the_free_motion_through_its_touch_to_1_1() {
    let at = |gap: f64| Oscillator::new(1.0, gap, 0.8).unwrap().with_damping(0.05).unwrap();
    let points = branch(&at(12.0), Parameter::Gap, (1.0, 12.5), Direction::Down);
    let expected = [("grazing", "0"), ("fold", "1/1"), ("end of range", "1/1")];
    assert_eq!(names(&points), expected.map(|(name, label)| (name, label.to_string())));
    let graze = points.iter().find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
    let Some(BranchEvent::Grazing { appears: true, turns, detail: Some(EventDetail { labels, phase, .. }), .. }) =
        graze.event
    else {
        panic!("{:?}", graze.event)
    };
    assert_eq!((labels, turns), ((Label::new(0, 1), Some(Label::new(1, 1))), true));
    assert!((graze.value - 10.0).abs() < 1e-12 && (phase - std::f64::consts::PI).abs() < 1e-12);
    assert!(points.iter().all(|p| p.physical));
    assert!(points.iter().filter(|p| p.cycle.points.is_empty()).all(|p| p.value >= 10.0 - 1e-12 && p.stable()));
    // beside it: the motion itself, and where it has gone, 1/1 from the same state
    let start = |gap: f64| Start::free_motion(&at(12.0)).map(|s| Start { x: s.x.min(gap), ..s }).unwrap();
    for h in [1e-3, 1e-6] {
        assert_ne!(settled(&at(10.0 + h), start(10.0)), "1/1");
        assert_eq!(settled(&at(10.0 - h), start(10.0 - h)), "1/1");
    }
}

#[test]
fn there_and_back_again() {
    for (beta, zeta, eps) in [(0.7, 0.1, 0.5), (1.4, 0.05, 0.8), (0.9, 0.3, 0.3), (1.0, 0.05, 0.8)] {
        let osc = Oscillator::new(beta, 1.0, eps).unwrap().with_damping(zeta).unwrap();
        let f = osc.free_amplitude();
        let range = (0.6 * f, 1.6 * f);
        let down = branch(&Parameter::Gap.set(&osc, 1.5 * f).unwrap(), Parameter::Gap, range, Direction::Down);
        let last = down.last().unwrap();
        let graze = down.iter().find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
        assert!((graze.value - f).abs() < 1e-12 * (1.0 + f), "{} {f}", graze.value);
        // the way back from 1/1 beyond the touch
        let k = down.iter().position(|p| p.event.is_none() && p.cycle.label == Label::new(1, 1)).unwrap();
        let near = &down[k + 2];
        let osc = Parameter::Gap.set(&osc, near.value).unwrap();
        for direction in [Direction::Up, Direction::Down] {
            let options = BranchOptions::default();
            let back = Branch::new(&osc, &near.cycle, Parameter::Gap, range.0..=range.1, direction, options).unwrap();
            let end = back.last().unwrap();
            let free = end.cycle.points.is_empty();
            assert_eq!(end.event, Some(BranchEvent::EndOfRange), "{:?}", end.event);
            assert!(free == (end.value == range.1) || end.value == last.value, "{} {}", end.value, end.cycle.label);
        }
    }
}

/// A resonance so narrow that a step would go over it.
#[test]
fn a_narrow_resonance_is_not_missed() {
    let osc = Oscillator::new(0.5, 60.0, 0.5).unwrap().with_damping(0.008).unwrap();
    let from = |beta: f64, direction| {
        let osc = Parameter::Beta.set(&osc, beta).unwrap();
        let points = branch(&osc, Parameter::Beta, (0.5, 3.0), direction);
        points.iter().find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap().value
    };
    // 1 / f^2 at the touch, a quadratic in beta^2
    let (zeta, gap) = (0.008_f64, 60.0_f64);
    let middle = 1.0 - 2.0 * zeta * zeta;
    let width = (middle * middle - 1.0 + 1.0 / (gap * gap)).sqrt();
    assert!((from(0.5, Direction::Up) - (middle - width).sqrt()).abs() < 1e-12);
    assert!((from(3.0, Direction::Down) - (middle + width).sqrt()).abs() < 1e-12);
}

/// Between two stops alike it touches both at once, and the symmetric orbit with an impact on each takes over.
#[test]
fn two_stops_alike_are_touched_together() {
    let osc = Oscillator::new(1.9, 1.0, 0.6).unwrap().with_damping(0.1).unwrap().with_second_stop(1.0, 0.6).unwrap();
    let points = branch(&osc, Parameter::Beta, (1.2, 2.0), Direction::Down);
    let graze = points.iter().find(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).unwrap();
    let after = graze.event.and_then(|event| event.detail()?.labels.1).unwrap();
    assert_eq!(after, Label::new(2, 1));
    let next = points.iter().find(|p| p.event.is_none() && p.cycle.label == after && p.cycle.fastest() > 1e-3).unwrap();
    assert!(next.physical);
    let [a, b] = [next.cycle.points[0].state, next.cycle.points[1].state];
    assert!(a.side != b.side && (a.velocity - b.velocity).abs() < 1e-9, "{a:?} {b:?}");
    let osc = Parameter::Beta.set(&osc, next.value).unwrap();
    let found = find(&osc, after, FindOptions::default());
    assert!(found.iter().any(|o| o.cycle.same_as(&next.cycle, 1e-7)));
}

#[test]
fn without_damping_there_is_nothing_to_follow() {
    let osc = Oscillator::new(0.5, 3.0, 0.5).unwrap();
    assert_eq!(without_impacts(&osc), None);
    let cycle = without_impacts(&osc.with_damping(0.1).unwrap()).unwrap();
    let options = BranchOptions::default();
    let refused = Branch::new(&osc, &cycle, Parameter::Gap, 1.0..=4.0, Direction::Down, options);
    assert_eq!(refused.unwrap_err(), BranchError::Undamped);
    assert_eq!(find(&osc, Label::new(0, 1), FindOptions::default()), Vec::new());
    let damped = find(&osc.with_damping(0.1).unwrap(), Label::new(0, 1), FindOptions::default());
    assert!(damped.len() == 1 && damped[0].physical && damped[0].cycle.stable());
}
