//! Exponents and multipliers of cycles in which something decays by many powers of ten: Liouville's sum. Exponents of machines
//! that are oscillators, or have no contacts.

use vibroimpact::chaos::{ExponentOptions, Exponents, exponents, machine_exponents_while};
use vibroimpact::events::{EventKind, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{SettleOptions, Undecided, Verdict, settle_machine};

fn found(parts: MachineParts) -> (Exponents<Machine>, Vec<f64>) {
    let machine = Machine::new(parts).unwrap();
    let found = machine_exponents_while(&machine, &Start::default(), (4_000, 500), &|| true).unwrap().unwrap();
    let exponents = found.exponents.iter().map(|exponent| exponent.value).collect();
    (found, exponents)
}

fn cycle(found: &Exponents<Machine>) -> &Cycle {
    let Verdict::Periodic(cycle) = &found.motion else { panic!("{}", found.motion.label()) };
    cycle
}

/// The part of the period for which a stop is closed.
fn closed(cycle: &Cycle, stop: usize) -> f64 {
    let own: Vec<_> = cycle.events.iter().filter(|event| event.place == stop).collect();
    let mut sum = 0.0;
    for (k, event) in own.iter().enumerate().filter(|(_, event)| event.kind == EventKind::Close) {
        let next = own[(k + 1) % own.len()];
        assert_eq!(next.kind, EventKind::Open);
        sum += (next.time - event.time).rem_euclid(cycle.period);
    }
    sum / cycle.period
}

fn stop(stiffness: f64, damping: f64) -> StopLaw {
    StopLaw::Compliant { stiffness, damping, preload: 0.0, opening: Opening::Position }
}

fn overdamped(damping: f64) -> MachineParts {
    MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(0.7)
        .with_force(0, 1, 0.0, 1.0)
        .with_stop("s", &[1.0], 0.2, stop(100.0, damping))
}

/// 1. The sum of the exponents is minus the damping and that of the stop while it is closed, and multipliers and exponents say the
///    same. Values with 77 digits at a damping of 20.
#[test]
fn overdamped_stops() {
    for damping in [5.0, 15.0, 20.0, 30.0, 60.0, 100.0, 200.0, 1000.0] {
        let (found, exponents) = found(overdamped(damping));
        let cycle = cycle(&found);
        let sum: f64 = exponents.iter().sum();
        let wanted = -(0.1 + damping * closed(cycle, 0));
        assert!((sum - wanted).abs() < 1e-9 * (1.0 + wanted.abs()), "{damping}: {exponents:?}, {wanted} wanted");
        for (multiplier, exponent) in cycle.multipliers.iter().zip(&exponents) {
            let modulus = (exponent * cycle.period).exp();
            assert!((multiplier.modulus() - modulus).abs() <= 1e-9 * modulus, "{damping}: {multiplier:?} {exponent}");
        }
        if damping == 20.0 {
            assert!((exponents[0] + 3.27243).abs() < 2e-5 && (exponents[1] + 4.49465).abs() < 2e-5, "{exponents:?}");
        }
        if damping == 100.0 {
            assert!((sum + 44.933_098).abs() < 1e-5, "{sum}");
        }
    }
}

/// 2. Two bodies, each with a damped stop: more than one direction decays by more than rounding leaves.
#[test]
fn two_overdamped_stops() {
    for (one, two) in [(30.0, 50.0), (80.0, 80.0), (300.0, 40.0)] {
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 0.8)
            .with_link(&[1.0, 0.0], 1.0, 0.1)
            .with_link(&[1.0, -1.0], 0.6, 0.05)
            .with_link(&[0.0, 1.0], 0.9, 0.1)
            .with_frequency(0.6)
            .with_force(0, 1, 0.2, 1.0)
            .with_force(1, 1, 0.5, 0.8)
            .with_stop("one", &[1.0, 0.0], 0.2, stop(100.0, one))
            .with_stop("two", &[0.0, 1.0], 0.3, stop(80.0, two));
        let (found, exponents) = found(parts);
        let cycle = cycle(&found);
        let sum: f64 = exponents.iter().sum();
        let own = 0.15 + 0.15 / 0.8;
        let wanted = -(own + one * closed(cycle, 0) + two / 0.8 * closed(cycle, 1));
        assert!((sum - wanted).abs() < 1e-9 * wanted.abs(), "{one} {two}: {exponents:?}, {wanted} wanted");
    }
}

/// 3. A strong damper inside a structure with a rigid stop: the restitution counts twice for each impact.
#[test]
fn overdamped_structures() {
    for (damper, restitution) in [(20.0, 0.7), (60.0, 0.5), (200.0, 0.9), (60.0, 1e-3)] {
        let parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, 0.0], 1.0, 0.2)
            .with_link(&[1.0, -1.0], 2.0, 0.0)
            .with_link(&[0.0, 1.0], 1.0, damper)
            .with_frequency(1.1)
            .with_force(0, 1, 0.0, 1.0)
            .with_rigid_stop("wall", &[1.0, 0.0], 0.3, restitution);
        let (found, exponents) = found(parts);
        let Verdict::Periodic(cycle) = &found.motion else { continue };
        if cycle.events.iter().any(|event| event.kind == EventKind::Stick) {
            continue;
        }
        let impacts = f64::from(cycle.counts[0]);
        let wanted = -(0.2 + damper) + 2.0 * impacts * restitution.ln() / cycle.period;
        let sum: f64 = exponents.iter().sum();
        assert!((sum - wanted).abs() < 1e-9 * wanted.abs(), "{damper} {restitution}: {exponents:?}, {wanted} wanted");
    }
}

/// 4. Minus infinity is where neighbouring motions become the same, and nowhere else: at rest on a stop two, where a joint holds and
///    at an impact without restitution one.
#[test]
fn what_is_forgotten() {
    let lost = |exponents: &[f64]| exponents.iter().filter(|value| **value == f64::NEG_INFINITY).count();
    // a ball that comes to rest on its table
    let mut parts = MachineParts::new(["ball"])
        .with_mass(0, 1.0)
        .with_frequency(1.0)
        .with_constant(0, -1.0)
        .with_rigid_stop("table", &[-1.0], 0.0, 0.5);
    parts.stops[0].motion.push(vibroimpact::machine::HarmonicMotion { order: 1, cos: 0.0, sin: 1.1 });
    let (ball, exponents) = found(parts);
    assert_eq!((&*ball.motion.label(), lost(&exponents)), ("inf/1", 2));
    assert!(cycle(&ball).multipliers.iter().all(|multiplier| multiplier.modulus() == 0.0));
    // stuck for ever
    let parts = MachineParts::new(["x"]).with_mass(0, 1.0).with_constant(0, 1.0).with_rigid_stop("s", &[1.0], 0.1, 0.5);
    let (stuck, exponents) = found(parts);
    assert_eq!((&*stuck.motion.label(), lost(&exponents)), ("stuck", 2));
    // Den Hartog's block between soft stops: it holds twice a period at low frequencies
    let mut held = 0;
    for frequency in [0.2, 0.3, 0.4, 0.6] {
        let parts = MachineParts::new(["x"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 0.05)
            .with_frequency(frequency)
            .with_force(0, 1, 1.0, 0.0)
            .with_joint("floor", &[1.0], 0.4, 0.4, 0.0)
            .with_stop("s", &[1.0], 0.3, stop(30.0, 2.0));
        let (block, exponents) = found(parts);
        let Verdict::Periodic(cycle) = &block.motion else { continue };
        let holds = cycle.events.iter().any(|event| event.kind == EventKind::Hold);
        assert_eq!(lost(&exponents), usize::from(holds), "{frequency}: {exponents:?}");
        held += usize::from(holds);
    }
    assert!(held > 0);
    // without restitution, and without a rest
    let parts = MachineParts::new(["x"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.1)
        .with_frequency(1.6)
        .with_force(0, 1, 0.0, 1.0)
        .with_rigid_stop("s", &[1.0], 0.1, 0.0);
    let (plastic, exponents) = found(parts);
    if let Verdict::Periodic(cycle) = &plastic.motion
        && !cycle.events.iter().any(|event| event.kind == EventKind::Stick)
    {
        assert!(lost(&exponents) >= 1, "{exponents:?}");
    }
}

/// Two stops that are struck at once beside each other: the exponents of the machine twice beside itself are those of it alone. What the stops
/// of one of them do to each other was shared with those of the other, and the largest exponent was 0.24 instead of 0.05.
#[test]
fn f42s_exponents_of_a_machine_beside_itself() {
    let parts = |copies: usize| {
        let names: Vec<String> = (0..2 * copies).map(|i| format!("x{i}")).collect();
        let mut parts = MachineParts::new(names).with_frequency(0.6);
        for k in 0..copies {
            let place = |x: f64, y: f64| {
                let mut direction = vec![0.0; 2 * copies];
                (direction[2 * k], direction[2 * k + 1]) = (x, y);
                direction
            };
            for i in 0..2 {
                let along = if i == 0 { place(1.0, 0.0) } else { place(0.0, 1.0) };
                parts = parts.with_mass(2 * k + i, 1.0).with_link(&along, 1.96, 0.0);
            }
            parts = parts
                .with_force(2 * k, 1, 0.616, 0.429)
                .with_rigid_stop(&format!("a{k}"), &place(0.868, 0.497), 0.0, 1.0)
                .with_rigid_stop(&format!("b{k}"), &place(0.868, -0.497), 0.0, 1.0);
        }
        let qdot = (0..2 * copies).map(|i| if i % 2 == 0 { -0.36 } else { 0.0 }).collect();
        (Machine::new(parts).unwrap(), Start { qdot, ..Start::default() })
    };
    let largest = |copies: usize| {
        let (machine, start) = parts(copies);
        let found = machine_exponents_while(&machine, &start, (2_000, 100), &|| true).unwrap().unwrap();
        found.exponents[0]
    };
    let (one, two) = (largest(1), largest(2));
    assert!((one.value - two.value).abs() < one.error + two.error, "{one:?} {two:?}");
}

/// Exponents in other units of time, mass and length: the same numbers per radian of the forcing, also where the differences of motions vanish
/// again and again and the measurement begins anew. Each beginning counted the unit of time.
#[test]
fn f42t_exponents_do_not_depend_on_units() {
    let measured = |mass: f64, length: f64, time: f64| {
        let (stiffness, force) = (mass / (time * time), mass * length / (time * time));
        let law = StopLaw::Compliant {
            stiffness: 47.6 * stiffness,
            damping: 0.0,
            preload: 0.75 * force,
            opening: Opening::Position,
        };
        let mut parts = MachineParts::new(["b1", "b2"]).with_frequency(0.669 / time);
        for (i, own) in [[1.0, 0.0], [0.0, 1.0]].iter().enumerate() {
            parts = parts
                .with_mass(i, mass)
                .with_link(own, stiffness, 0.1 * mass / time)
                .with_force(i, 1, 0.0, [0.81, 0.457][i] * force)
                .with_stop(&format!("s{i}"), own, 0.0, law);
        }
        let parts = parts.with_rigid_stop("c", &[1.0, -1.0], 0.0, 0.58);
        let watch = SettleOptions { chaos_after: 64, chaos_over: 250, ..SettleOptions::at_most(120) };
        let machine = Machine::new(parts).unwrap();
        let found = settle_machine(&machine, &Start::default(), &watch).unwrap().verdict;
        let Verdict::Undecided(Undecided { spectrum: Some(spectrum), .. }) = found else { panic!("{}", found.label()) };
        spectrum.exponents.iter().map(|of| of.value * time).collect::<Vec<f64>>()
    };
    let plain = measured(1.0, 1.0, 1.0);
    for (mass, length, time) in [(4.0, 0.5, 8.0), (4.0, 1.0, 1.0), (1.0, 1.0, 1.0 / 1024.0)] {
        for (one, other) in plain.iter().zip(measured(mass, length, time)) {
            assert!((one - other).abs() < 1e-6 * (1.0 + one.abs()) || one == &other, "{plain:?} {other} in {time}");
        }
    }
}

/// Rows of eight bodies on springs to the ground that collapse onto each other in turn, in some hundred impacts down to rounding errors.
/// Springs and dampers to the ground are as the masses, and what acts between bodies moves no mean, so the mean of the row is a damped
/// oscillator by itself, whatever strikes: $`e^{(-c/2 \pm i\omega)T}`$ are two of the multipliers. All were 0 once, because rounding errors
/// were divided by the speeds of the last impacts; and where the last impacts were below rounding, their number was in the label.
#[test]
fn f42aa_a_row_that_collapses_keeps_its_mean_motion() {
    for (restitution, frequency, stiffness, between, forces) in
        [(0.24, 2.08, 0.3, 2.01, [0.5, 0.388, 0.48, -0.804]), (0.3, 2.0, 0.5, 2.0, [0.5, 0.4, 0.5, -0.7])]
    {
        let mut parts = MachineParts::new((1..=8).map(|k| format!("b{k}"))).with_frequency(frequency);
        for i in 0..8 {
            let mass = if i == 3 || i == 4 { 0.5 } else { 1.0 };
            let ground = parts.along(i);
            let force = if i < 4 { forces[i] } else { -forces[7 - i] };
            parts =
                parts.with_mass(i, mass).with_link(&ground, stiffness * mass, 0.1 * mass).with_force(i, 1, 0.0, force);
        }
        for i in 1..8 {
            let mut along = vec![0.0; 8];
            (along[i - 1], along[i]) = (1.0, -1.0);
            parts = parts.with_link(&along, between, 0.05).with_rigid_stop(&format!("c{i}"), &along, 0.0, restitution);
        }
        let machine = Machine::new(parts).unwrap();
        let verdict = settle_machine(&machine, &Start::default(), &SettleOptions::default()).unwrap().verdict;
        let Verdict::Periodic(cycle) = verdict else { panic!("{}", verdict.label()) };
        assert!(cycle.label.to_string().starts_with("inf/"), "{}", cycle.label);
        let (omega, time) = ((stiffness - 0.0025_f64).sqrt(), cycle.period);
        let size = (-0.05 * time).exp();
        for sign in [1.0, -1.0] {
            let (re, im) = (size * (omega * time).cos(), sign * size * (omega * time).sin());
            let off = cycle.multipliers.iter().map(|of| (of.re - re).hypot(of.im - im)).fold(f64::INFINITY, f64::min);
            assert!(off < 1e-6, "{}: {re} {im} is no multiplier: {:?}", cycle.label, cycle.multipliers);
        }
    }
}

fn machine(law: StopLaw, gap: f64) -> Machine {
    let parts = MachineParts::new(["mass"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 0.05)
        .with_frequency(1.0 / 1.11)
        .with_force(0, 1, 0.0, 1.0);
    Machine::new(parts.with_stop("stop", &[1.0], gap, law)).unwrap()
}

/// An undamped soft stop changes no volume: the exponents sum to minus the structure's own damping, exactly.
#[test]
fn the_sum_of_exponents() {
    for (gap, stiffness) in [(0.0, 30.0), (2.0, 400.0), (2.6, 900.0)] {
        let law = StopLaw::Compliant { stiffness, damping: 0.0, preload: 0.0, opening: Opening::Force };
        let machine = machine(law, gap);
        let found = machine_exponents_while(&machine, &Start::default(), (5_000, 500), &|| true).unwrap().unwrap();
        let sum: f64 = found.exponents.iter().map(|exponent| exponent.value).sum();
        assert!((sum + 0.05).abs() < 1e-9, "{gap} {} {sum}", found.motion.label());
    }
}

#[test]
fn without_contacts_those_of_the_structure() {
    let machine = machine(StopLaw::Rigid { restitution: 0.5 }, 100.0);
    let found = machine_exponents_while(&machine, &Start::default(), (100, 100), &|| true).unwrap().unwrap();
    assert!(matches!(found.motion, Verdict::NoImpact(_)));
    assert!(found.exponents.iter().all(|exponent| (exponent.value + 0.025).abs() < 1e-12));
}

/// Those of a machine that is an oscillator are those of the oscillator, per unit of its time, and agree with those along the
/// machine's own motion: beside a body that nothing moves it is no oscillator.
#[test]
fn of_an_oscillator() {
    // the other body comes to rest faster than any neighbours of the oscillator do
    const ALONE: f64 = 20.0;
    let of = vibroimpact::scenario::U.oscillator();
    let (mass, stiffness, force) = (0.2, 5.0, 3.0);
    let machine = |names: &[&str]| {
        let mut along = vec![0.0; names.len()];
        along[0] = 1.0;
        let mut parts = MachineParts::new(names.iter().copied())
            .with_mass(0, mass)
            .with_link(&along, stiffness, 0.0)
            .with_frequency(of.beta() * 5.0)
            .with_force(0, 1, 0.0, force)
            .with_rigid_stop("stop", &along, of.gap() * force / stiffness, of.restitution());
        if names.len() > 1 {
            parts = parts.with_mass(1, 1.0).with_link(&[0.0, 1.0], 1000.0, 2.0 * ALONE);
        }
        Machine::new(parts).unwrap()
    };
    let found = |names: &[&str]| {
        machine_exponents_while(&machine(names), &Start::default(), (20_000, 1_000), &|| true).unwrap().unwrap()
    };
    let (found, own) = (found(&["mass"]), found(&["mass", "other"]));
    let expected = exponents(&of, vibroimpact::Start::at_rest(&of), &ExponentOptions::new(20_000, 1_000));
    assert_eq!((&*found.motion.label(), &*own.motion.label()), ("chaotic", "chaotic"));
    assert_eq!((found.exponents.len(), own.exponents.len()), (2, 4));
    assert!(own.exponents[2..].iter().all(|exponent| (exponent.value + ALONE).abs() < 1e-3), "{:?}", own.exponents);
    for ((one, other), want) in found.exponents.iter().zip(&own.exponents).zip(expected.exponents) {
        // the same motion to rounding, which chaos enlarges: within the bars of both
        assert!((one.value / 5.0 - want.value).abs() < want.error, "{one:?} {want:?}");
        assert!((one.error / 5.0 / want.error - 1.0).abs() < 0.5, "{one:?} {want:?}");
        assert!((one.value - other.value).abs() < one.error + other.error, "{one:?} {other:?}");
    }
    assert!((found.impact_rate.value / own.impact_rate.value - 1.0).abs() < 0.02);
}
