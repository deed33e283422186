//! Quantities of random attractors: the energy balance, and every quantity against a fine waveform.

use vibroimpact::chaos::{ExponentOptions, Tail, exponents};
use vibroimpact::lanes::Width;
use vibroimpact::motion::{EventKind, Motion};
use vibroimpact::quantities::{
    MEASURED_IMPACTS, Quantities, Quantity, cycle_segments, errors_of_verdict, harmonics, of_arrivals, of_cycle,
    of_transient, of_verdict, of_verdict_only,
};
use vibroimpact::verdict::{
    Chaos, KnownAttractors, SettleOptions, StartBox, Verdict, scattered_starts, settle, settle_many,
};
use vibroimpact::{Oscillator, Start};

/// Numbers in [0, 1), the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / 4_294_967_296.0
    }
}

/// A random oscillator: with and without damping and a second stop, any restitution, preloaded or not.
fn random(numbers: &mut Numbers) -> Oscillator {
    let beta = 0.2 * 20.0_f64.powf(numbers.next());
    let gap = 3.0 * numbers.next() - 1.2;
    let restitution = match numbers.next() {
        kind if kind < 0.125 => 0.0,
        kind if kind < 0.25 => 1.0,
        _ => numbers.next(),
    };
    let damping = if numbers.next() < 0.4 { 0.0 } else { 2.0 * numbers.next().powi(4) };
    let osc = Oscillator::new(beta, gap, restitution).unwrap().with_damping(damping).unwrap();
    if numbers.next() < 0.3 { osc.with_second_stop(gap.abs() + numbers.next(), numbers.next()).unwrap() } else { osc }
}

/// Work of the force less both losses, relative to the energies in play.
fn imbalance(found: &Quantities) -> f64 {
    let [work, impacts, damper] =
        [Quantity::WorkPerPeriod, Quantity::ImpactLossPerPeriod, Quantity::DampingLossPerPeriod].map(|q| found.get(q));
    (work - impacts - damper) / (1.0 + impacts + damper)
}

#[test]
fn work_is_lost_in_impacts_and_damper_for_a_thousand_attractors() {
    let mut numbers = Numbers(17);
    let (mut sticking, mut chatter, mut undamped, mut two, mut count) = (0, 0, 0, 0, 0);
    let mut worst = 0.0_f64;
    while count < 1000 {
        let osc = random(&mut numbers);
        let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
        let Verdict::Periodic(cycle) = &settled.verdict else { continue };
        let found = of_cycle(&osc, cycle).unwrap_or_else(|| panic!("{osc:?}: no quantities of {}", cycle.label));
        let error = imbalance(&found).abs();
        assert!(error < 1e-12, "{osc:?} {}: {error:e}", cycle.label);
        worst = worst.max(error);
        count += 1;
        sticking += u32::from(!cycle.rests.is_empty());
        chatter += u32::from(cycle.rests.iter().any(|rest| rest.chatter));
        undamped += u32::from(osc.damping() == 0.0);
        two += u32::from(osc.stop(vibroimpact::Side::Lower).is_some());
    }
    println!("worst {worst:e}; sticking {sticking}, chatter {chatter}, undamped {undamped}, two stops {two}");
    assert!(sticking > 50 && chatter > 30 && undamped > 150 && two > 100, "{sticking} {chatter} {undamped} {two}");
}

/// All quantities from a fine waveform by the trapezoidal rule, over whole periods of the settled motion.
#[test]
fn quantities_agree_with_a_fine_waveform() {
    let mut numbers = Numbers(3);
    let mut count = 0;
    while count < 60 {
        let osc = random(&mut numbers);
        let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
        let Verdict::Periodic(cycle) = &settled.verdict else { continue };
        // a slow transient would blur the comparison
        if cycle.multipliers[0].modulus() > 0.9 {
            continue;
        }
        count += 1;
        let exact = of_cycle(&osc, cycle).unwrap();
        let start = match (cycle.rests.last(), cycle.points.first()) {
            (Some(rest), _) => Motion::released(&osc, rest.side),
            (None, Some(point)) => Motion::after(&osc, &point.state, Default::default()),
            _ => continue,
        };
        let total = f64::from(cycle.label.periods) * osc.period();
        let (mut motion, mut time) = (start, 0.0);
        let (mut places, mut squares, mut speeds, mut work, mut resting) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut lowest, mut highest, mut fastest, mut hard) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64, 0.0_f64);
        let (mut loss, mut impulse, mut hardest) = (0.0, 0.0, 0.0_f64);
        let (mut arrivals, mut count_of_impacts, mut largest) = (0.0, 0.0, 0.0_f64);
        let mut impact = |u: f64, v: f64| {
            loss += 0.5 * (u * u - v * v);
            impulse += u - v;
            hardest = hardest.max(u - v);
            (arrivals, count_of_impacts, largest) = (arrivals + u, count_of_impacts + 1.0, largest.max(u));
        };
        if let (true, Some(point)) = (cycle.rests.is_empty(), cycle.points.first()) {
            let stop = osc.stop(point.state.side).unwrap();
            impact(point.state.velocity, -stop.restitution * point.state.velocity);
            fastest = fastest.max(point.state.velocity);
        }
        while time < total * (1.0 - 1e-9) {
            let event = motion.next().expect("a cycle goes on");
            let leg = *motion.leg().unwrap();
            let n = 2000_u32;
            let h = leg.duration / f64::from(n);
            for k in 0..=n {
                let s = h * f64::from(k);
                let (x, v) = leg.state(&osc, s);
                let force = (leg.phase + osc.beta() * s).sin();
                let weight = if k == 0 || k == n { 0.5 * h } else { h };
                places += weight * x;
                squares += weight * x * x;
                speeds += weight * v * v;
                work += weight * force * v;
                (lowest, highest, fastest) = (lowest.min(x), highest.max(x), fastest.max(v.abs()));
                let moves = leg.state(&osc, 0.5 * leg.duration).1 != 0.0;
                if moves {
                    hard = hard.max((force - x - 2.0 * osc.damping() * v).abs());
                } else {
                    resting += weight;
                }
            }
            time += leg.duration;
            if let EventKind::Impact { velocity_before, velocity_after } = event.kind
                && time < total * (1.0 - 1e-9)
            {
                impact(velocity_before, velocity_after);
            }
        }
        let periods = f64::from(cycle.label.periods);
        let near = |quantity: Quantity, value: f64, tolerance: f64| {
            let found = exact.get(quantity);
            assert!((found - value).abs() < tolerance * (1.0 + value.abs()), "{osc:?} {quantity:?}: {found} {value}");
        };
        let chatters = cycle.rests.iter().any(|rest| rest.chatter);
        near(Quantity::DisplacementMean, places / total, 1e-4);
        near(Quantity::DisplacementAmplitude, 0.5 * (highest - lowest), 1e-4);
        near(Quantity::DisplacementRms, (squares / total).sqrt(), 1e-4);
        near(Quantity::VelocityRms, (speeds / total).sqrt(), 1e-4);
        near(Quantity::WorkPerPeriod, work / periods, 1e-3);
        near(Quantity::Power, work / total, 1e-3);
        near(Quantity::DampingLossPerPeriod, 2.0 * osc.damping() * speeds / periods, 1e-3);
        near(Quantity::DampingPower, 2.0 * osc.damping() * speeds / total, 1e-3);
        // the replay counts the summed part of a chatter as rest
        near(Quantity::StickingFraction, resting / total, if chatters { 1e-4 } else { 1e-8 });
        near(Quantity::DisplacementMin, lowest, 1e-4);
        near(Quantity::DisplacementMax, highest, 1e-4);
        near(Quantity::VelocityMax, fastest, 1e-4);
        near(Quantity::ImpactLossPerPeriod, loss / periods, 1e-6);
        near(Quantity::ImpactPower, loss / total, 1e-6);
        near(Quantity::ImpactSpeedMax, largest, 1e-8);
        near(Quantity::ImpulseMax, hardest, 1e-8);
        // the impulses of the summed part of a chatter are not among those listed
        near(Quantity::ImpulsePerPeriod, impulse / periods, if chatters { 0.05 } else { 1e-8 });
        if !chatters {
            near(Quantity::AccelerationMax, hard, 2e-3);
            near(Quantity::ImpactsPerPeriod, count_of_impacts / periods, 1e-12);
            near(Quantity::ImpactRate, count_of_impacts / total, 1e-8);
            if count_of_impacts > 0.0 {
                near(Quantity::ImpactSpeedMean, arrivals / count_of_impacts, 1e-8);
            }
        }
    }
}

/// Chaos that ends after the verdict in ever gentler impacts and grazing contacts has the quantities of the impacts before
/// the verdict.
#[test]
fn chaos_that_ends_in_grazing_contacts() {
    let osc = Oscillator::new(0.5, 0.998_319_288_924_331_5, 0.920_639_422_999_646_9).unwrap();
    let start = Start::new(&osc, 0.0, 0.0, 2.979_927_068_960_900_5).unwrap();
    let options = ExponentOptions { impacts: 1000, transient: 100, ..ExponentOptions::default() };
    let measured = exponents(&osc, start, &options);
    let Verdict::Chaotic(chaos) = &measured.motion else { panic!("{measured:?}") };
    assert_eq!(chaos.tail.impacts, 1000);
    let found = of_verdict(&osc, &measured.motion).unwrap();
    let rate = measured.impact_rate.value * osc.period();
    assert!((found.get(Quantity::ImpactsPerPeriod) - rate).abs() < 1e-9 * rate);
}

/// The tail of a chaotic motion ends with the last impact that was measured, bit for bit, however the motion was followed.
#[test]
fn the_tail_of_chaos_ends_with_its_last_impact() {
    let mut count = 0;
    for (inverse, gap, restitution, damping) in [(1.11, 3.0, 0.5, 0.0), (1.8, 1.3, 0.5, 0.02), (1.87, 1.43, 0.5, 0.02)]
    {
        let osc = Oscillator::from_inverse_beta(inverse, gap, restitution).unwrap().with_damping(damping).unwrap();
        let options = SettleOptions::default();
        let start = |k: u64| scattered_starts(&osc, StartBox::natural(&osc), 1, k);
        let many = settle_many(&osc, 0..40, &start, &KnownAttractors::default(), &options, Width::best(), &|| false);
        let single = settle(&osc, Start::at_rest(&osc), &options).verdict;
        let long = [300, 3000].map(|n| exponents(&osc, Start::at_rest(&osc), &ExponentOptions::new(n, 500)).motion);
        let verdicts = many.motions.into_iter().map(|found| found.verdict).chain([single]).chain(long);
        for verdict in verdicts {
            let Verdict::Chaotic(Chaos { tail: tail @ Tail { last, .. }, .. }) = verdict else { continue };
            let mut motion = Motion::after(&osc, &tail.from, Default::default());
            let impacts = motion.by_ref().filter_map(|event| match event.kind {
                EventKind::Impact { velocity_before, .. } => Some((event.phase, velocity_before)),
                _ => None,
            });
            let reached = impacts.take(usize::try_from(tail.impacts).unwrap()).last();
            assert_eq!(reached, Some((last.phase, last.velocity)), "{osc:?}");
            assert!(tail.impacts == MEASURED_IMPACTS || tail.impacts == 300);
            count += 1;
        }
    }
    assert!(count >= 6, "{count}");
}

/// The impacts that a settlement of few starts keeps give the quantities of the motion that is followed again, bit for
/// bit; with many starts, which are followed in lanes, nothing is kept.
#[test]
fn kept_impacts_give_the_same_quantities() {
    let (mut kept, mut chaotic) = (0, 0);
    for (inverse, gap, restitution, damping, lower) in [
        (1.11, 3.0, 0.5, 0.0, None),
        (1.8, 1.3, 0.5, 0.02, None),
        (1.87, 1.43, 0.5, 0.02, None),
        (1.9, 0.4, 0.9, 0.01, Some(0.6)),
        (1.3, 1.6, 0.8, 0.0, None),
        (0.9, 2.2, 0.7, 0.6, None),
    ] {
        let mut osc = Oscillator::from_inverse_beta(inverse, gap, restitution).unwrap().with_damping(damping).unwrap();
        if let Some(gap) = lower {
            osc = osc.with_second_stop(gap, 0.8).unwrap();
        }
        let options = SettleOptions::default();
        let start = |k: u64| scattered_starts(&osc, StartBox::natural(&osc), 1, k);
        for count in [1, 12, 40] {
            let none = KnownAttractors::default();
            let many = settle_many(&osc, 0..count, &start, &none, &options, Width::best(), &|| false);
            assert_eq!(many.motions.len(), many.tails.len());
            for (motion, tail) in many.motions.iter().zip(&many.tails) {
                let asked =
                    [&Quantity::ALL[..], &[Quantity::ImpactSpeedMax], &[Quantity::VelocityMax, Quantity::Power]];
                for asked in asked {
                    let whole = of_verdict_only(&osc, &motion.verdict, asked);
                    let found = of_arrivals(&osc, &motion.verdict, tail, asked);
                    assert_eq!(whole.is_some(), found.is_some());
                    for (whole, found) in whole.into_iter().zip(found) {
                        let bits = |of: Quantities| of.iter().map(|(_, value)| value.to_bits()).collect::<Vec<_>>();
                        assert_eq!(bits(whole), bits(found), "{osc:?} {asked:?}");
                    }
                }
                let Verdict::Chaotic(chaos) = &motion.verdict else {
                    assert!(tail.is_empty());
                    continue;
                };
                assert!(tail.is_empty() || tail.len() as u64 == chaos.tail.impacts);
                (chaotic, kept) = (chaotic + 1, kept + usize::from(!tail.is_empty()));
            }
        }
    }
    assert!(kept >= 6 && chaotic > kept, "{kept} of {chaotic}");
}

/// A quantity that is computed alone has the value that it has among all.
#[test]
fn each_quantity_alone() {
    let mut numbers = Numbers(11);
    let (mut chaotic, mut count) = (0, 0);
    while count < 60 || chaotic < 5 {
        let osc = random(&mut numbers);
        let verdict = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
        let Some(all) = of_verdict(&osc, &verdict) else { continue };
        count += 1;
        chaotic += u32::from(matches!(verdict, Verdict::Chaotic(_)));
        for (quantity, value) in all.iter() {
            let alone = of_verdict_only(&osc, &verdict, &[quantity]).unwrap().get(quantity);
            // the order of the search for several extremes changes their rounding errors
            let near = (alone - value).abs() <= 1e-14 * (1.0 + value.abs());
            assert!(near || alone.to_bits() == value.to_bits(), "{osc:?} {quantity:?}: {alone} {value}");
        }
    }
}

/// Sums over impacts alone are the same numbers as among all quantities.
#[test]
fn sums_over_impacts_alone() {
    let mut numbers = Numbers(5);
    for _ in 0..100 {
        let osc = random(&mut numbers);
        let verdict = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
        let all = of_verdict(&osc, &verdict);
        let some = of_verdict_only(&osc, &verdict, &[Quantity::ImpactSpeedMax, Quantity::ImpactPower]);
        assert_eq!(all.is_some(), some.is_some());
        for (quantity, value) in all.iter().flat_map(Quantities::iter).filter(|(quantity, _)| quantity.of_impacts()) {
            assert_eq!(some.unwrap().get(quantity).to_bits(), value.to_bits(), "{osc:?} {quantity:?}");
        }
    }
}

/// At huge and tiny frequency ratios the sums over impacts are known, and nothing takes long.
#[test]
fn huge_and_tiny_frequency_ratios() {
    for (beta, gap, restitution) in
        [(1e9, -1e-18, 0.0), (3e5, -0.2, 0.5), (1e-7, 0.3, 0.6), (1e-3, 0.3, 0.6), (300.0, 0.0, 0.7)]
    {
        let osc = Oscillator::new(beta, gap, restitution).unwrap().with_damping(0.01).unwrap();
        let verdict = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
        let Some(found) = of_verdict(&osc, &verdict) else { continue };
        assert!(!found.get(Quantity::ImpactLossPerPeriod).is_nan(), "beta {beta}: {verdict:?}");
        if found.get(Quantity::WorkPerPeriod).is_finite() && matches!(verdict, Verdict::Periodic(_)) {
            assert!(imbalance(&found).abs() < 1e-11, "beta {beta}: {}", imbalance(&found));
        }
    }
}

/// Parseval: the harmonics of a motion carry its mean square.
#[test]
fn harmonics_carry_the_mean_square() {
    for (inverse, gap, damping, label) in
        [(1.8, 0.25, 0.0, "4/1"), (0.6, 0.75, 0.02, "1/1"), (1.11, -0.5, 0.0, "inf/1")]
    {
        let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap().with_damping(damping).unwrap();
        let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
        let Verdict::Periodic(cycle) = &settled.verdict else { panic!("{label} is periodic") };
        assert_eq!(cycle.label.to_string(), label);
        let exact = of_cycle(&osc, cycle).unwrap();
        let mean = exact.get(Quantity::DisplacementMean);
        let carried: f64 = harmonics(&osc, cycle, 400).unwrap().iter().map(|h| 0.5 * h.amplitude * h.amplitude).sum();
        let square = exact.get(Quantity::DisplacementRms).powi(2);
        // x has corners at impacts, so its amplitudes fall as 1/k^2 and what is left out as 1/k^3
        assert!((mean * mean + carried - square).abs() < 1e-7, "{label}: {} {square}", mean * mean + carried);
        let time: f64 = cycle_segments(&osc, cycle).unwrap().iter().map(|part| part.duration()).sum();
        assert!((time / osc.period() - f64::from(cycle.label.periods)).abs() < 1e-12);
    }
}

#[test]
fn other_verdicts() {
    let options = SettleOptions::default();
    let of = |osc: &Oscillator| {
        let start = Start::at_rest(osc);
        of_verdict(osc, &settle(osc, start, &options).verdict)
    };
    // damped and clear of the stop: amplitude |f|, and the damper takes pi c w X^2
    let clear = Oscillator::new(0.7, 5.0, 0.5).unwrap().with_damping(0.1).unwrap();
    let found = of(&clear).unwrap();
    let amplitude = clear.free_amplitude();
    assert!((found.get(Quantity::DisplacementMax) - amplitude).abs() < 1e-14 * amplitude);
    let loss = std::f64::consts::PI * 0.2 * 0.7 * amplitude * amplitude;
    assert!((found.get(Quantity::DampingLossPerPeriod) - loss).abs() < 1e-13);
    assert_eq!(found.get(Quantity::ImpactsPerPeriod), 0.0);
    assert!(found.get(Quantity::ImpactSpeedMean).is_nan());
    // held on the stop
    let held = of(&Oscillator::new(0.9, -1.5, 0.5).unwrap()).unwrap();
    assert_eq!((held.get(Quantity::StickingFraction), held.get(Quantity::DisplacementRms)), (1.0, 1.5));
    // chaos: the balance holds up to the change of energy between both ends
    let chaos = Oscillator::from_inverse_beta(1.11, 3.0, 0.5).unwrap();
    let found = of(&chaos).unwrap();
    assert!(imbalance(&found).abs() < 0.02 && found.get(Quantity::ImpactLossPerPeriod) > 0.1);
    // the way from the start reaches at least what the motion does in the end
    let n = Oscillator::from_inverse_beta(1.8, 0.25, 0.5).unwrap();
    let settled = settle(&n, Start::at_rest(&n), &options);
    let way = of_transient(&n, Start::at_rest(&n), settled.impacts);
    let end = of_verdict(&n, &settled.verdict).unwrap();
    assert!(way.get(Quantity::ImpactSpeedMax) > end.get(Quantity::ImpactSpeedMax) - 1e-6);
}

#[test]
fn only_chaos_has_error_bars() {
    let osc = Oscillator::from_inverse_beta(1.8, 0.25, 0.5).unwrap();
    let motion = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
    assert_eq!(errors_of_verdict(&osc, &motion), None);
}
