//! Quantities of machines: against those of the oscillator, the balance of energy and momentum, and fine waveforms.

use vibroimpact::events::{MachineEventKind, MachineLimits, MachineMotion, MachineSamples, MachineStart};
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::math::Matrix;
use vibroimpact::orbit::MachineCycle;
use vibroimpact::quantities::{
    MachinePart, MachineQuantities, MachineQuantity, Quantity, errors_of_verdict, machine_cycle_quantities,
    machine_quantities, of_verdict,
};
use vibroimpact::verdict::{MachineVerdict, SettleOptions, Verdict, settle, settle_machine};
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
fn as_of_oscillator(machine: &Machine, found: &MachineQuantities, quantity: Quantity) -> Option<f64> {
    let common = MachineQuantity::Common(quantity);
    let stops = || (0..machine.stops().len()).map(|j| found.get(MachinePart::Stop(j), common));
    Some(match quantity {
        Quantity::ImpactSpeedMean => return None,
        Quantity::ImpulseMax => stops().fold(0.0, f64::max),
        Quantity::ImpulsePerPeriod | Quantity::StickingFraction => stops().sum(),
        _ if MachinePart::Whole.quantities().contains(&common) => found.get(MachinePart::Whole, common),
        _ => found.get(MachinePart::Coordinate(0), common),
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
        let start = MachineStart { q: vec![Start::at_rest(&osc).x], ..MachineStart::default() };
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
            let tolerance =
                if chatter && quantity == Quantity::AccelerationMax { 1e-3 } else { tolerance };
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
    let verdict = settle_machine(&machine, &MachineStart::default(), &SettleOptions::default()).unwrap().verdict;
    assert!(matches!(verdict, MachineVerdict::Chaotic { .. }), "{}", verdict.label());
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
    let power = found.measured(MachinePart::Whole, MachineQuantity::Common(Quantity::Power));
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

fn settled(machine: &Machine) -> Option<MachineCycle> {
    let options = SettleOptions { chaos_over: 0, max_impacts: 1_500, ..SettleOptions::default() };
    match settle_machine(machine, &MachineStart::default(), &options).ok()?.verdict {
        MachineVerdict::Periodic(cycle) => Some(cycle),
        _ => None,
    }
}

fn number(machine: &Machine, found: &MachineQuantities, path: &str) -> f64 {
    found.value(machine, path).unwrap()
}

/// The work of all forces over a cycle is what is lost, and the momentum that stops, joints, springs and dampers take from
/// each coordinate is that of the constant force.
#[test]
fn energy_and_momentum_balance_on_random_cycles() {
    let mut numbers = Numbers(29);
    let (mut cycles, mut worst, mut least) = (0, 0.0_f64, 0.0_f64);
    let (mut rigid, mut soft, mut slid, mut moved, mut rested, mut chatters, mut belts) = (0, 0, 0, 0, 0, 0, 0);
    for case in 0..700 {
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
        let means: Vec<f64> =
            parts.coordinates.iter().map(|name| of(&format!("q.{name}.displacement_mean"))).collect();
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
    assert!(cycles > 200 && rigid > 40 && soft > 80 && slid > 40 && moved > 60 && rested > 10 && belts > 15, "too few");
}
