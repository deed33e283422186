//! Cycles of machines that move on as a whole: capsules, free bodies, and what has no cycle.

use std::f64::consts::TAU;
use vibroimpact::chaos::machine_exponents_while;
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction,
    machine::{Branch, Family},
};
use vibroimpact::events::{Limits, Motion, Samples, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::math::Matrix;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::machine_cycle_quantities;
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};

/// A mass on a spring in a capsule on a rough surface, driven, with a soft plate on one side; `pull` acts on the capsule.
fn capsule(pull: f64) -> Machine {
    let plate = StopLaw::Compliant { stiffness: 15.0, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["mass", "capsule"])
        .with_mass(0, 1.0)
        .with_mass(1, 5.0)
        .with_link(&[1.0, -1.0], 1.0, 0.1)
        .with_constant(1, pull)
        .with_frequency(1.0)
        .with_force(0, 1, 1.6, 0.0)
        .with_stop("plate", &[1.0, -1.0], 0.02, plate)
        .with_joint("surface", &[0.0, 1.0], 1.0, 1.0, 0.0);
    Machine::new(parts).unwrap()
}

/// Two bodies that strike each other, with dampers to the ground and no spring: nothing holds them.
fn pair(push: f64, drags: (f64, f64), restitution: f64) -> Machine {
    let parts = MachineParts::new(["frame", "ball"])
        .with_mass(0, 2.0)
        .with_mass(1, 0.5)
        .with_link(&[1.0, 0.0], 0.0, drags.0)
        .with_link(&[0.0, 1.0], 0.0, drags.1)
        .with_constant(0, push)
        .with_frequency(1.3)
        .with_force(0, 1, 0.0, 3.0)
        .with_rigid_stop("right", &[-1.0, 1.0], 0.3, restitution)
        .with_rigid_stop("left", &[1.0, -1.0], 0.3, restitution);
    Machine::new(parts).unwrap()
}

pub(crate) fn settled(machine: &Machine, start: &Start) -> Verdict<Machine> {
    settle_machine(machine, start, &SettleOptions::default()).unwrap().verdict
}

pub(crate) fn cycle(machine: &Machine, start: &Start) -> Cycle {
    match settled(machine, start) {
        Verdict::Periodic(cycle) => cycle,
        other => panic!("{}", other.label()),
    }
}

/// Coordinates and velocities a time after a start.
fn at(machine: &Machine, start: &Start, time: f64) -> (Vec<f64>, Vec<f64>) {
    let samples = Samples::new(machine, start, Limits::default(), (time, 2.0 * time)).unwrap();
    let last = samples.last().unwrap();
    (last.q, last.qdot)
}

/// The coordinates at the end of whole periods of a long motion, far from its beginning, differ by the drift.
#[test]
fn long_simulations_move_on_by_the_drift() {
    let slow = pair(0.05, (0.3, 0.1), 0.6);
    for (machine, label) in [(capsule(0.0), "3/2"), (capsule(-0.2), ""), (slow, "")] {
        let found = cycle(&machine, &Start::default());
        assert!(label.is_empty() || found.label.to_string() == label, "{}", found.label);
        assert!(found.residual < 1e-12 && found.translations() == 1 && found.multipliers.len() == 3, "{found:?}");
        let largest = found.drift.iter().fold(0.0_f64, |most, drift| most.max(drift.abs()));
        assert!(largest > 1e-2 && (found.drift[0] - found.drift[1]).abs() < 1e-13 * largest, "{:?}", found.drift);
        // from the start of the motion, not from the cycle
        let mut motion = Motion::new(&machine, &Start::default(), Limits::default()).unwrap();
        let mut closings = Vec::new();
        while motion.time() < 400.0 * found.period {
            let Some(event) = motion.next() else { break };
            if event.closes() {
                closings.push(event);
            }
        }
        let each = found.counts.iter().sum::<u32>() as usize;
        let last = closings.len() - 1;
        for k in 0..20 {
            let (one, two) = (&closings[last - k - each], &closings[last - k]);
            for i in 0..2 {
                let moved = two.q[i] - one.q[i];
                // positions have come far, and are rounded there
                let rounding = 8.0 * f64::EPSILON * two.q[i].abs().max(1.0);
                assert!((moved - found.drift[i]).abs() < 1e-12 + rounding, "{moved} {:?}", found.drift);
                assert!((two.qdot[i] - one.qdot[i]).abs() < 1e-12 + 4.0 * rounding, "{one:?} {two:?}");
            }
            assert!((two.time - one.time - found.period).abs() < 1e-9);
        }
        let velocity = found.drift_velocity();
        assert!((velocity[0] * found.period - found.drift[0]).abs() < 1e-15 * largest);
    }
}

/// The multipliers are those of the motion over a period, by differences of its states, less the 1 of the translation.
#[test]
fn multipliers_by_differences() {
    for machine in [capsule(0.0), pair(0.05, (0.3, 0.1), 0.6)] {
        let found = cycle(&machine, &Start::default());
        let h = 1e-6;
        let end = |change: &[f64; 4]| {
            let state = &found.state;
            let start = Start {
                q: vec![state.q[0] + change[0], state.q[1] + change[1]],
                qdot: vec![state.qdot[0] + change[2], state.qdot[1] + change[3]],
                phase: state.phase,
                ..Start::default()
            };
            let (q, v) = at(&machine, &start, found.period);
            [q, v].concat()
        };
        let mut rows = vec![vec![0.0; 4]; 4];
        for j in 0..4 {
            let mut change = [0.0; 4];
            change[j] = h;
            let plus = end(&change);
            change[j] = -h;
            let minus = end(&change);
            for i in 0..4 {
                rows[i][j] = (plus[i] - minus[i]) / (2.0 * h);
            }
        }
        // the traces of the powers of a matrix are the sums of the powers of its eigenvalues
        let turn = Matrix::from_rows(&rows).unwrap();
        let mut power = turn.clone();
        for k in 1..=4 {
            let trace: f64 = (0..4).map(|i| power[(i, i)]).sum();
            let of = |m: &vibroimpact::math::Multiplier| m.modulus().powi(k) * (f64::from(k) * m.im.atan2(m.re)).cos();
            let expected = 1.0 + found.multipliers.iter().map(of).sum::<f64>();
            assert!((trace - expected).abs() < 1e-6, "{k}: {trace} {expected} {:?}", found.multipliers);
            power = power.times(&turn);
        }
        // its exponents are those of the multipliers, and 0 for the translation
        let found = machine_exponents_while(&machine, &Start::default(), (2_000, 200), &|| true);
        let exponents = found.unwrap().unwrap().exponents;
        assert_eq!((exponents.len(), exponents[0].value), (4, 0.0));
        // while a joint holds its velocity is known, so the motion forgets one direction
        let forgotten = exponents.iter().filter(|exponent| exponent.value == f64::NEG_INFINITY).count();
        assert_eq!(forgotten, machine.parts().joints.len(), "{exponents:?}");
    }
}

/// Over a cycle the dampers take the impulse of the constant force: the mean velocity of the pair is their quotient,
/// whatever the impacts do.
#[test]
fn closed_form_of_the_drift() {
    let mut cycles = 0;
    for (push, drags, restitution) in
        [(0.05, (0.3, 0.1), 0.6), (0.4, (0.5, 0.0), 0.3), (-0.2, (0.2, 0.2), 0.5), (0.0, (0.4, 0.1), 0.6)]
    {
        let machine = pair(push, drags, restitution);
        let Verdict::Periodic(found) = settled(&machine, &Start::default()) else { continue };
        let expected = push / (drags.0 + drags.1);
        for velocity in found.drift_velocity() {
            assert!((velocity - expected).abs() < 1e-12, "{velocity} {expected} {}", found.label);
        }
        cycles += 1;
    }
    assert!(cycles >= 3, "{cycles}");
}

/// Over a cycle the powers balance, with that of the constant force along the drift.
#[test]
fn powers_balance() {
    for machine in [capsule(0.0), capsule(-0.2), pair(0.05, (0.3, 0.1), 0.6), pair(0.4, (0.5, 0.0), 0.3)] {
        let found = machine_cycle_quantities(&machine, &cycle(&machine, &Start::default())).unwrap();
        let of = |path: &str| found.value(&machine, path).unwrap();
        let lost = of("impact_power") + of("contact_power") + of("friction_power") + of("damping_power");
        assert!((of("power") - lost).abs() < 1e-12 * lost, "{} {lost}", of("power"));
        // displacements depend on where the machine is
        let name = &machine.parts().coordinates[0];
        assert!(of(&format!("q.{name}.displacement_mean")).is_nan() && of(&format!("q.{name}.velocity_rms")) > 0.0);
        // all coordinates move on at the same mean velocity, that of the drift
        let drift = cycle(&machine, &Start::default()).drift_velocity();
        for (name, drift) in machine.parts().coordinates.iter().zip(drift) {
            let mean = of(&format!("q.{name}.velocity_mean"));
            assert!((mean - drift).abs() < 1e-13, "{mean} {drift}");
        }
    }
}

/// Motions that differ by a translation are the same, wherever they begin.
#[test]
fn a_translation_makes_no_other_motion() {
    let machine = capsule(0.0);
    let here = settled(&machine, &Start::default());
    for way in [-7.0, 0.3, 1e4] {
        let start = Start { q: vec![way, way], ..Start::default() };
        let there = settled(&machine, &start);
        assert_eq!(there.label(), here.label());
        assert!(here.same_as(&there, 1e-6) && there.same_as(&here, 1e-6), "{way}");
    }
    // the drift belongs to the motion: the other direction is another one
    let (one, two) = (pair(0.05, (0.3, 0.1), 0.6), pair(-0.05, (0.3, 0.1), 0.6));
    let (one, two) = (settled(&one, &Start::default()), settled(&two, &Start::default()));
    assert!(!one.same_as(&two, 1e-6));
}

/// A force that friction and dampers cannot balance makes the velocity grow: there is no cycle.
#[test]
fn growing_velocities_are_no_cycle() {
    let options = SettleOptions { max_impacts: 3_000, ..SettleOptions::default() };
    for machine in [capsule(1.5), pair(0.05, (0.0, 0.0), 0.6)] {
        let found = settle_machine(&machine, &Start::default(), &options).unwrap();
        assert!(!matches!(found.verdict, Verdict::Periodic(_)), "{}", found.verdict.label());
    }
}

/// A branch in a number goes through cycles that drift, and its points are what settling finds there.
#[test]
fn branches_of_drifting_cycles() {
    for (machine, path, range) in
        [(capsule(0.0), "stop.plate.gap", 0.0..=0.06), (pair(0.05, (0.3, 0.1), 0.6), "constant.frame", 0.0..=0.1)]
    {
        let found = cycle(&machine, &Start::default());
        let (family, value) = Family::of_path(&machine, path).unwrap();
        for direction in [Direction::Up, Direction::Down] {
            let branch = Branch::new((&family, value), &found, &range, direction, BranchOptions::default());
            let points: Vec<_> = branch.unwrap().collect();
            let last = points.last().and_then(|point| point.event);
            assert!(points.len() > 3 && last != Some(BranchEvent::NoConvergence), "{path} {last:?}");
            for point in points.iter().filter(|point| point.event.is_none() && point.cycle.stable()) {
                assert!(point.cycle.residual < 1e-11 && point.cycle.multipliers.len() == 3);
                let there = family.at(point.value).unwrap();
                let Verdict::Periodic(settled) = settled(&there, &point.cycle.state) else { panic!() };
                assert!(settled.same_as(&point.cycle, 1e-8), "{path} = {}", point.value);
                assert!((settled.drift[0] - point.cycle.drift[0]).abs() < 1e-10, "{path} = {}", point.value);
            }
        }
    }
}

/// At a flip a cycle of twice the period begins, with twice the drift; beyond, it is what simulation finds.
#[test]
fn a_flip_doubles_the_drift() {
    let machine = capsule(0.0);
    let found = cycle(&machine, &Start::default());
    let (family, value) = Family::of_path(&machine, "force.1.cos.mass").unwrap();
    let branch = Branch::new((&family, value), &found, &(1.05..=1.6), Direction::Down, BranchOptions::default());
    let flip = branch.unwrap().find(|point| point.event == Some(BranchEvent::Flip)).unwrap();
    assert!((flip.cycle.multipliers[0].re + 1.0).abs() < 1e-6);
    let (at, doubled) = flip.leaving(&family, 0.1).pop().unwrap();
    assert_eq!(doubled.label.to_string(), "6/4");
    assert!(
        (doubled.drift[0] - 2.0 * flip.cycle.drift[0]).abs() < 0.05 * doubled.drift[0].abs(),
        "{:?}",
        doubled.drift
    );
    if doubled.stable() {
        let Verdict::Periodic(other) = settled(&family.at(at).unwrap(), &doubled.state) else { panic!() };
        assert!(other.same_as(&doubled, 1e-6));
    }
}

/// A capsule that its surface holds has no further event, wherever it has come to rest.
#[test]
fn a_held_capsule_is_no_cycle() {
    let mut parts = capsule(0.0).parts().clone();
    (parts.frequency, parts.forces[0].cos[0], parts.stops[0].gap) = (Some(0.5), 0.750_726_995, 10.0);
    let held = Machine::new(parts).unwrap();
    let slipping = held.with("force.1.cos.mass", 0.750_726_996).unwrap();
    assert!(matches!(settled(&held, &Start::default()), Verdict::NoImpact(_)));
    let Verdict::Periodic(found) = settled(&slipping, &Start::default()) else { panic!() };
    assert!(!found.events.is_empty() && found.drift == [0.0, 0.0]);
}

/// A free body without stops has no events; its steady motion drifts with the force over the drag.
#[test]
fn without_stops() {
    let parts = MachineParts::new(["body"]).with_mass(0, 1.0).with_link(&[1.0], 0.0, 0.4).with_constant(0, 0.2);
    let machine = Machine::new(parts.with_frequency(2.0).with_force(0, 1, 1.0, 0.0)).unwrap();
    assert_eq!(settled(&machine, &Start::default()).label(), "0");
    let parts = machine.parts().clone();
    let label = |direction: f64| {
        let walled = Machine::new(parts.clone().with_rigid_stop("wall", &[direction], 3.0, 0.5)).unwrap();
        settled(&walled, &Start::default()).label()
    };
    // it never comes to a wall from which the force takes it away
    assert_eq!((&*label(-1.0), label(1.0) == "0"), ("0", false));
    let (one, two) = (at(&machine, &Start::default(), 100.0 * TAU), at(&machine, &Start::default(), 101.0 * TAU));
    assert!((two.0[0] - one.0[0] - 0.5 * TAU).abs() < 1e-11);
}
