//! Branches of machines through corners: two events come to one time, beside a grazing contact, within a chatter, or where an impact
//! ends the contact of a damped stop.

use crate::branches_beyond::{agrees_with_simulation, chain, events, settled, traced};
use vibroimpact::continuation::{BranchEvent, Direction, machine::SolutionPoint};
use vibroimpact::events::{EventKind, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::{Label, find_machine_while, machine::Cycle};
use vibroimpact::verdict::scattered_machine_starts;

/// The names of the events of a branch.
fn names(points: &[SolutionPoint]) -> Vec<&'static str> {
    events(points).iter().map(|(event, _)| event.name()).collect()
}

fn machine(parts: MachineParts) -> Machine {
    Machine::new(parts).unwrap()
}

/// A mass on a joint that moves for a part of each half period. Where the force on the held mass only just reaches the static limit,
/// the cycle ends: the multiplier grows without limit, and beyond, the mass is held for ever.
#[test]
fn a_force_that_only_just_reaches_its_limit() {
    let rubbing = |limit: f64| {
        let parts = MachineParts::new(["a"]).with_mass(0, 0.8093).with_link(&[1.0], 0.8138, 0.1487);
        machine(parts.with_frequency(1.1727).with_force(0, 1, -0.0894, 0.5054).with_joint(
            "floor",
            &[1.0],
            0.3838,
            limit,
            0.0,
        ))
    };
    let (machine, path) = (rubbing(0.4892), "force.1.sin.a");
    let cycle = settled(&machine, &Start::default()).unwrap();
    let points = traced((&machine, path), &cycle, (0.27, 0.51), Direction::Down);
    assert_eq!(names(&points), ["fold", "holding begins", "discontinuity"]);
    // the mass is held at x; its spring force and the amplitude of the force add up to the limit
    let last = points.last().unwrap();
    let held = last.cycle.events.iter().find(|event| event.kind == EventKind::Hold).unwrap();
    let force = last.value.hypot(0.0894) + 0.8138 * held.q[0].abs();
    assert!((force - 0.4892).abs() < 1e-6, "{force}");
}

/// A damped stop with a preload whose contact is left by its own force, or by position where it is so fast that both are zero at
/// once. Shortly before this a grazing contact has appeared, so the cycle without it is near; the branch keeps it.
#[test]
fn a_corner_beside_a_grazing_contact() {
    let law = StopLaw::Compliant { stiffness: 43.593, damping: 0.9403, preload: 0.2393, opening: Opening::Force };
    let parts = MachineParts::new(["a"]).with_mass(0, 0.6804).with_link(&[1.0], 0.6741, 0.0988);
    let parts = parts.with_frequency(0.44).with_force(0, 1, 0.0788, 0.6396).with_stop("stop", &[1.0], 0.2948, law);
    let machine = machine(parts);
    let cycle = settled(&machine, &Start::default()).unwrap();
    assert_eq!(cycle.label.to_string(), "4/1");
    let points = traced((&machine, "frequency"), &cycle, (0.405, 0.45), Direction::Down);
    assert_eq!(names(&points), ["grazing", "corner", "fold", "grazing", "fold", "corner", "corner", "end of range"]);
    let found = events(&points);
    assert!((found[1].1 - found[0].1).abs() < 1e-4, "{found:?}");
    let beyond = points.iter().skip_while(|point| point.event != Some(found[1].0)).nth(1).unwrap();
    assert_eq!(beyond.cycle.label.to_string(), "5/1");
    assert!(agrees_with_simulation((&machine, "frequency"), &points) > 2);
}

/// Of three bodies in a row the first strikes a wall, where it chatters, while the others strike each other. Where both impacts come
/// to one time the number turns back, or goes on: what follows is the cycle with the impacts in the other order, not that without
/// the impact that has just appeared.
#[test]
fn a_corner_at_which_the_number_goes_on_or_back() {
    let links = [(0.7442, 0.0793), (1.1303, 0.1487), (0.5729, 0.2263)];
    let parts = chain(&[1.0053, 1.3112, 0.7751], &links, 0.4153, (0.0, 0.0)).with_force(0, 1, 0.0738, 0.848);
    let parts = parts.with_stop("wall", &[1.0, 0.0, 0.0], 0.836, StopLaw::Rigid { restitution: 0.1185 });
    let machine =
        machine(parts.with_stop("between", &[0.0, 1.0, -1.0], 0.1453, StopLaw::Rigid { restitution: 0.8986 }));
    let path = "force.1.sin.a";
    let cycle = settled(&machine, &Start::default()).unwrap();
    let points = traced((&machine, path), &cycle, (0.84, 0.87), Direction::Up);
    assert_eq!(names(&points), ["grazing", "corner", "end of range"]);
    let strikes = |point: &SolutionPoint| {
        point.cycle.events.iter().filter(|event| event.kind == EventKind::Impact && event.place == 1).count()
    };
    let (first, last) = (points.first().unwrap(), points.last().unwrap());
    assert_eq!(strikes(last), strikes(first) + 1);
    assert!(agrees_with_simulation((&machine, path), &points) > 2);
}

/// A joint turns back and forth between two impacts of a chatter on a stop, as it does between all later ones. Where this begins, at
/// the first impacts, multipliers change: it is a corner, however many of the last impacts are followed.
#[test]
fn a_corner_within_a_chatter() {
    let links = [(0.8784, 0.2004), (0.901, 0.0949), (1.4185, 0.2293), (1.1972, 0.0349)];
    let parts = chain(&[1.0631, 1.3176, 1.4545, 1.4171], &links, 1.2156, (0.0, 0.0)).with_force(1, 1, -0.4474, 1.3517);
    let parts = parts.with_stop("stop", &[0.0, -1.0, 1.0, 0.0], -0.1926, StopLaw::Rigid { restitution: 0.3975 });
    let machine = machine(parts.with_joint("floor", &[0.0, 1.0, 0.0, 0.0], 0.2115, 0.2115, 0.0));
    let cycle = settled(&machine, &Start::default().within_stops(&machine)).unwrap();
    let points = traced((&machine, "mass.c"), &cycle, (1.44, 1.455), Direction::Down);
    assert_eq!(names(&points)[..3], ["corner", "corner", "fold"]);
    let ordinary: Vec<&SolutionPoint> = points.iter().filter(|point| point.event.is_none()).collect();
    for pair in ordinary.windows(2) {
        let between = |event: &(BranchEvent, f64)| (event.1 - pair[0].value) * (event.1 - pair[1].value) <= 0.0;
        let stable = [pair[0], pair[1]].map(|point| point.cycle.stable());
        assert!(stable[0] == stable[1] || events(&points).iter().any(between), "{}", pair[0].value);
    }
}

/// A mass on a damped pad before a rigid wall. Where the rebound from the wall is fast the damper would pull, and the contact with the
/// pad ends with the impact; where it is slow the contact ends later, by its own force. Between both is a corner. The product of the
/// multipliers is the loss of volume in the impact, in the structure, and in the pad as long as it is closed.
#[test]
fn an_impact_that_ends_a_contact() {
    let pad = StopLaw::Compliant { stiffness: 10.0, damping: 3.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["a"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.1).with_frequency(0.8);
    let parts = parts.with_force(0, 1, 0.3, 0.0).with_stop("pad", &[1.0], 0.6, pad);
    let machine = machine(parts.with_rigid_stop("wall", &[1.0], 0.75, 0.5));
    let path = "force.1.cos.a";
    let cycle = settled(&machine, &Start::default()).unwrap();
    let points = traced((&machine, path), &cycle, (0.3, 1.6), Direction::Up);
    assert_eq!(
        names(&points),
        ["grazing", "fold", "corner", "grazing", "grazing", "fold", "end of range"],
        "{:?}",
        events(&points)
    );
    assert!(agrees_with_simulation((&machine, path), &points) > 10);
    let mut compared = 0;
    for point in points.iter().filter(|point| point.event.is_none() && point.cycle.label.to_string() == "2/1") {
        let phase = |kind: EventKind| point.cycle.events.iter().find(|event| event.kind == kind).unwrap().phase;
        let closed = phase(EventKind::Open) - phase(EventKind::Close);
        let closed = if closed < 0.0 { closed + core::f64::consts::TAU } else { closed };
        let expected = 0.25 * (-(0.1 * core::f64::consts::TAU + 3.0 * closed) / 0.8).exp();
        let [one, other] = [0, 1].map(|k| point.cycle.multipliers[k]);
        let product = one.re * other.re - one.im * other.im;
        let error = (product - expected).abs() / (1e-9 + one.modulus());
        assert!(error < 1e-9, "{}: {product} {expected}", point.value);
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
}

/// Where a contact without speed appears on a stop without rebound the branch goes on with it: the impact gains speed, and no jump is
/// told.
#[test]
fn a_stop_without_rebound_that_is_grazed() {
    let soft = StopLaw::Compliant { stiffness: 29.9782, damping: 1.076, preload: 0.0, opening: Opening::Force };
    let parts = chain(&[1.4245, 1.0882], &[(0.6708, 0.1154), (0.78, 0.2388)], 1.0497, (-0.1609, 1.3881));
    let parts = parts.with_stop("stop", &[-1.0, 1.0], 0.3335, StopLaw::Rigid { restitution: 0.0 });
    let machine = machine(parts.with_stop("other", &[-1.0, 0.0], 0.3728, soft));
    let cycle = settled(&machine, &Start::default()).unwrap();
    let points = traced((&machine, "stiffness.a.b"), &cycle, (-0.84, -0.78), Direction::Down);
    assert_eq!(names(&points), ["grazing", "end of range"]);
}

/// Near a fold no motion from scattered starts leads to the stable orbit, whose basin is small; those that leave the unstable one do.
#[test]
fn both_orbits_near_a_fold() {
    let law = StopLaw::Compliant { stiffness: 5.76e7, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let (mass, stiffness, w): (f64, f64, f64) = (25.0, 98696.0, 86.4992);
    let damping = 0.14 * (stiffness * mass).sqrt();
    let parts = MachineParts::new(["a"]).with_mass(0, mass).with_link(&[1.0], stiffness, damping).with_frequency(w);
    let parts = parts.with_force(0, 1, -damping / w, -stiffness / (w * w)).with_stop("wall", &[1.0], 5e-4, law);
    // close to the unstable orbit
    let starts = [Start { q: vec![4.99e-4], qdot: vec![0.039_45], phase: 6.175, ..Start::default() }];
    let machine = machine(parts);
    let found = find_machine_while(&machine, Label::new(1, 1), starts, &|| true).unwrap();
    assert_eq!(found.iter().map(|cycle| cycle.stable()).collect::<Vec<_>>(), [false, true]);
}

/// The surface of a lightly damped stop comes back in the limit only. Where the time between two contacts is so long that it stands back
/// by less than any number, nothing happens.
#[test]
fn a_surface_below_all_numbers_is_no_corner() {
    let law = StopLaw::Compliant { stiffness: 40_000.0, damping: 20.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["slide"]).with_mass(0, 2.0).with_link(&[1.0], 500.0, 6.0);
    let parts = parts.with_frequency(18.0).with_force(0, 1, 0.0, 20.0).with_stop("buffer", &[1.0], 0.01, law);
    let machine = machine(parts);
    let cycle = settled(&machine, &Start::default()).unwrap();
    assert_eq!(cycle.label.to_string(), "1/1");
    // k/c times the time between contacts is 745 at about 17.2
    for (range, direction) in [((16.0, 18.0), Direction::Down), ((18.0, 20.0), Direction::Up)] {
        let points = traced((&machine, "frequency"), &cycle, range, direction);
        assert_eq!(names(&points), ["end of range"]);
        assert!(points.iter().all(|point| point.cycle.stable()));
    }
}

/// Between two equal stops a mass loses both contacts at once, where its steady motion has the amplitude of the gaps:
/// (1 - w^2)^2 + (d w)^2 = 1 for the force 1, so w^2 = 2 - d^2.
#[test]
fn contact_is_lost_on_both_sides() {
    for opening in [Opening::Force, Opening::Position] {
        let law = StopLaw::Compliant { stiffness: 10.0, damping: 1.0, preload: 0.0, opening };
        let parts = MachineParts::new(["m"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.2);
        let parts = parts.with_frequency(1.0).with_force(0, 1, 0.0, 1.0);
        let machine = machine(parts.with_stop("up", &[1.0], 1.0, law).with_stop("low", &[-1.0], 1.0, law));
        let cycle = settled(&machine, &Start::default()).unwrap();
        let points = traced((&machine, "frequency"), &cycle, (1.0, 2.0), Direction::Up);
        let found = events(&points);
        let (last, value) = found.last().unwrap();
        assert_eq!(last.name(), "loss of contact", "{found:?}");
        assert!((value - 1.4).abs() < 1e-9, "{found:?}");
    }
}

/// Between two equal stops a symmetric cycle has two branches of cycles without the symmetry beside it, which turn back where they meet
/// it. Along either of them this is a branch point, at the number at which it is one along the symmetric branch.
#[test]
fn a_branch_without_symmetry_turns_at_a_branch_point() {
    let parts = MachineParts::new(["m", "idle"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, 0.0], 1.0, 0.04)
        .with_link(&[0.0, 1.0], 2.0, 1.3)
        .with_frequency(1.0 / 0.7)
        .with_force(0, 1, 0.0, 1.0);
    let parts = parts.with_rigid_stop("upper", &[1.0, 0.0], 0.5, 0.7).with_rigid_stop("lower", &[-1.0, 0.0], 0.5, 0.7);
    let machine = machine(parts);
    let starts = (0..30).map(|index| scattered_machine_starts(&machine, 1, index));
    let cycles = find_machine_while(&machine, Label::new(2, 1), starts, &|| true).unwrap();
    let point = |cycle: &Cycle| {
        let points = traced((&machine, "frequency"), cycle, (1.4, 1.6), Direction::Up);
        let own = |(event, _): &&(BranchEvent, f64)| *event == BranchEvent::BranchPoint;
        events(&points).iter().find(own).map(|(_, value)| *value)
    };
    let found: Vec<f64> = cycles.iter().filter_map(point).collect();
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(found.iter().all(|value| (value - 1.510_970_603_43).abs() < 1e-9), "{found:?}");
}
