//! Quantities of machines: against those of the oscillator, the balance of energy and momentum, and fine waveforms.

use vibroimpact::events;
use vibroimpact::events::{Limits, Sample, Samples};
use vibroimpact::machine::{HarmonicMotion, ImpactLaw, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::{
    Quantity, errors_of_verdict,
    machine::{self, Part},
    machine_cycle_quantities, machine_quantities, of_verdict,
};
use vibroimpact::regime::ContactState;
use vibroimpact::verdict::{SettleOptions, Verdict, settle, settle_machine};
use vibroimpact::{Oscillator, Side, Start};

/// Numbers in [0, 1), the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / 4_294_967_296.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

fn of(osc: &Oscillator) -> Machine {
    let mut parts = MachineParts::new(["mass"])
        .with_mass(0, 1.0)
        .with_link(&[1.0], 1.0, 2.0 * osc.damping())
        .with_frequency(osc.beta())
        .with_force(0, 1, 0.0, 1.0);
    for (side, stop) in osc.stops() {
        parts = parts.with_rigid_stop(&format!("{side:?}"), &[side.sign()], stop.gap, stop.restitution);
    }
    Machine::new(parts).unwrap()
}

/// A quantity of the machine of one coordinate as that of the oscillator: what stops do is added up.
fn as_of_oscillator(machine: &Machine, found: &machine::Quantities, quantity: Quantity) -> Option<f64> {
    let stops = || (0..machine.stops().len()).map(|j| found.get(Part::Stop(j), quantity));
    Some(match quantity {
        Quantity::ImpactSpeedMean => return None,
        Quantity::ImpulseMax => stops().fold(0.0, f64::max),
        Quantity::ImpulsePerPeriod | Quantity::StickingFraction => stops().sum(),
        _ if Part::Whole.quantities().contains(&quantity) => found.get(Part::Whole, quantity),
        _ => found.get(Part::Coordinate(0), quantity),
    })
}

#[test]
fn one_coordinate_has_the_quantities_of_the_oscillator() {
    let mut numbers = Numbers(5);
    let mut systems = vec![
        // undamped, at resonance, sticking, and nearly without restitution
        Oscillator::new(1.0, 0.5, 0.6).unwrap(),
        Oscillator::from_inverse_beta(1.8, 0.25, 0.5).unwrap(),
        Oscillator::new(0.3, 0.2, 0.0).unwrap(),
        Oscillator::new(0.35, -0.3, 0.3).unwrap().with_damping(0.02).unwrap(),
        Oscillator::new(0.7, 0.4, 1.0).unwrap().with_damping(0.1).unwrap(),
        // the largest acceleration is that at the end of a chatter
        Oscillator::new(0.302_377, 0.3, 0.3807).unwrap().with_damping(0.02).unwrap(),
    ];
    for _ in 0..150 {
        let osc = Oscillator::new(numbers.between(0.2, 3.0), numbers.between(-0.6, 1.5), numbers.next()).unwrap();
        let osc = osc.with_damping(if numbers.next() < 0.3 { 0.0 } else { 0.4 * numbers.next() }).unwrap();
        systems.push(if numbers.next() < 0.4 {
            osc.with_second_stop(0.7 + numbers.next(), numbers.next()).unwrap()
        } else {
            osc
        });
    }
    let (mut compared, mut chatters, mut rests, mut two, mut quiet) = (0, 0, 0, 0, 0);
    for osc in systems {
        let expected = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
        if matches!(expected, Verdict::Chaotic(_) | Verdict::Undecided(_)) {
            continue;
        }
        let machine = of(&osc);
        let start = events::Start { q: vec![Start::at_rest(&osc).x], ..events::Start::default() };
        let verdict = settle_machine(&machine, &start, &SettleOptions::default()).unwrap().verdict;
        if verdict.label() != expected.label() {
            assert!(osc.damping() == 0.0 || verdict.label() == "undecided", "{osc:?} {}", verdict.label());
            continue;
        }
        let want = of_verdict(&osc, &expected).unwrap();
        let found = machine_quantities(&machine, &verdict).unwrap();
        let mut chatter = false;
        if let Verdict::Periodic(cycle) = &expected {
            chatter = cycle.rests.iter().any(|rest| rest.chatter);
            chatters += u32::from(chatter);
            rests += u32::from(!cycle.rests.is_empty());
            two += u32::from(osc.stop(Side::Lower).is_some());
        } else {
            quiet += 1;
        }
        // a chatter is summed from a later impact on than by the oscillator, and to a relative error of 1e-11
        let tolerance = if chatter { 1e-9 } else { 1e-11 };
        for (quantity, want) in want.iter() {
            let Some(found) = as_of_oscillator(&machine, &found, quantity) else { continue };
            // the oscillator takes the acceleration at the beginning of a chatter that is summed for all of it
            let tolerance = if chatter && quantity == Quantity::AccelerationMax { 1e-3 } else { tolerance };
            let same = found.is_nan() && want.is_nan() || found == want;
            assert!(
                same || (found - want).abs() <= tolerance * (1.0 + want.abs()),
                "{osc:?} {}: {quantity:?} {found:e} {want:e}, {:e}",
                expected.label(),
                found - want
            );
        }
        compared += 1;
    }
    println!("{compared} compared, {chatters} with chatter, {rests} with rest, {two} of two stops, {quiet} quiet");
    assert!(compared > 120 && chatters > 5 && rests > 10 && two > 30 && quiet > 5);
}

#[test]
fn chaos_has_the_quantities_of_the_oscillator_within_error_bars() {
    let osc = Oscillator::from_inverse_beta(1.11, 3.0, 0.5).unwrap();
    let machine = of(&osc);
    let expected = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
    let verdict = settle_machine(&machine, &events::Start::default(), &SettleOptions::default()).unwrap().verdict;
    assert!(matches!(verdict, Verdict::Chaotic(_)), "{}", verdict.label());
    let (want, errors) = (of_verdict(&osc, &expected).unwrap(), errors_of_verdict(&osc, &expected).unwrap());
    let found = machine_quantities(&machine, &verdict).unwrap();
    let mut compared = 0;
    for (quantity, want) in want.iter() {
        let Some(value) = as_of_oscillator(&machine, &found, quantity) else { continue };
        if !quantity.is_mean() {
            assert!((value / want - 1.0).abs() < 0.1, "{quantity:?} {value} {want}");
            continue;
        }
        assert!((value - want).abs() <= 2.0 * errors.get(quantity) + 1e-12, "{quantity:?} {value} {want}");
        compared += 1;
    }
    let power = found.measured(Part::Whole, Quantity::Power);
    let ratio = power.error / errors.get(Quantity::Power);
    assert!(compared > 12 && (0.3..3.0).contains(&ratio), "{compared} {ratio}");
}

/// A random machine of 1 to 4 coordinates: every kind of stop, some that move, a joint.
fn random(numbers: &mut Numbers, case: usize) -> Option<Machine> {
    let n = 1 + case % 4;
    let names: Vec<String> = (0..n).map(|i| format!("q{i}")).collect();
    let mut parts = MachineParts::new(names.iter().map(String::as_str)).with_frequency(numbers.between(0.4, 1.6));
    for i in 0..n {
        let mut along = vec![0.0; n];
        along[i] = 1.0;
        parts = parts.with_mass(i, numbers.between(0.5, 1.5)).with_link(
            &along,
            numbers.between(0.4, 1.4),
            numbers.between(0.02, 0.3),
        );
        parts = parts.with_force(i, 1, numbers.between(-0.5, 0.5), numbers.next());
        if i > 0 {
            along[i - 1] = -1.0;
            parts = parts.with_link(&along, numbers.between(0.4, 1.4), numbers.between(0.0, 0.2));
        }
    }
    if n > 1 {
        // coupled masses
        let coupling = numbers.between(-0.2, 0.2);
        (parts.mass[(0, 1)], parts.mass[(1, 0)]) = (coupling, coupling);
    }
    parts = parts.with_force(n - 1, 2, numbers.between(-0.3, 0.3), 0.0).with_constant(0, numbers.between(-0.3, 0.3));
    let mut soft = |damped: bool, preload: bool, opening| StopLaw::Compliant {
        stiffness: 10.0_f64.powf(numbers.between(0.7, 3.0)),
        damping: if damped { numbers.between(0.2, 2.0) } else { 0.0 },
        preload: if preload { numbers.between(0.05, 0.4) } else { 0.0 },
        opening,
    };
    let laws = [
        soft(false, false, Opening::Force),
        soft(true, false, Opening::Force),
        soft(true, true, Opening::Force),
        soft(true, true, Opening::Position),
    ];
    let kind = (case / 4) % 6;
    for k in 0..2 {
        let mut direction = vec![0.0; n];
        let at = (case / 24 + k) % n;
        direction[at] = if k == 0 { 1.0 } else { -1.0 };
        if n > 1 && numbers.next() < 0.4 {
            direction[(at + 1) % n] = if k == 0 { -1.0 } else { 1.0 };
        }
        let law = match (kind, k) {
            (0, _) | (5, 1) => StopLaw::Rigid { restitution: if numbers.next() < 0.2 { 0.0 } else { numbers.next() } },
            (kind, _) => laws[(kind - 1 + k) % 4],
        };
        parts = parts.with_stop(["a", "b"][k], &direction, numbers.between(0.1, 0.8), law);
        if numbers.next() < 0.5 {
            parts.stops[k].motion = vec![HarmonicMotion {
                order: if numbers.next() < 0.3 { 3 } else { 1 },
                cos: numbers.between(-0.15, 0.15),
                sin: numbers.between(-0.15, 0.15),
            }];
        }
    }
    if numbers.next() < 0.4 {
        let mut direction = vec![0.0; n];
        direction[n - 1] = 1.0;
        let sliding = numbers.between(0.02, 0.2);
        let belt = if numbers.next() < 0.5 { 0.0 } else { numbers.between(-0.4, 0.4) };
        parts = parts.with_joint("guide", &direction, sliding, sliding * numbers.between(1.0, 1.5), belt);
    }
    Machine::new(parts).ok()
}

/// Every quantity against sums over a waveform with very small steps, for the machines of the first cases.
#[test]
fn quantities_agree_with_a_fine_waveform() {
    let mut numbers = Numbers(3);
    let (mut compared, mut numbers_compared) = (0, 0);
    for case in 0..40 {
        let Some(machine) = random(&mut numbers, 7 * case) else { continue };
        let Some(cycle) = settled(&machine) else { continue };
        // chatters that are summed are told as rest, and a slow transient would blur the comparison
        if cycle.label.periods > 3 || cycle.label.to_string().starts_with("inf") || cycle.multipliers[0].modulus() > 0.9
        {
            continue;
        }
        let found = machine_cycle_quantities(&machine, &cycle).unwrap();
        for (path, value) in by_waveform(&machine, &cycle) {
            let exact = number(&machine, &found, &path);
            let largest = path.contains("_max") || path.contains("_min") || path.contains("amplitude");
            let tolerance = if largest { 5e-3 } else { 5e-4 };
            assert!(
                (exact - value).abs() <= tolerance * (1.0 + value.abs()),
                "case {case} {} {path}: {exact} {value}",
                cycle.label
            );
            numbers_compared += 1;
        }
        compared += 1;
    }
    println!("{compared} machines, {numbers_compared} numbers");
    assert!(compared >= 25 && numbers_compared > 500, "{compared} {numbers_compared}");
}

/// The largest integral of the force of a compliant stop over one contact; the wave is closed.
fn largest_contact(wave: &[Sample], j: usize) -> f64 {
    let pairs = wave.windows(2).filter(|pair| pair[1].time > pair[0].time);
    let twice = pairs.clone().chain(pairs);
    let closed = |sample: &Sample| sample.states[j] != ContactState::Open;
    let (mut now, mut most, mut opened) = (0.0, 0.0_f64, false);
    for pair in twice {
        if closed(&pair[0]) {
            now += 0.5 * (pair[1].time - pair[0].time) * (pair[0].forces[j] + pair[1].forces[j]);
        } else {
            most = most.max(if opened { now } else { 0.0 });
            (now, opened) = (0.0, true);
        }
    }
    most
}

/// Quantities from the samples of one period and from its events, by the trapezoidal rule.
fn by_waveform(machine: &Machine, cycle: &Cycle) -> Vec<(String, f64)> {
    let parts = machine.parts();
    let (n, stops) = (machine.n(), machine.stops().len());
    let periods = f64::from(cycle.label.periods);
    let span = (cycle.period, cycle.period / 6e3);
    let wave: Vec<_> = Samples::new(machine, &cycle.state, Limits::default(), span).unwrap().collect();
    let trapezoid = |of: &dyn Fn(&Sample) -> f64| -> f64 {
        wave.windows(2).map(|pair| 0.5 * (pair[1].time - pair[0].time) * (of(&pair[0]) + of(&pair[1]))).sum()
    };
    let most = |of: &dyn Fn(&Sample) -> f64| wave.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let mut all: Vec<(String, f64)> = Vec::new();
    for (i, name) in parts.coordinates.iter().enumerate() {
        let mut add = |what: &str, value| all.push((format!("q.{name}.{what}"), value));
        let (low, high) = (-most(&|s| -s.q[i]), most(&|s| s.q[i]));
        add("displacement_min", low);
        add("displacement_max", high);
        add("displacement_amplitude", 0.5 * (high - low));
        add("displacement_mean", trapezoid(&|s| s.q[i]) / cycle.period);
        add("displacement_rms", (trapezoid(&|s| s.q[i] * s.q[i]) / cycle.period).sqrt());
        add("velocity_max", most(&|s| s.qdot[i].abs()));
        let lower = parts.mass.cholesky().unwrap();
        let mobility = |force: Vec<f64>| lower.solve_lower_transposed(&lower.solve_lower(&force))[i];
        add("acceleration_max", most(&|s| mobility(super::samples::force(machine, s)).abs()));
        add("velocity_rms", (trapezoid(&|s| s.qdot[i] * s.qdot[i]) / cycle.period).sqrt());
    }
    for force in &parts.forces {
        let power = |s: &Sample| {
            let angle = f64::from(force.order) * s.phase;
            (0..n).map(|i| (force.cos[i] * angle.cos() + force.sin[i] * angle.sin()) * s.qdot[i]).sum::<f64>()
        };
        all.push((format!("force.{}.work_per_period", force.order), trapezoid(&power) / periods));
    }
    let drag =
        |s: &Sample| (0..n * n).map(|k| parts.damping[(k / n, k % n)] * s.qdot[k / n] * s.qdot[k % n]).sum::<f64>();
    all.push(("damping_loss_per_period".to_owned(), trapezoid(&drag) / periods));
    all.push(("damping_power".to_owned(), trapezoid(&drag) / cycle.period));
    for (j, stop) in parts.stops.iter().enumerate() {
        let mut add = |what: &str, value| all.push((format!("stop.{}.{what}", stop.name), value));
        let own = || cycle.events.iter().filter(move |event| event.closes() && event.place == j);
        let count = f64::from(u32::try_from(own().count()).unwrap());
        add("impacts_per_period", count / periods);
        add("impact_speed_max", own().map(|event| event.speed).fold(0.0, f64::max));
        if count > 0.0 {
            add("impact_speed_mean", own().map(|event| event.speed).sum::<f64>() / count);
        }
        // what an impact changes, from the states on both sides
        let (mut impulse, mut loss, mut work) = (0.0, 0.0, 0.0);
        let rate = |phase: f64| -> f64 {
            let harmonics = stop.motion.iter().map(|motion| (f64::from(motion.order), motion.cos, motion.sin));
            let of = |(h, cos, sin): (f64, f64, f64)| h * (sin * (h * phase).cos() - cos * (h * phase).sin());
            parts.frequency.unwrap() * harmonics.map(of).sum::<f64>()
        };
        if let StopLaw::Rigid { restitution } = stop.law {
            let lower = parts.mass.cholesky().unwrap().solve_lower(&stop.direction);
            let mass = 1.0 / lower.iter().map(|w| w * w).sum::<f64>();
            let alone = own().all(|event| event.with.is_empty());
            for event in own() {
                impulse += (1.0 + restitution) * mass * event.speed;
                loss += 0.5 * (1.0 - restitution * restitution) * mass * event.speed * event.speed;
                work += (1.0 + restitution) * mass * event.speed * rate(event.phase);
            }
            let hardest = own().map(|event| (1.0 + restitution) * mass * event.speed).fold(0.0, f64::max);
            if alone {
                add("impulse_max", hardest);
                add("impulse_per_period", impulse / periods);
                add("impact_loss_per_period", loss / periods);
                add("momentum_per_period", (impulse + trapezoid(&|s| s.forces[j])) / periods);
                add("work_per_period", (work + trapezoid(&|s| s.forces[j] * rate(s.phase))) / periods);
            }
        } else {
            add("momentum_per_period", trapezoid(&|s| s.forces[j]) / periods);
            add("work_per_period", trapezoid(&|s| s.forces[j] * rate(s.phase)) / periods);
            // the jump of a preload at its closing is resolved to a step
            add("force_max", most(&|s| s.forces[j]));
            add("impulse_max", largest_contact(&wave, j));
        }
        let part =
            |of: &dyn Fn(&ContactState) -> bool| trapezoid(&|s| f64::from(u8::from(of(&s.states[j])))) / cycle.period;
        add("sticking_fraction", part(&|state| *state == ContactState::Resting));
        add("contact_fraction", part(&|state| matches!(state, ContactState::Closed | ContactState::Resting)));
    }
    for (j, joint) in parts.joints.iter().enumerate() {
        let mut add = |what: &str, value| all.push((format!("friction.{}.{what}", joint.name), value));
        let slides = |s: &Sample| joint.direction.iter().zip(&s.qdot).map(|(w, v)| w * v).sum::<f64>() - joint.belt;
        add("friction_loss_per_period", trapezoid(&|s| s.forces[stops + j] * slides(s)) / periods);
        add("work_per_period", -joint.belt * trapezoid(&|s| s.forces[stops + j]) / periods);
        add("momentum_per_period", trapezoid(&|s| s.forces[stops + j]) / periods);
        add("force_max", most(&|s| s.forces[stops + j].abs()));
        let holds = |s: &Sample| f64::from(u8::from(s.states[stops + j] == ContactState::Holding));
        add("holding_fraction", trapezoid(&holds) / cycle.period);
    }
    all
}

fn settled(machine: &Machine) -> Option<Cycle> {
    let options = SettleOptions { chaos_over: 0, max_impacts: 1_500, ..SettleOptions::default() };
    match settle_machine(machine, &events::Start::default(), &options).ok()?.verdict {
        Verdict::Periodic(cycle) => Some(cycle),
        _ => None,
    }
}

fn number(machine: &Machine, found: &machine::Quantities, path: &str) -> f64 {
    found.value(machine, path).unwrap()
}

/// A free pair of bodies on a shaking table, rigid or soft: the table gives them the momentum that gravity takes, and its
/// work is what they lose.
#[test]
fn the_momentum_of_free_bodies() {
    let mut numbers = Numbers(77);
    let mut cycles = 0;
    for case in 0..60 {
        let (gravity, mass, frequency) = (1.0, numbers.between(0.2, 2.0), numbers.between(1.0, 4.0));
        let mut parts = MachineParts::new(["lower", "upper"])
            .with_mass(0, 1.0)
            .with_mass(1, mass)
            .with_constant(0, -gravity)
            .with_constant(1, -gravity * mass)
            .with_frequency(frequency)
            .with_link(&[1.0, -1.0], numbers.between(20.0, 400.0), numbers.between(0.5, 4.0));
        let law = if case % 2 == 0 {
            StopLaw::Rigid { restitution: 0.4 * numbers.next() }
        } else {
            StopLaw::Compliant { stiffness: 4e3, damping: 30.0, preload: 0.0, opening: Opening::Force }
        };
        parts = parts.with_stop("table", &[-1.0, 0.0], 0.0, law);
        let shake = numbers.between(1.1, 3.5) / (frequency * frequency);
        parts.stops[0].motion = vec![HarmonicMotion { order: 1, cos: 0.0, sin: shake }];
        let machine = Machine::new(parts).unwrap();
        let Some(cycle) = settled(&machine) else { continue };
        let found = machine_cycle_quantities(&machine, &cycle).unwrap();
        let of = |path: &str| number(&machine, &found, path);
        let given = of("stop.table.momentum_per_period");
        let taken = gravity * (1.0 + mass) * machine.period().unwrap();
        assert!((given / taken - 1.0).abs() < 1e-11, "{case} {}: {given} {taken}", cycle.label);
        let lost = of("impact_loss_per_period") + of("contact_loss_per_period") + of("damping_loss_per_period");
        let work = of("stop.table.work_per_period");
        assert!((work / lost - 1.0).abs() < 1e-11, "{case} {}: {work} {lost}", cycle.label);
        cycles += 1;
    }
    assert!(cycles > 15, "{cycles}");
}

/// The work per period and the sum of these losses.
fn balance(machine: &Machine, found: &machine::Quantities, losses: &[&str]) -> (f64, f64) {
    let of = |path: &str| number(machine, found, path);
    (of("work_per_period"), losses.iter().map(|kind| of(&format!("{kind}_loss_per_period"))).sum())
}

/// Impacts in turn that end in rest or in a common velocity, and collapses of three bodies at rest and on a moving table: what is lost is
/// the work.
#[test]
fn impacts_in_turn_and_collapses_balance() {
    let row = |mass: &[f64], stops: &[(f64, f64)]| {
        let n = mass.len();
        let parts = MachineParts::new(["a", "b", "c"].into_iter().take(n));
        let parts = mass.iter().enumerate().fold(parts, |parts, (k, mass)| parts.with_mass(k, *mass));
        let along = |k: usize| -> Vec<f64> {
            (0..n).map(|i| f64::from(u8::from(i + 1 == k)) - f64::from(u8::from(i == k))).collect()
        };
        let names = ["floor", "ab", "bc"].into_iter().zip(stops).enumerate();
        names.fold(parts, |parts, (k, (name, (gap, e)))| parts.with_rigid_stop(name, &along(k), *gap, *e))
    };
    let mut dropped = row(&[1.0, 1.0], &[(0.0, 0.5), (0.1, 0.4)]).with_constant(0, -5.0).with_frequency(1.0);
    dropped.impacts = ImpactLaw::InTurn;
    let dropped = dropped.with_link(&[0.0, 1.0], 1.0, 0.1).with_force(1, 1, 0.0, 1.0);
    let cover =
        row(&[0.1, 2.0, 0.1], &[(0.19, 0.75), (0.0, 0.1), (0.0, 0.0)]).with_constant(0, 0.05).with_constant(1, -2.8);
    let cover = cover.with_link(&[0.0, 1.0, 0.0], 20.0, 0.4).with_link(&[0.0, 0.0, 1.0], 5.3, 0.01);
    let cover = cover.with_frequency(5.16).with_force(1, 1, 0.0, 58.2);
    let mut table = row(&[1.0; 3], &[(0.1, 0.1), (0.1, 0.0), (0.0, 0.088)]).with_frequency(0.611);
    table.stops[0].motion.push(HarmonicMotion { order: 1, cos: 0.0, sin: 1.447 });
    let table = [(0.323, 0.031), (2.297, 0.093), (1.991, 0.033)].into_iter().enumerate().fold(
        table,
        |parts, (k, (stiffness, damping))| {
            let along = parts.along(k);
            parts.with_link(&along, stiffness, damping)
        },
    );
    let table = table.with_joint("rub", &[1.0, 0.0, 0.0], 0.027, 0.027, 0.0);
    for (name, parts) in [("dropped", dropped), ("cover", cover), ("table", table)] {
        let machine = Machine::new(parts).unwrap();
        let cycle = settled(&machine).unwrap_or_else(|| panic!("{name} has no cycle"));
        let found = machine_cycle_quantities(&machine, &cycle).unwrap();
        let (work, lost) = balance(&machine, &found, &["impact", "friction", "damping"]);
        assert!((work / lost - 1.0).abs() < 1e-9, "{name} {}: {work} {lost}", cycle.label);
    }
}

/// Structures without modes, stops 1e8 times stiffer than the structure, stiff links, overdamped modes: energy and momentum
/// balance all the same.
#[test]
fn stiff_and_defective_machines() {
    let base = |damping: f64, stiffness: f64| {
        MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 1.0)
            .with_link(&[1.0, 0.0], 1.0, damping)
            .with_link(&[0.0, 1.0], stiffness, 0.05)
            .with_frequency(0.8)
            .with_force(1, 1, 0.7, 0.9)
    };
    let soft = |stiffness, damping| StopLaw::Compliant { stiffness, damping, preload: 0.0, opening: Opening::Force };
    let machines = [
        // the eigenvalues of both modes meet
        base(0.595_126_65, 0.912_081_07).with_link(&[1.0, -1.0], 0.3, 0.0).with_rigid_stop(
            "wall",
            &[0.0, 1.0],
            0.4,
            0.6,
        ),
        base(0.1, 1.0).with_link(&[1.0, -1.0], 0.7, 0.02).with_stop("wall", &[1.0, 0.0], 0.2, soft(1e8, 0.0)),
        base(0.1, 1.0).with_link(&[1.0, -1.0], 0.7, 0.02).with_stop("wall", &[1.0, 0.0], 0.2, soft(1e8, 3e3)),
        base(0.1, 1.0).with_link(&[1.0, -1.0], 1e6, 60.0).with_rigid_stop("wall", &[1.0, 0.0], 0.2, 0.5),
        base(40.0, 1.0).with_link(&[1.0, -1.0], 3.0, 0.0).with_rigid_stop("wall", &[0.0, 1.0], 0.2, 0.5),
    ];
    for (case, parts) in machines.into_iter().enumerate() {
        let machine = Machine::new(parts).unwrap();
        let cycle = settled(&machine).unwrap_or_else(|| panic!("machine {case} has no cycle"));
        let found = machine_cycle_quantities(&machine, &cycle).unwrap();
        let of = |path: &str| number(&machine, &found, path);
        let (work, lost) = balance(&machine, &found, &["impact", "contact", "damping"]);
        // a stiff link stores what a cycle misses to close
        let tolerance = 1e-11 + 10.0 * cycle.residual;
        assert!((work / lost - 1.0).abs() < tolerance, "machine {case} {}: {:e}", cycle.label, work / lost - 1.0);
        assert!(of("stop.wall.impulse_per_period") > 0.0 && of("q.a.acceleration_max") > 0.0, "machine {case}");
    }
}

/// The work of all forces over a cycle is what is lost, and the momentum that stops, joints, springs and dampers take from
/// each coordinate is that of the constant force.
#[test]
fn energy_and_momentum_balance_on_random_cycles() {
    let mut numbers = Numbers(29);
    let (mut cycles, mut worst, mut least) = (0, 0.0_f64, 0.0_f64);
    let (mut rigid, mut soft, mut slid, mut moved, mut rested, mut chatters, mut belts) = (0, 0, 0, 0, 0, 0, 0);
    for case in 0..240 {
        let Some(machine) = random(&mut numbers, case) else { continue };
        let Some(cycle) = settled(&machine) else { continue };
        let found = machine_cycle_quantities(&machine, &cycle).unwrap();
        let of = |path: &str| number(&machine, &found, path);
        let lost = ["impact", "contact", "friction", "damping"].map(|kind| of(&format!("{kind}_loss_per_period")));
        let work = of("work_per_period");
        let total: f64 = lost.iter().sum();
        let size = total + work.abs() + 1e-3;
        let imbalance = (work - total) / size;
        assert!(imbalance.abs() < 1e-11, "case {case} {}: {imbalance:e} of {lost:?}, {work}", cycle.label);
        assert!(lost.iter().all(|loss| *loss >= 0.0), "{lost:?}");
        worst = worst.max(imbalance.abs());
        // K mean(q) + sum of momenta / T = constant force, for every coordinate; dampers take none
        let (parts, period) = (machine.parts(), machine.period().unwrap());
        let means: Vec<f64> = parts.coordinates.iter().map(|name| of(&format!("q.{name}.displacement_mean"))).collect();
        for i in 0..machine.n() {
            let (mut sum, mut size) = (parts.constant[i], 1.0);
            for (j, mean) in means.iter().enumerate() {
                sum -= parts.stiffness[(i, j)] * mean;
                size += (parts.stiffness[(i, j)] * mean).abs();
            }
            let stops = parts.stops.iter().map(|stop| (format!("stop.{}", stop.name), stop.direction[i]));
            let joints = parts.joints.iter().map(|joint| (format!("friction.{}", joint.name), joint.direction[i]));
            for (part, w) in stops.chain(joints) {
                let push = w * of(&format!("{part}.momentum_per_period")) / period;
                sum -= push;
                size += push.abs();
            }
            assert!(sum.abs() < 1e-11 * size, "case {case} {}: coordinate {i}, {sum:e}", cycle.label);
            least = least.max(sum.abs() / size);
        }
        let has = |name: &str| cycle.events.iter().any(|event| event.kind.name() == name);
        rigid += u32::from(lost[0] > 0.0);
        soft += u32::from(has("open"));
        slid += u32::from(lost[2] > 0.0);
        moved += u32::from(parts.stops.iter().any(|stop| of(&format!("stop.{}.work_per_period", stop.name)) != 0.0));
        rested += u32::from(has("stick"));
        belts += u32::from(!parts.joints.is_empty() && of("friction.guide.work_per_period") != 0.0);
        chatters += u32::from(of("impacts_per_period").is_infinite());
        cycles += 1;
    }
    println!(
        "{cycles} cycles: energy {worst:e}, momentum {least:e}; rigid {rigid}, soft {soft}, friction {slid}, moving \
         {moved}, rest {rested}, chatter {chatters}, belts {belts}"
    );
    assert!(
        cycles > 200 && rigid > 40 && soft > 80 && slid > 40 && moved > 60 && rested > 10 && chatters > 5 && belts > 15
    );
}
