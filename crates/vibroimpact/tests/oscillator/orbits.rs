//! The search for periodic orbits: against shooting from a far denser grid, and each answer against simulation. Orbits whose
//! numbers are known: in closed form, from a release, and in 40 digits.

use vibroimpact::motion::{EventKind, ImpactState, Motion};
use vibroimpact::orbit::{
    Count, Cycle, DEFAULT_EVENTS, FindOptions, Orbit, find, find_while, from_release, one_impact, shoot,
};
use vibroimpact::quantities::{Quantity, of_cycle};
use vibroimpact::system::phase;
use vibroimpact::{Label, Oscillator, Side, scenario};

/// Point N, a chaotic system with many unstable orbits, one with damping, one with two stops.
fn systems() -> [Oscillator; 5] {
    let two = Oscillator::new(1.3, 0.4, 0.8).unwrap().with_damping(0.02).unwrap();
    [
        scenario::N.oscillator(),
        scenario::S.oscillator(),
        Oscillator::from_inverse_beta(1.11, 3.4, 0.5).unwrap(),
        Oscillator::from_inverse_beta(1.5, 0.3, 0.6).unwrap().with_damping(0.03).unwrap(),
        two.with_second_stop(0.4, 0.8).unwrap(),
    ]
}

fn labels() -> impl Iterator<Item = Label> {
    let pairs = [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (2, 3), (1, 3), (4, 1), (3, 4), (3, 5), (4, 5)];
    pairs.into_iter().map(|(m, n)| Label::new(m, n))
}

/// What Newton's method on the impact map itself finds, from 96 phases times 40 speeds on each stop.
fn by_shooting(osc: &Oscillator, label: Label) -> Vec<Cycle> {
    let mut found: Vec<Cycle> = Vec::new();
    let Count::Finite(m) = label.impacts else { panic!() };
    let top = 4.0 * (1.0 + osc.gap().abs() + osc.free_amplitude().min(10.0)) / (1.0 - osc.restitution());
    for (side, _) in osc.stops() {
        for k in 0..40 {
            for j in 0..96 {
                let phase = std::f64::consts::TAU * (f64::from(j) + 0.3) / 96.0;
                let guess = ImpactState { phase, velocity: top * 0.87_f64.powi(k), side };
                match shoot(osc, guess, m, label.periods) {
                    Ok(cycle) if cycle.label == label && !found.iter().any(|f| f.same_as(&cycle, 1e-6)) => {
                        found.push(cycle);
                    }
                    _ => {}
                }
            }
        }
    }
    found
}

#[test]
fn shooting_from_everywhere_finds_nothing_more() {
    let mut orbits = 0;
    for osc in systems() {
        for label in labels() {
            let found = find(&osc, label, FindOptions::default());
            for cycle in by_shooting(&osc, label) {
                let there = found.iter().any(|o| o.physical && o.cycle.same_as(&cycle, 1e-6));
                assert!(there, "{label} at {osc:?}: {cycle:?}");
                orbits += 1;
            }
        }
    }
    assert!(orbits >= 15, "{orbits}");
}

#[test]
fn each_answer_is_what_simulation_says() {
    let (mut motions, mut others) = (0, 0);
    for osc in systems() {
        for label in labels() {
            for Orbit { cycle, physical, earlier } in find(&osc, label, FindOptions::default()) {
                assert_eq!(cycle.label, label);
                assert_eq!(physical, earlier.is_none());
                assert!(cycle.residual < 1e-13, "{cycle:?}");
                if !cycle.rests.is_empty() {
                    continue;
                }
                for (k, point) in cycle.points.iter().enumerate() {
                    let first = Motion::after(&osc, &point.state, Default::default())
                        .find(|e| !matches!(e.kind, EventKind::Graze { .. }))
                        .unwrap();
                    let next = cycle.points[(k + 1) % cycle.points.len()].state;
                    match earlier {
                        // flights before the one named are not touched either
                        Some(contact) if contact.flight == k => {
                            assert!(first.side == contact.side, "{first:?} {contact:?}");
                            assert!((first.time - contact.time).abs() < 1e-9, "{first:?} {contact:?}");
                            assert!(contact.time < point.interval);
                            others += 1;
                            break;
                        }
                        _ => {
                            assert!(matches!(first.kind, EventKind::Impact { .. }) && first.side == next.side);
                            assert!((first.time - point.interval).abs() < 1e-9, "{first:?} {cycle:?}");
                            motions += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(motions > 40 && others > 10, "{motions} {others}");
}

#[test]
fn both_motions_at_t_and_the_doubled_one() {
    let osc = Oscillator::from_inverse_beta(1.11, 2.0, 0.5).unwrap();
    let one = find(&osc, Label::new(1, 1), FindOptions::default());
    assert_eq!(one.iter().filter(|o| o.physical).count(), 1);
    assert!(!one.iter().any(|o| o.physical && o.cycle.stable()));
    let half = find(&osc, Label::new(1, 2), FindOptions::default());
    assert!(half.iter().any(|o| o.physical && o.cycle.stable()));
}

#[test]
fn stopped_at_a_starting_guess() {
    let osc = Oscillator::from_inverse_beta(1.11, 2.0, 0.5).unwrap();
    let asked = core::cell::Cell::new(0);
    let go_on = || {
        asked.set(asked.get() + 1);
        asked.get() < 3
    };
    assert!(find_while(&osc, Label::new(2, 2), FindOptions::default(), &go_on).is_none());
    assert_eq!(asked.get(), 3, "no further guess is followed");
}

#[test]
fn two_over_one_at_s() {
    let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap();
    let guess = ImpactState { phase: 0.83, velocity: 2.64, side: Side::Upper };
    let cycle = shoot(&osc, guess, 2, 1).unwrap();
    assert_eq!(cycle.label, Label::new(2, 1));
    let expected =
        [(0.829_989_671_461_920_7, 2.644_018_587_785_435), (3.194_590_893_857_773_4, 0.777_626_654_634_881_8)];
    for (point, (theta, u)) in cycle.points.iter().zip(expected) {
        assert!((point.state.phase - theta).abs() < 1e-13 && (point.state.velocity - u).abs() < 1e-13);
    }
    assert!((cycle.multipliers[0].re - 0.443_795_500_242).abs() < 1e-11);
    assert!((cycle.multipliers[1].re - 0.140_830_630_247).abs() < 1e-11);
}

#[test]
fn a_fourfold_lap_of_the_fundamental_is_reduced() {
    let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap();
    let guess = ImpactState { phase: 1.19, velocity: 2.8, side: Side::Upper };
    assert_eq!(shoot(&osc, guess, 4, 4).unwrap().label, Label::new(1, 1));
}

/// 1/beta, delta, n, U, theta, trace; computed in 40-digit arithmetic from the amplitude form of the equations.
const TABLE: [(f64, f64, u32, f64, f64, f64); 3] = [
    (1.11, 2.0, 1, 1.579_471_043_444_031_3, 1.488_135_732_365_034, -1.377_932_200_888_471),
    (1.11, 2.0, 2, 3.547_778_641_985_508_3, 1.384_257_046_450_963_5, -0.609_896_976_682_181_3),
    (1.3, 0.75, 1, 2.797_349_151_953_767_4, 1.190_509_613_787_888_5, 0.400_077_661_640_385),
];

#[test]
fn table_of_known_orbits() {
    for (inverse, gap, n, velocity, theta, trace) in TABLE {
        let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
        let orbits = one_impact(&osc, n);
        let orbit = orbits.iter().find(|o| (o.cycle.points[0].state.velocity - velocity).abs() < 1e-12).unwrap();
        assert!((orbit.cycle.points[0].state.phase - theta).abs() < 1e-13);
        let [one, two] = orbit.cycle.multipliers;
        assert!((one.re + two.re - trace).abs() < 1e-12, "{one:?} {two:?}");
        assert!(orbit.physical);
    }
}

/// A ball on a table, the limit of high frequency ratios: the flight from the impact arrives with the same phase and
/// speed, whose relative accuracy does not depend on the frequency ratio.
#[test]
fn high_frequency_ratios_lose_no_digits() {
    for beta in [10.0, 40.0, 160.0, 640.0, 2560.0, 1e5] {
        let osc = Oscillator::new(beta, -1.0 / (0.4 * core::f64::consts::PI), 0.5).unwrap();
        let orbits = one_impact(&osc, 1);
        assert_eq!(orbits.len(), 2, "{beta}");
        for orbit in &orbits {
            assert!(orbit.physical, "{beta}");
            let state = orbit.cycle.points[0].state;
            let next = Motion::after(&osc, &state, Default::default()).next().unwrap();
            let EventKind::Impact { velocity_before, .. } = next.kind else { panic!("{next:?}") };
            let (moved, ratio) = (phase::difference(next.phase, state.phase), velocity_before / state.velocity);
            assert!(moved.abs() < 1e-12 && (ratio - 1.0).abs() < 1e-12, "{beta}: {moved:e} {:e}", ratio - 1.0);
            // the work of the force is what the impact takes
            let of = of_cycle(&osc, &orbit.cycle).unwrap();
            let lost = of.get(Quantity::ImpactLossPerPeriod);
            let work = of.get(Quantity::WorkPerPeriod);
            assert!((work / lost - 1.0).abs() < 1e-11, "{beta}: {work} {lost}");
        }
    }
}

#[test]
fn resonance_and_twice_n() {
    let at = |beta: f64, gap: f64, n| one_impact(&Oscillator::new(beta, gap, 0.5).unwrap(), n).pop().unwrap().cycle;
    for gap in [-0.5, 0.3, 2.0] {
        for n in [1, 2] {
            let cycle = at(1.0, gap, n);
            let pi_n = core::f64::consts::PI * f64::from(n);
            assert!((cycle.points[0].state.velocity - pi_n / 1.5).abs() < 1e-13);
            assert!((cycle.points[0].state.phase - core::f64::consts::FRAC_PI_2).abs() < 1e-13);
            assert!(cycle.multipliers.iter().all(|m| (m.re + 0.5).abs() < 1e-7 && m.im.abs() < 1e-7));
        }
    }
    let f = 1.0 / (1.0 - 4.0_f64);
    let cycle = at(2.0, 0.2, 1);
    assert!((cycle.points[0].state.velocity - 4.0 * (f * f - 0.04_f64).sqrt() / 0.5).abs() < 1e-13);
}

#[test]
fn whole_natural_periods_drive_no_orbit() {
    for (inverse, n) in [(1.5, 2), (0.5, 2), (2.0, 1), (3.0, 1), (1.0 / 3.0, 3)] {
        for gap in [0.1, 0.5, 1.3] {
            let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
            assert_eq!(one_impact(&osc, n).len(), 0, "1/beta {inverse} n {n} gap {gap}");
        }
    }
}

/// On the fold curve both roots coincide and a multiplier is +1; on the flip curve one is -1 (closed forms from the
/// amplitude equations, derived independently of the code above).
#[test]
fn fold_and_doubling_curves() {
    for (beta, eps, zeta) in [(0.8, 0.5, 0.0), (1.4, 0.7, 0.05), (0.9, 0.3, 0.2), (2.6, 0.6, 0.01_f64)] {
        let (wd, period) = ((1.0 - zeta * zeta).sqrt(), core::f64::consts::TAU / beta);
        let (e, c, s) = ((-zeta * period).exp(), (wd * period).cos(), (wd * period).sin());
        let (m11, m12, m22) = (e * (c + zeta * s / wd), e * s / wd, e * (c - zeta * s / wd));
        let den = m11 + m22 - 1.0 - e * e;
        let (a, b) = ((1.0 + eps) * m12 / den, 1.0 - (1.0 + eps) * (m22 - e * e) / den);
        let f = 1.0 / ((1.0 - beta * beta).powi(2) + (2.0 * zeta * beta).powi(2)).sqrt();
        let det = (eps * e).powi(2);
        let q = (-(1.0 + det) + 2.0 * eps * e * c) / ((1.0 + eps) * m12);
        let rho = -(q + (1.0 - beta * beta) * a - 2.0 * zeta * b) / (beta * beta);
        let velocity = f / ((rho - a).powi(2) + (b / beta).powi(2)).sqrt();
        let osc = Oscillator::new(beta, rho * velocity, eps).unwrap().with_damping(zeta).unwrap();
        let orbit = one_impact(&osc, 1)
            .into_iter()
            .find(|o| (o.cycle.points[0].state.velocity / velocity - 1.0).abs() < 1e-9)
            .unwrap();
        let [one, two] = orbit.cycle.multipliers;
        assert!((one.re + 1.0).abs() < 1e-10 && (two.re + det).abs() < 1e-10, "{one:?} {two:?}");
        // just inside the fold the two orbits are close, with multipliers on either side of +1
        let fold = f * (1.0 + (beta * a / b).powi(2)).sqrt() * a.signum();
        let near = Oscillator::new(beta, fold * (1.0 - 1e-8), eps).unwrap().with_damping(zeta).unwrap();
        let past = Oscillator::new(beta, fold * (1.0 + 1e-8), eps).unwrap().with_damping(zeta).unwrap();
        let two_orbits = one_impact(&near, 1);
        assert_eq!((two_orbits.len(), one_impact(&past, 1).len()), (2, 0));
        let large: Vec<f64> = two_orbits.iter().map(|o| o.cycle.multipliers[0].re).collect();
        assert!(large.iter().any(|m| *m > 1.0) && large.iter().any(|m| *m < 1.0), "{large:?}");
    }
}

#[test]
fn flights_impacts_and_rest_fill_whole_periods() {
    for (inverse, gap, eps) in [(1.11, -0.5, 0.5), (0.9, -0.9, 0.7), (2.5, 0.25, 0.5), (1.3, 0.3, 0.0)] {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap();
        let cycle = from_release(&osc, Side::Upper, DEFAULT_EVENTS).unwrap();
        assert_eq!(cycle.label.impacts == Count::Infinite, eps > 0.0);
        let ahead = |a: f64, b: f64| phase::wrap(b - a) / osc.beta();
        let [rest] = cycle.rests.as_slice() else { panic!("one rest") };
        let first = ahead(rest.release, cycle.points[0].state.phase);
        let struck: f64 = cycle.points.iter().map(|p| p.interval).sum();
        let turns = (first + struck + ahead(rest.begin, rest.release)) / osc.period();
        // the flight before the first impact can be longer than a period
        assert!((turns - turns.round()).abs() < 1e-12, "1/beta {inverse} gap {gap}: {turns}");
    }
}

#[test]
fn no_release_no_cycle() {
    for gap in [-1.5, 1.5] {
        let osc = Oscillator::new(0.9, gap, 0.5).unwrap();
        assert_eq!(from_release(&osc, Side::Upper, DEFAULT_EVENTS), None);
    }
    // released, but it does not stick again: the motion ends in 1/1
    let osc = Oscillator::from_inverse_beta(0.6, 0.75, 0.5).unwrap();
    assert_eq!(from_release(&osc, Side::Upper, DEFAULT_EVENTS), None);
}
