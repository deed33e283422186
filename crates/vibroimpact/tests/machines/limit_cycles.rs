//! Limit cycles of machines without forcing: bodies on moving belts.

use crate::drift::{cycle, settled};
use std::f64::consts::PI;
use vibroimpact::chaos::machine_exponents_while;
use vibroimpact::events::{EventKind, Limits, Motion, Start};
use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::math::Multiplier;
use vibroimpact::quantities::machine_cycle_quantities;
use vibroimpact::verdict::{Count, scattered_machine_starts};

/// A mass of 1 on a spring of 1, on a belt.
pub(crate) fn on_belt((sliding, limit): (f64, f64), belt: f64, damping: f64) -> Machine {
    let parts = MachineParts::new(["mass"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, damping);
    Machine::new(parts.with_joint("belt", &[1.0], sliding, limit, belt)).unwrap()
}

/// Without damping the mass sticks for (x1 - x0)/V and slips for pi + 2 atan(V/(x1 - sliding)), where x1 is the static limit
/// and x0 = 2 sliding - x1. All of the state is forgotten while it sticks.
#[test]
fn stick_slip_in_closed_form() {
    for (sliding, limit, belt) in [(0.2, 0.4, 0.1), (0.5, 0.6, 0.02), (0.0, 1.0, 0.7), (1.0, 1.5, 2.5)] {
        let start = Start { q: vec![0.0], qdot: vec![belt], phase: 0.0, ..Start::default() };
        let cycle = cycle(&on_belt((sliding, limit), belt, 0.0), &start);
        let jump = limit - sliding;
        let expected = 2.0 * jump / belt + PI + 2.0 * (belt / jump).atan();
        assert!((cycle.period - expected).abs() < 1e-12 * expected, "{} {expected}", cycle.period);
        assert_eq!((cycle.label.to_string().as_str(), cycle.events.len()), ("0/T", 2));
        assert!(cycle.multipliers.len() == 1 && cycle.multipliers[0].modulus() < 1e-12, "{:?}", cycle.multipliers);
    }
}

/// Two masses on springs, the first on a belt, the second against a stop.
pub(crate) fn pair(belt: f64, gap: f64, restitution: f64) -> Machine {
    let parts = MachineParts::new(["low", "high"])
        .with_mass(0, 1.0)
        .with_mass(1, 0.4)
        .with_link(&[1.0, 0.0], 1.0, 0.01)
        .with_link(&[1.0, -1.0], 0.7, 0.05)
        .with_rigid_stop("stop", &[0.0, 1.0], gap, restitution)
        .with_joint("belt", &[1.0, 0.0], 0.3, 0.6, belt);
    Machine::new(parts).unwrap()
}

/// The state at the next hold of the first mass after one from this state; its velocity is that of the belt.
fn next_hold(machine: &Machine, belt: f64, [low, high, rate]: [f64; 3]) -> [f64; 3] {
    let start = Start { q: vec![low, high], qdot: vec![belt, rate], phase: 0.0, ..Start::default() };
    let motion = Motion::new(machine, &start, Limits::default()).unwrap();
    let hold = motion.into_iter().find(|event| event.time > 0.0 && event.kind == EventKind::Hold).unwrap();
    [hold.q[0], hold.q[1], hold.qdot[1]]
}

/// The multipliers against differences of the map from hold to hold, by their elementary symmetric functions.
#[test]
fn multipliers_are_those_of_the_return_map() {
    let mut labels = Vec::new();
    for (belt, gap, restitution) in [(0.2, 10.0, 0.5), (0.1, 0.7, 0.6), (0.15, 0.65, 0.9), (0.12, 0.6, 0.2)] {
        let machine = pair(belt, gap, restitution);
        let start = Start { q: vec![0.0; 2], qdot: vec![belt, 0.0], phase: 0.0, ..Start::default() };
        let cycle = cycle(&machine, &start);
        labels.push(cycle.label.to_string());
        let holds: Vec<_> = cycle.events.iter().filter(|event| event.kind == EventKind::Hold).collect();
        let at = [holds[0].q[0], holds[0].q[1], holds[0].qdot[1]];
        let mut jacobian = [[0.0; 3]; 3];
        let step = 3e-7;
        for j in 0..3 {
            let moved = |by: f64| {
                let mut from = at;
                from[j] += by;
                (0..holds.len()).fold(from, |state, _| next_hold(&machine, belt, state))
            };
            let (up, down) = (moved(step), moved(-step));
            for i in 0..3 {
                jacobian[i][j] = (up[i] - down[i]) / (2.0 * step);
            }
        }
        let j = &jacobian;
        let minor = |a: usize, b: usize| j[a][a] * j[b][b] - j[a][b] * j[b][a];
        let by_map = [j[0][0] + j[1][1] + j[2][2], minor(0, 1) + minor(0, 2) + minor(1, 2)];
        let times = |a: Multiplier, b: Multiplier| a.re * b.re - a.im * b.im;
        let m = &cycle.multipliers;
        assert_eq!(m.len(), 3, "{belt} {gap}");
        let own = [m[0].re + m[1].re + m[2].re, times(m[0], m[1]) + times(m[0], m[2]) + times(m[1], m[2])];
        for (a, b) in by_map.iter().zip(own) {
            assert!((a - b).abs() < 1e-7, "{belt} {gap}: {by_map:?} {own:?}");
        }
        // one direction is forgotten while the first mass is held
        assert!(m[2].modulus() < 1e-10, "{m:?}");
        let count = cycle.events.iter().filter(|event| event.closes()).count();
        assert_eq!(cycle.label.impacts, Count::Finite(u32::try_from(count).unwrap()));
    }
    assert!(labels.iter().any(|label| label == "0/T") && labels.iter().any(|label| label != "0/T"), "{labels:?}");
}

/// From any start the same cycle, over its smallest period; a simulation of 50 periods returns to it.
#[test]
fn one_cycle_from_many_starts() {
    let machine = pair(0.1, 0.7, 0.6);
    let first = cycle(&machine, &Start::default());
    for k in 0..8 {
        let q = vec![-0.3 + 0.1 * f64::from(k), 0.1 - 0.05 * f64::from(k)];
        let other = cycle(&machine, &Start { q, qdot: vec![0.3, -0.2 * f64::from(k)], phase: 0.0, ..Start::default() });
        assert!(first.same_as(&other, 1e-8), "{k}: {} {}", first.period, other.period);
    }
    let motion = Motion::new(&machine, &first.state, Limits::default()).unwrap();
    let m = first.events.len();
    let events: Vec<_> = motion.into_iter().take(50 * m).collect();
    let turns = events[50 * m - 1].time - events[m - 1].time;
    assert!((turns - 49.0 * first.period).abs() < 1e-11 * turns, "{turns} {}", first.period);
}

/// Over a cycle the belt gives what friction, the damper and the stop take. The exponent along the motion is 0.
#[test]
fn power_and_exponents() {
    let machine = pair(0.15, 0.65, 0.9);
    let cycle = cycle(&machine, &Start::default());
    let found = machine_cycle_quantities(&machine, &cycle).unwrap();
    let of = |path: &str| found.value(&machine, path).unwrap();
    let lost = of("impact_power") + of("friction_power") + of("damping_power");
    assert!((of("power") - lost).abs() < 1e-12 * lost && lost > 0.0, "{} {lost}", of("power"));
    assert!(of("impacts_per_period").is_nan());
    let exponents = machine_exponents_while(&machine, &Start::default(), (2_000, 100), &|| true).unwrap().unwrap();
    assert!(exponents.exact() && exponents.exponents.len() == 4);
    assert!(exponents.exponents[0].value == 0.0 && exponents.exponents[1].value < 0.0);
    assert!(exponents.exponents[3].value == f64::NEG_INFINITY);
}

/// On a fast belt the mass comes to rest, and of a motion that is one of a family no cycle is told.
#[test]
fn what_is_no_limit_cycle() {
    assert_eq!(settled(&on_belt((0.2, 0.4), 5.0, 0.3), &Start::default()).label(), "0");
    let parts = MachineParts::new(["mass"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.0);
    let elastic = Machine::new(parts.with_rigid_stop("stop", &[1.0], 0.3, 1.0)).unwrap();
    let start = Start { q: vec![0.0], qdot: vec![1.0], phase: 0.0, ..Start::default() };
    assert_eq!(settled(&elastic, &start).label(), "undecided");
}

/// The scattered starts of a machine that only a belt drives fill the box of its motions: where the friction takes the body, and how fast
/// the belt moves.
#[test]
fn starts_reach_as_far_as_a_belt_takes_bodies() {
    let parts = MachineParts::new(["m"]).with_mass(0, 2.0).with_link(&[1.0], 800.0, 0.2);
    let machine = Machine::new(parts.with_joint("disc", &[1.0], 6.0, 10.0, 0.3)).unwrap();
    let starts: Vec<Start> = (0..40).map(|index| scattered_machine_starts(&machine, 1, index)).collect();
    let largest = |of: fn(&Start) -> f64| starts.iter().map(of).fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(largest(|start| start.q[0]) > 10.0 / 800.0 && largest(|start| start.qdot[0]) > 0.3);
}
