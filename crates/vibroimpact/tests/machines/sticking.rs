//! Where rests and holds begin and end along branches, and their curves, against closed forms.

use crate::closed_forms::ball;
use std::f64::consts::PI;
use vibroimpact::continuation::{
    BranchError, BranchEvent, BranchOptions, CurveEvent, CurveKind, CurveOptions, Direction,
    machine::{Branch, Curve, CurvePoint, Family, Plane, SolutionPoint},
};
use vibroimpact::events::{EventKind, Limits, Motion, Start};
use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};

/// An oscillator with dry friction (J. P. Den Hartog, Trans. ASME 53 (1931) 107-115).
pub(crate) fn den_hartog(beta: f64, friction: f64) -> Machine {
    let parts = MachineParts::new(["mass"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.0)
        .with_frequency(beta)
        .with_force(0, 1, 1.0, 0.0)
        // derivatives by the friction ask for values beyond its range too
        .with_joint("floor", &[1.0], friction.max(0.0), friction.max(0.0), 0.0);
    Machine::new(parts).unwrap()
}

fn settled(machine: &Machine, start: &Start) -> Cycle {
    let verdict = settle_machine(machine, start, &SettleOptions::default()).unwrap().verdict;
    let Verdict::Periodic(cycle) = verdict else { panic!("{}", verdict.label()) };
    cycle
}

/// The first event of the branch of the settled motion.
fn first_event(
    make: impl Fn(f64) -> Machine + Send + Sync + 'static,
    (from, start): (f64, &Start),
    (range, direction): ((f64, f64), Direction),
) -> SolutionPoint {
    let cycle = settled(&make(from), start);
    let family = Family::new(move |value| Some(make(value)));
    let range = range.0..=range.1;
    let branch = Branch::new((&family, from), &cycle, &range, direction, BranchOptions::default()).unwrap();
    branch.into_iter().find(|point| point.event.is_some()).unwrap()
}

/// A ball without rebound on a vibrating table rests for a part of each period below the amplitude at which it lands in the
/// moment at which the table throws it again: sqrt(1 + pi^2), from both sides.
#[test]
fn a_ball_without_rebound() {
    let make = |gamma: f64| ball(gamma, 0.0);
    let expected = (1.0 + PI * PI).sqrt();
    for (from, direction, begins) in [(2.0, Direction::Up, false), (3.5, Direction::Down, true)] {
        let start = Start { q: vec![from + 0.1], qdot: vec![0.0], phase: 0.0, ..Start::default() };
        let point = first_event(make, (from, &start), ((0.5, 6.0), direction));
        assert_eq!(point.event, Some(BranchEvent::Sticking { stop: 0, begins, detail: None }), "{}", point.value);
        assert!((point.value - expected).abs() < 1e-12, "{} {expected}", point.value);
    }
}

/// By Den Hartog's closed form of the motion that never holds: f = b^2 V / sqrt(1 + b^4 U^2) with V = 1/(1 - b^2) and
/// U = sin(pi/b) / (b (1 + cos(pi/b))).
fn friction_at_limit(beta: f64) -> f64 {
    let (v, u) = (1.0 / (1.0 - beta * beta), (PI / beta).sin() / (beta * (1.0 + (PI / beta).cos())));
    beta * beta * v / (1.0 + beta.powi(4) * u * u).sqrt()
}

/// The mass holds at its turning points from the friction on at which the spring and the force together no longer exceed it
/// there.
#[test]
fn dry_friction() {
    for beta in [0.55, 0.7, 0.8, 0.9] {
        let expected = friction_at_limit(beta);
        let beside = 0.5 * (1.0 - expected).abs().min(0.1);
        for (from, direction, begins) in
            [(expected - beside, Direction::Up, true), (expected + beside, Direction::Down, false)]
        {
            let start = (from, &Start::default());
            let point = first_event(move |friction| den_hartog(beta, friction), start, ((0.001, 1.2), direction));
            assert_eq!(point.event, Some(BranchEvent::Holding { joint: 0, begins }), "{beta} {}", point.value);
            assert!((point.value - expected).abs() < 1e-12, "{beta} {} {expected}", point.value);
        }
    }
}

/// At friction 1, the amplitude of the force, the mass holds for ever. Close to it, it has no velocity at its events and in the
/// middle of its longest flight.
#[test]
fn holding_for_ever() {
    for (beta, from) in [(0.8, 0.9), (0.3, 0.97)] {
        let start = (from, &Start::default());
        let point = first_event(move |friction| den_hartog(beta, friction), start, ((0.001, 1.2), Direction::Up));
        assert_eq!(point.event, Some(BranchEvent::RestForEver { stop: 0 }), "{beta} {}", point.value);
        assert!((point.value - 1.0).abs() < 1e-12, "{beta} {}", point.value);
    }
}

/// The machine swings on beside a body that a joint holds: then its force is that of a linear spring and damper.
#[test]
fn one_body_is_held_for_ever() {
    let make = |friction| {
        let parts = MachineParts::new(["a", "b"]).with_mass(0, 1.0).with_mass(1, 0.7).with_link(&[1.0, 0.0], 1.0, 0.1);
        let parts = parts.with_link(&[1.0, -1.0], 1.0, 0.1).with_frequency(1.2).with_force(0, 1, 0.0, 1.0);
        Machine::new(parts.with_joint("floor", &[0.0, 1.0], friction, friction, 0.0)).ok()
    };
    let point =
        first_event(move |friction| make(friction).unwrap(), (1.5, &Start::default()), ((0.1, 2.0), Direction::Up));
    assert_eq!(point.event, Some(BranchEvent::RestForEver { stop: 0 }), "{}", point.value);
    let omega: f64 = 1.2;
    let exact = 1.0_f64.hypot(0.1 * omega) / (2.0 - omega * omega).hypot(0.2 * omega);
    assert!((point.value - exact).abs() < 1e-9, "{} {exact}", point.value);
}

/// The points of a curve from one end to the other.
fn curve(
    make: impl Fn(f64, f64) -> Option<Machine> + Send + Sync + 'static,
    values: (f64, f64),
    ranges: ((f64, f64), (f64, f64)),
    point: &SolutionPoint,
) -> (CurveKind, Vec<CurvePoint>) {
    let ((a, b), (c, d)) = ranges;
    let plane = Plane::new(make, (a..=b, c..=d));
    let [forth, back] = Curve::through(&plane, values, point, CurveOptions { longest: 0.1, points: 400 }).unwrap();
    let kind = forth.kind();
    let mut points: Vec<CurvePoint> = back.skip(1).collect();
    points.reverse();
    points.extend(forth);
    (kind, points)
}

/// Whether an event of this kind belongs to the settled motion a little on both sides of a point of a curve.
fn beside(make: impl Fn(f64, f64) -> Option<Machine>, point: &CurvePoint, kind: &str) -> [bool; 2] {
    let (p, q) = point.values;
    // above the table on both sides
    let mut start = point.cycle.state.clone();
    start.q[0] += 0.1;
    [-5e-3, 5e-3].map(|by| {
        let cycle = settled(&make(p + by, q).unwrap(), &start);
        cycle.events.iter().any(|event| event.kind.name() == kind)
    })
}

/// The curve of Den Hartog's limit over the frequency, from both sides of it; the mass holds above and not below.
#[test]
fn the_curve_of_dry_friction() {
    let make = |friction, beta| Some(den_hartog(beta, friction));
    for (from, direction) in [(0.7, Direction::Up), (0.85, Direction::Down)] {
        let start = Start::default();
        let point = first_event(|friction| den_hartog(0.8, friction), (from, &start), ((0.001, 1.2), direction));
        let (kind, points) = curve(make, (point.value, 0.8), ((0.1, 1.2), (0.6, 0.97)), &point);
        assert_eq!(kind, CurveKind::Holding { joint: 0 });
        for point in &points {
            let (friction, beta) = point.values;
            let expected = friction_at_limit(beta);
            assert!((friction - expected).abs() < 1e-12, "{beta}: {friction} {expected}");
            assert!(point.residual < 1e-14, "{point:?}");
        }
        for end in [&points[0], &points[points.len() - 1]] {
            assert_eq!(end.event, Some(CurveEvent::EndOfBox));
        }
        assert_eq!((points[0].values.1, points[points.len() - 1].values.1), (0.6, 0.97));
        for point in points.iter().step_by(points.len() / 6) {
            assert_eq!(beside(make, point, "hold"), [false, true], "{:?}", point.values);
        }
    }
}

/// The curve of the ball without rebound over its weight: it rests below.
#[test]
fn the_curve_of_a_ball_without_rebound() {
    let make = |gamma: f64, gravity: f64| {
        let mut parts = ball(gamma, 0.0).parts().clone();
        parts.constant = vec![-gravity];
        Machine::new(parts).ok()
    };
    for (from, direction) in [(2.0, Direction::Up), (3.5, Direction::Down)] {
        let start = Start { q: vec![from + 0.1], qdot: vec![0.0], phase: 0.0, ..Start::default() };
        let point = first_event(|gamma| ball(gamma, 0.0), (from, &start), ((0.5, 6.0), direction));
        let (kind, points) = curve(make, (point.value, 1.0), ((0.5, 6.0), (0.4, 1.6)), &point);
        assert_eq!(kind, CurveKind::Sticking { stop: 0 });
        for point in &points {
            let (gamma, gravity) = point.values;
            assert!((gamma - gravity * (1.0 + PI * PI).sqrt()).abs() < 1e-12, "{gravity}: {gamma}");
            assert!(point.residual < 1e-14, "{point:?}");
        }
        assert_eq!((points[0].values.1, points[points.len() - 1].values.1), (0.4, 1.6));
        for point in points.iter().step_by(points.len() / 6) {
            assert_eq!(beside(make, point, "release"), [true, false], "{:?}", point.values);
        }
    }
}

/// With rebound the ball comes to rest by a chatter, so the limit at its impact is no limit of a rest, and there is no curve
/// over the restitution.
#[test]
fn no_curve_over_the_restitution() {
    let start = Start { q: vec![3.6], qdot: vec![0.0], phase: 0.0, ..Start::default() };
    let point = first_event(|gamma| ball(gamma, 0.0), (3.5, &start), ((0.5, 6.0), Direction::Down));
    let make = |gamma, e| (0.0..=1.0).contains(&e).then(|| ball(gamma, e));
    let plane = Plane::new(make, (0.5..=6.0, 0.0..=0.5));
    let curves = Curve::through(&plane, (point.value, 0.0), &point, CurveOptions { longest: 0.1, points: 400 });
    assert_eq!(curves.err(), Some(BranchError::NoCycle));
}

/// The events of the branch of the settled motion at which a rest or a hold begins or ends.
fn rests(
    make: impl Fn(f64) -> Machine + Send + Sync + 'static,
    from: f64,
    (range, direction): ((f64, f64), Direction),
) -> Vec<SolutionPoint> {
    let cycle = settled(&make(from), &Start::default());
    let family = Family::new(move |value| Some(make(value)));
    let range = range.0..=range.1;
    let branch = Branch::new((&family, from), &cycle, &range, direction, BranchOptions::default()).unwrap();
    use BranchEvent::{Holding, RestForEver, Sticking};
    let of_rest =
        |point: &SolutionPoint| matches!(point.event, Some(Sticking { .. } | Holding { .. } | RestForEver { .. }));
    branch.filter(of_rest).collect()
}

/// A damped oscillator with friction: its cycles are symmetric.
fn damped(beta: f64, friction: f64) -> Machine {
    with_second_harmonic(beta, friction, 0.0)
}

/// The same with a force of two harmonics: its cycles are not symmetric.
fn two_harmonics(beta: f64, friction: f64) -> Machine {
    with_second_harmonic(beta, friction, 1.0)
}

fn with_second_harmonic(beta: f64, friction: f64, second: f64) -> Machine {
    let parts = MachineParts::new(["mass"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(beta)
        .with_force(0, 1, 1.0, 0.0)
        .with_force(0, 2, 0.3 * second, 0.4 * second)
        // derivatives by the friction ask for values beyond its range too
        .with_joint("floor", &[1.0], friction.max(0.0), friction.max(0.0), 0.0);
    Machine::new(parts).unwrap()
}

/// Each event is located at the same value from both sides, and what begins in one direction ends in the other. The joint
/// begins to hold at a turning point, touches velocity zero, its hold is interrupted, and it slips back before it holds.
#[test]
fn events_from_both_sides() {
    let mut compared = 0;
    for beta in [0.3, 0.4, 0.5] {
        let found = |from, direction| rests(move |f| two_harmonics(beta, f), from, ((0.01, 1.2), direction));
        let up = found(0.05, Direction::Up);
        let down = found(0.9, Direction::Down);
        for back in &down {
            let forth = up.iter().find(|forth| (forth.value - back.value).abs() < 1e-12);
            let forth = forth.unwrap_or_else(|| panic!("{beta} {}", back.value));
            let (Some(BranchEvent::Holding { begins: a, .. }), Some(BranchEvent::Holding { begins: b, .. })) =
                (forth.event, back.event)
            else {
                panic!()
            };
            assert!(a != b, "{beta} {}", back.value);
            compared += 1;
        }
    }
    assert!(compared > 18, "{compared}");
}

/// Two masses, one of which strikes a stop without rebound.
fn without_rebound(beta: f64, gap: f64) -> Machine {
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.7)
        .with_link(&[1.0, -1.0], 1.3, 0.2)
        .with_link(&[0.0, 1.0], 0.6, 0.2)
        .with_frequency(beta)
        .with_force(1, 1, 0.7, 0.9)
        .with_force(0, 2, 0.3, 0.0)
        .with_rigid_stop("wall", &[1.0, 0.0], gap, 0.0);
    Machine::new(parts).unwrap()
}

/// Curves through all events of a branch end at the edges of a frame where the branches there have the same events.
#[test]
fn curves_between_branches() {
    let cases = [
        (damped as fn(f64, f64) -> Machine, 0.4, 0.05, (0.01, 0.95), Direction::Up),
        (damped, 0.3, 0.03, (0.01, 0.95), Direction::Up),
        (two_harmonics, 0.3, 0.05, (0.01, 1.2), Direction::Up),
        (without_rebound, 0.4, 0.01, (-2.0, 3.0), Direction::Down),
        (without_rebound, 0.6, 0.01, (-2.0, 3.0), Direction::Down),
        (without_rebound, 0.8, 0.01, (-2.0, 3.0), Direction::Up),
    ];
    let mut ends = 0;
    for (make, beta, from, range, direction) in cases {
        let at = |beta| rests(move |value| make(beta, value), from, (range, direction));
        let edges = [beta - 0.01, beta + 0.01].map(|beta| (beta, at(beta)));
        for point in at(beta) {
            let ranges = (range, (edges[0].0, edges[1].0));
            let (_, points) = curve(move |value, beta| Some(make(beta, value)), (point.value, beta), ranges, &point);
            for end in [&points[0], &points[points.len() - 1]] {
                let Some((_, events)) = edges.iter().find(|(edge, _)| *edge == end.values.1) else { continue };
                let nearest =
                    events.iter().map(|event| (event.value - end.values.0).abs()).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-12, "{beta} {}: {:?} {nearest}", point.value, end.values);
                ends += 1;
            }
        }
    }
    assert!(ends > 28, "{ends}");
}

/// The first value at which a chatter begins or ends to be complete, on a branch over the gap upwards, and the points of its
/// curve over the gap and another number.
fn curve_of_chatter(
    make: impl Fn(f64, f64) -> Option<Machine> + Copy + Send + Sync + 'static,
    (gap, other): (f64, f64),
    others: (f64, f64),
) -> Vec<CurvePoint> {
    let start = Start::default();
    let cycle = settled(&make(gap, other).unwrap(), &start);
    let family = Family::new(move |gap| make(gap, other));
    let options = BranchOptions::default();
    let mut branch = Branch::new((&family, gap), &cycle, &(0.7..=1.1), Direction::Up, options).unwrap();
    let point = branch.find(|point| matches!(point.event, Some(BranchEvent::Sticking { .. }))).unwrap();
    let (kind, points) = curve(make, (point.value, other), ((0.2, 1.4), others), &point);
    assert_eq!(kind, CurveKind::Sticking { stop: 0 });
    for point in &points {
        assert_eq!(point.cycle.label.to_string(), "inf/1", "{:?}", point.values);
    }
    for end in [&points[0], &points[points.len() - 1]] {
        assert_eq!(end.event, Some(CurveEvent::EndOfBox), "{:?}", end.values);
    }
    points
}

/// Of two bodies, one of which strikes a stop: over the stiffness between them a chatter is complete below the curve, and not above.
#[test]
fn the_curve_of_a_complete_chatter() {
    let make = |gap: f64, stiffness: f64| {
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.8)
            .with_link(&[1.0, -1.0], stiffness, 0.12)
            .with_link(&[0.0, 1.0], 0.9, 0.1)
            .with_frequency(0.2)
            .with_force(1, 1, 0.0, 0.9)
            .with_rigid_stop("stop", &[1.0, 0.0], gap, 0.5);
        Machine::new(parts).ok()
    };
    let points = curve_of_chatter(make, (0.9, 1.1), (0.6, 1.6));
    for point in points.iter().step_by(points.len() / 6) {
        let (gap, stiffness) = point.values;
        let mut start = point.cycle.state.clone();
        start.q[0] -= 2e-3;
        let complete = [-1e-3, 1e-3].map(|by| {
            let cycle = settled(&make(gap + by, stiffness).unwrap(), &start);
            cycle.label.to_string() == "inf/1"
        });
        assert_eq!(complete, [true, false], "{:?}", point.values);
    }
}

/// Of a body between two stops: both chatters of a symmetric cycle are complete at once. The curve is the same from two of its
/// points.
#[test]
fn the_curve_of_two_complete_chatters() {
    let make = |gap: f64, e: f64| {
        let parts = MachineParts::new(["a"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.0)
            .with_frequency(0.2)
            .with_force(0, 1, 0.0, 1.0)
            .with_rigid_stop("up", &[1.0], gap, e)
            .with_rigid_stop("down", &[-1.0], gap, e);
        Machine::new(parts).ok()
    };
    let [one, two] = [0.2, 0.3].map(|e| curve_of_chatter(make, (0.9, e), (0.1, 0.7)));
    for end in [0, 1] {
        let [a, b] = [&one, &two].map(|points| points[end * (points.len() - 1)].values);
        assert!(a.1 == b.1 && (a.0 - b.0).abs() < 1e-11, "{a:?} {b:?}");
    }
}

/// At small restitutions the rebounds are soon lower than the rounding error of the gap: the chatter is complete all the same.
#[test]
fn small_restitutions() {
    for (gamma, e) in [(3.2713, 1e-4), (3.22, 1e-3), (2.0, 1e-9)] {
        let start = Start { q: vec![gamma + 0.1], qdot: vec![0.0], phase: 0.0, ..Start::default() };
        let cycle = settled(&ball(gamma, e), &start);
        assert_eq!(cycle.label.to_string(), "inf/1", "{gamma} {e}");
    }
}

/// Two bodies that hold by friction and touch are pushed together: when both joints reach their limits, one is at its limit for
/// good and the other does not slide although its force is at its limit, because the contact holds it. Neither is an event. The bodies
/// part when they are pulled apart with more than the limit, and their motion stays symmetric. The search had no end.
#[test]
fn f42ab_friction_at_its_limit_beside_a_contact() {
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, 0.0], 1.0, 0.02)
        .with_link(&[0.0, 1.0], 1.0, 0.02)
        .with_frequency(1.1)
        .with_force(0, 1, 0.0, 0.6)
        .with_force(1, 1, 0.0, -0.6)
        .with_rigid_stop("c", &[1.0, -1.0], 0.0, 0.3)
        .with_joint("ja", &[1.0, 0.0], 0.3, 0.3, 0.0)
        .with_joint("jb", &[0.0, 1.0], 0.3, 0.3, 0.0);
    let machine = Machine::new(parts).unwrap();
    let events: Vec<_> = Motion::new(&machine, &Start::default(), Limits::default()).unwrap().take(200).collect();
    assert_eq!(events.len(), 200);
    let part = events.iter().find(|event| event.time > 3.0).unwrap();
    assert_eq!((part.kind, part.place), (EventKind::Release, 0));
    assert!((part.time - 7.0 * PI / 6.0 / 1.1).abs() < 1e-14, "{}", part.time);
    for event in &events {
        assert!((event.q[0] + event.q[1]).abs() < 1e-14 && (event.qdot[0] + event.qdot[1]).abs() < 1e-14, "{event:?}");
    }
}
