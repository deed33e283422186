//! Curves of events of limit cycles of machines without forcing.

use crate::branches_unforced::branch;
use crate::limit_cycles::pair;
use vibroimpact::continuation::{
    BranchEvent, CurveOptions, Direction,
    machine::{Curve, CurvePoint, Plane, SolutionPoint},
};
use vibroimpact::machine::{Machine, MachineParts};

type Number = (&'static str, f64, f64);

/// The first event of a kind on a branch, and the points of the curve through it in both directions.
fn curve(
    machine: &Machine,
    (over, direction): (Number, Direction),
    other: Number,
    kind: &str,
) -> (SolutionPoint, Vec<CurvePoint>) {
    let points = branch(machine, over, direction);
    let event = points.into_iter().find(|point| point.event.is_some_and(|event| event.name() == kind)).unwrap();
    let (file, one, two) = (machine.clone(), over.0, other.0);
    let plane = Plane::new(move |p, q| file.with(one, p).ok()?.with(two, q).ok(), (over.1..=over.2, other.1..=other.2));
    let at = (event.value, machine.number(other.0).unwrap());
    let [forth, back] = Curve::through(&plane, at, &event, CurveOptions::default()).unwrap();
    (event, back.chain(forth).collect())
}

/// The stick-slip of a mass without damping reaches up to sliding + sqrt((static - sliding)^2 + belt^2), where it grazes a
/// stop: on a branch, and on the curve over gap and velocity of the belt.
#[test]
fn grazing_in_closed_form() {
    let (sliding, limit, belt) = (0.2, 0.4, 0.3);
    let parts = MachineParts::new(["mass"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.0)
        .with_rigid_stop("stop", &[1.0], 0.8, 0.7)
        .with_joint("belt", &[1.0], sliding, limit, belt);
    let machine = Machine::new(parts).unwrap();
    let reach = |belt: f64| sliding + (limit - sliding).hypot(belt);
    let (event, points) =
        curve(&machine, (("stop.stop.gap", 0.2, 1.5), Direction::Down), ("friction.belt.belt", 0.1, 0.9), "grazing");
    assert_eq!(
        event.event,
        Some(BranchEvent::Grazing { stop: 0, also: None, appears: true, turns: false, detail: None })
    );
    assert!((event.value - reach(belt)).abs() < 1e-12, "{} {}", event.value, reach(belt));
    assert!(points.len() > 20);
    for point in &points {
        let (gap, belt) = point.values;
        assert!((gap - reach(belt)).abs() < 1e-11 && point.cycle.label.to_string() == "0/T", "{gap} {belt}");
        let jump = limit - sliding;
        let period = 2.0 * jump / belt + std::f64::consts::PI + 2.0 * (belt / jump).atan();
        assert!((point.cycle.period - period).abs() < 1e-11 * period && point.touch.is_none());
    }
}

/// Branches in the first number at other values of the second one meet the event where the curve is.
#[test]
fn branches_meet_the_curves() {
    let machine = pair(0.2, 0.9, 0.5);
    for (over, direction, other, kind) in [
        (("stiffness.low.low", 1.2, 3.0), Direction::Down, ("friction.belt.belt", 0.19, 0.21), "flip"),
        (("stiffness.low.low", 1.2, 3.0), Direction::Down, ("stop.stop.gap", 0.89, 0.91), "fold"),
        (("stop.stop.gap", 0.6, 1.2), Direction::Down, ("friction.belt.belt", 0.19, 0.21), "torus"),
        (("stop.stop.gap", 0.6, 1.2), Direction::Down, ("stop.stop.restitution", 0.45, 0.55), "torus"),
        (("friction.belt.belt", 0.06, 0.4), Direction::Down, ("friction.belt.static", 0.59, 0.61), "fold"),
        (("stiffness.low.low", 1.34, 3.0), Direction::Down, ("friction.belt.belt", 0.199, 0.201), "corner"),
    ] {
        let (_, points) = curve(&machine, (over, direction), other, kind);
        assert!(points.iter().all(|point| point.residual < 1e-8), "{kind}");
        for point in points.iter().step_by(1 + points.len() / 3) {
            let there = machine.with(other.0, point.values.1).unwrap();
            let again = branch(&there, over, direction);
            let nearest = again
                .iter()
                .filter(|point| point.event.is_some_and(|event| event.name() == kind))
                .map(|found| (found.value - point.values.0).abs())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-8, "{kind} at {:?}: {nearest}", point.values);
        }
    }
}
