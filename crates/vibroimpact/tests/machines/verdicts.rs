//! Verdicts on machines: what the multipliers, energy and momentum must be.

use vibroimpact::events::{Limits, Motion, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};

/// The multipliers of a cycle multiply to the product of all $`e^2`$ and $`\exp(-\int \mathrm{tr} M^{-1}C\,dt)`$; an
/// undamped soft stop changes no volume.
#[test]
fn products_of_multipliers() {
    let mut state = 23_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31)
    };
    let mut cycles = 0;
    for case in 0..720 {
        let n = 1 + case % 3;
        let names: Vec<String> = (0..n).map(|i| format!("q{i}")).collect();
        let mut parts = MachineParts::new(names.iter().map(String::as_str)).with_frequency(0.4 + random());
        let mut trace = 0.0;
        for i in 0..n {
            let mass = 0.5 + random();
            parts = parts.with_mass(i, mass);
            let (mut ground, mut link) = (vec![0.0; n], vec![0.0; n]);
            ground[i] = 1.0;
            let c = 0.01 + 0.04 * random();
            parts = parts.with_link(&ground, 0.4 + random(), c).with_force(i, 1, random() - 0.5, random());
            trace += c / mass;
            if i > 0 {
                (link[i - 1], link[i]) = (1.0, -1.0);
                let (c, before) = (0.01 + 0.04 * random(), parts.mass[(i - 1, i - 1)]);
                parts = parts.with_link(&link, 0.4 + random(), c);
                trace += c / mass + c / before;
            }
        }
        let mut direction = vec![0.0; n];
        direction[0] = 1.0;
        let (gap, restitution, soft) = (0.2 + random(), 0.7 + 0.3 * random(), case % 2 == 1);
        let law = StopLaw::Compliant {
            stiffness: 5.0 + 40.0 * random(),
            damping: 0.0,
            preload: 0.0,
            opening: Opening::Force,
        };
        parts = if soft {
            parts.with_stop("stop", &direction, gap, law)
        } else {
            parts.with_rigid_stop("stop", &direction, gap, restitution)
        };
        let machine = Machine::new(parts).unwrap();
        let options = SettleOptions { chaos_over: 0, max_impacts: 1_000, ..SettleOptions::default() };
        let settled = settle_machine(&machine, &Start::default(), &options).unwrap();
        let Verdict::Periodic(cycle) = settled.verdict else { continue };
        if cycle.events.iter().any(|event| event.kind.name() == "stick") {
            continue;
        }
        let closings = i32::try_from(cycle.counts.iter().sum::<u32>()).unwrap();
        let loss = if soft { 1.0 } else { (restitution * restitution).powi(closings) };
        let expected = loss * (-trace * cycle.period).exp();
        // of complex numbers: the moduli, and the sign is positive
        let product: f64 = cycle.multipliers.iter().map(|multiplier| multiplier.modulus()).product();
        assert!(
            (product - expected).abs() < 1e-11 * (1.0 + expected),
            "case {case} {}: {product} {expected}",
            cycle.label
        );
        cycles += 1;
    }
    assert!(cycles >= 500, "{cycles}");
}

/// A free pair between two elastic walls keeps its energy over a million events, and its momentum in every impact
/// of one body on the other.
#[test]
fn energy_and_momentum() {
    let parts = MachineParts::new(["a", "b"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.618)
        .with_rigid_stop("between", &[1.0, -1.0], 0.0, 1.0)
        .with_rigid_stop("left", &[-1.0, 0.0], 1.0, 1.0)
        .with_rigid_stop("right", &[0.0, 1.0], 1.0, 1.0);
    let machine = Machine::new(parts).unwrap();
    let start = Start { q: vec![-0.3, 0.4], qdot: vec![0.7, -0.2], phase: 0.0, ..Start::default() };
    let (mut v, mut seen) = (start.qdot.clone(), 0_u32);
    let energy = |v: &[f64]| 0.5 * (v[0] * v[0] + 1.618 * v[1] * v[1]);
    let before = energy(&v);
    let motion = Motion::new(&machine, &start, Limits::default()).unwrap();
    for event in motion.take(1_000_000) {
        if event.place == 0 {
            let change = (event.qdot[0] - v[0]) + 1.618 * (event.qdot[1] - v[1]);
            assert!(change.abs() < 4e-15, "{change}");
        }
        v = event.qdot;
        seen += 1;
    }
    assert_eq!(seen, 1_000_000);
    // rounding errors add up as a random walk: a thousand of them
    assert!((energy(&v) / before - 1.0).abs() < 1e-12, "{}", energy(&v) / before - 1.0);
}

/// Chaos of one part of a machine whose parts do not act on each other is that of the machine, whatever the order of its coordinates: U
/// of the paper beside an oscillator that comes to a steady motion.
#[test]
fn f42o_chaos_beside_a_steady_part() {
    for chaotic in [0, 1] {
        let mut parts = MachineParts::new(["a", "b"]).with_frequency(1.0 / 1.11);
        for i in 0..2 {
            let mut own = [0.0, 0.0];
            own[i] = 1.0;
            let damping = if i == chaotic { 0.0 } else { 0.3 };
            parts = parts.with_mass(i, 1.0).with_link(&own, 1.0, damping).with_force(i, 1, 0.0, 1.0);
            if i == chaotic {
                parts = parts.with_rigid_stop("stop", &own, 3.0, 0.5);
            }
        }
        let machine = Machine::new(parts).unwrap();
        let found = settle_machine(&machine, &Start::default(), &SettleOptions::default()).unwrap().verdict;
        assert_eq!(found.label(), "chaotic", "{chaotic}");
    }
}

/// Two bodies of mass 2 without damping, one at rest on a stop and one that strikes it ever more gently at the top of its swing.
fn ever_gentler(mass: f64, length: f64) -> (MachineParts, Start) {
    let parts = MachineParts::new(["idle", "moves"])
        .with_mass(0, 2.0 * mass)
        .with_mass(1, 2.0 * mass)
        .with_link(&[1.0, 0.0], 1.190_888_619_587_269_7 * mass, 0.0)
        .with_link(&[0.0, 1.0], 0.5 * mass, 0.0)
        .with_rigid_stop("s", &[-1.0, 0.0], 0.0, 0.68)
        .with_rigid_stop("w", &[0.0, 1.0], 0.335_935_883_214_559_9 * length, 0.0)
        .with_rigid_stop("c", &[-1.0, 1.0], 0.3 * length, 0.8);
    (parts, Start { qdot: vec![0.0, 0.470_353_096_874_196_74 * length], ..Start::default() })
}

/// A machine that nothing drives has no cycle beside which there are no others: each impact takes energy. Impacts that become ever
/// gentler at the top of a swing level off at the rounding error of the gap, and returned after twelve swings to rounding: it was 38/T, stable. They
/// fade away: the verdict is that of the limit, in all units.
#[test]
fn f42q_without_a_drive_there_is_no_isolated_cycle() {
    for (mass, length) in [(1.0, 1.0), (4.0, 0.5), (0.453_592_37, 0.0254)] {
        let (parts, start) = ever_gentler(mass, length);
        let machine = Machine::new(parts).unwrap();
        let found = settle_machine(&machine, &start, &SettleOptions::at_most(2000)).unwrap().verdict;
        assert!(matches!(&found, Verdict::NoImpact(last) if last.fades()), "{}", found.label());
    }
}

/// A damped body beside one that swings for ever, with nothing left between them: what is left of its motion ends where it is a rounding
/// error, on a compliant stop as on a rigid one, and the verdict is that no event follows. It was followed to 1e-300 for 7000 events.
#[test]
fn f42r_a_motion_that_decays_on_a_compliant_stop_ends() {
    let law = StopLaw::Compliant { stiffness: 167.1, damping: 0.0, preload: 0.0, opening: Opening::Force };
    let parts = MachineParts::new(["idle", "swings"])
        .with_mass(0, 1.0)
        .with_mass(1, 2.0)
        .with_link(&[1.0, 0.0], 0.71, 0.1)
        .with_link(&[0.0, 1.0], 1.13, 0.0)
        .with_stop("s", &[-1.0, 0.0], 0.0, law)
        .with_rigid_stop("c", &[-1.0, 1.0], 0.5, 1.0);
    let machine = Machine::new(parts).unwrap();
    let start = Start { qdot: vec![0.1, 0.2], ..Start::default() };
    let settled = settle_machine(&machine, &start, &SettleOptions::at_most(4000)).unwrap();
    assert_eq!(settled.verdict.label(), "0");
    assert!(settled.impacts < 1000, "{}", settled.impacts);
    assert_eq!(settled.verdict.closed(), vec![0]);
}

/// N of the paper beside a body that comes to rest, with times in units of a hundred thousandth and of a hundred thousand: a flight of
/// more than 10000 units of time was not searched, and the motion undecided.
#[test]
fn f42u_the_longest_flight_has_no_unit() {
    for time in [1.0, 1e5, 1e-5] {
        let unit = 1.0 / (time * time);
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, 0.0], unit, 0.0)
            .with_link(&[0.0, 1.0], unit, 0.3 / time)
            .with_frequency(1.0 / 1.8 / time)
            .with_force(0, 1, 0.0, unit)
            .with_rigid_stop("stop", &[1.0, 0.0], 0.25, 0.5);
        let machine = Machine::new(parts).unwrap();
        let found = settle_machine(&machine, &Start::default(), &SettleOptions::default()).unwrap().verdict;
        assert_eq!(found.label(), "4/1", "{time}");
    }
}

/// A mass that rests on a stop at 0 until the force lifts it is at 0 at all its events, and a body beside it moves by rounding errors:
/// all starts lead to one cycle.
#[test]
fn a_cycle_that_rests_at_zero_is_one() {
    let parts = MachineParts::new(["middle", "other"])
        .with_mass(0, 1.0)
        .with_mass(1, 1.0)
        .with_link(&[1.0, 0.0], 2.8, 0.33)
        .with_link(&[0.0, 1.0], 44.0, 1.3)
        .with_frequency(1.0)
        .with_force(0, 1, 0.0, 1.0)
        .with_rigid_stop("stop", &[1.0, 0.0], 0.0, 0.3);
    let machine = Machine::new(parts).unwrap();
    let cycle = |q: f64| {
        let start = Start { q: vec![-0.1, q], qdot: vec![0.2, -q], ..Start::default() };
        match settle_machine(&machine, &start, &SettleOptions::default()).unwrap().verdict {
            Verdict::Periodic(cycle) => cycle,
            other => panic!("{other:?}"),
        }
    };
    let (one, other) = (cycle(0.3), cycle(-0.07));
    assert_eq!(one.label.to_string(), "inf/1");
    assert!(one.same_as(&other, 1e-6), "{one:?} {other:?}");
}
