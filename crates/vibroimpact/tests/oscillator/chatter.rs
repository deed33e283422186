//! Chatter and sticking over preload and frequency: every run ends in a verdict, time advances, the mass stays on its
//! side, and cycles with complete chatter are what theory says. The sum of a chatter against its impacts one by one, and where
//! a mass is released and lands.

use std::f64::consts::PI;
use vibroimpact::contact::chatter::{DEFAULT_SMALLNESS, completion};
use vibroimpact::contact::sticking::{Rest, pressure, release_phase, rest};
use vibroimpact::flight::{Contact, Flight, SearchLimits, first_contact};
use vibroimpact::motion::{End, EventKind, Motion, Path};
use vibroimpact::system::phase;
use vibroimpact::verdict::{Count, SettleOptions, StartBox, Verdict, scattered_starts, settle};
use vibroimpact::{Oscillator, Side, Start};

const GAPS: [f64; 6] = [-0.95, -0.75, -0.5, -0.25, 0.0, 0.25];
const INVERSE_BETAS: [f64; 6] = [0.6, 0.9, 1.11, 1.3, 1.8, 2.5];

#[test]
fn every_run_ends_in_a_verdict_and_chatter_cycles_are_superstable() {
    let mut with_chatter = 0;
    for gap in GAPS {
        for inverse in INVERSE_BETAS {
            let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
            let area = StartBox::natural(&osc);
            for index in 0..20 {
                let start = if index == 0 { Start::at_rest(&osc) } else { scattered_starts(&osc, area, 5, index) };
                let verdict = settle(&osc, start, &SettleOptions::default()).verdict;
                let Verdict::Periodic(cycle) = verdict else { panic!("1/beta {inverse} delta {gap}: {verdict:?}") };
                assert!(cycle.stable());
                if cycle.label.impacts == Count::Infinite {
                    with_chatter += 1;
                    assert!(cycle.multipliers.iter().all(|m| m.modulus() == 0.0));
                    for rest in &cycle.rests {
                        assert!((rest.release - (PI - gap.asin())).abs() < 1e-14);
                        // it rests while pressed: between arcsin(delta) and the release
                        assert!(rest.begin.sin() >= gap - 1e-12, "begins at {}", rest.begin);
                    }
                }
            }
        }
    }
    assert!(with_chatter > 200, "{with_chatter}");
}

#[test]
fn time_advances_and_the_mass_stays_on_its_side() {
    for gap in GAPS {
        for inverse in INVERSE_BETAS {
            for damping in [0.0, 0.05, 1.0] {
                let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap().with_damping(damping).unwrap();
                let mut motion = Motion::new(&osc, Start::at_rest(&osc));
                let (mut time, mut stalled) = (0.0, 0);
                for _ in 0..600 {
                    let Some(event) = motion.next() else { break };
                    // at most an event may share its instant with the one before (a stick after a plastic impact)
                    assert!(event.time >= time, "1/beta {inverse} delta {gap}: {} after {time}", event.time);
                    stalled = if event.time > time { 0 } else { stalled + 1 };
                    assert!(stalled < 2, "1/beta {inverse} delta {gap}: time stands still at {time}");
                    time = event.time;
                    let leg = motion.leg().unwrap();
                    for k in 0..=24 {
                        let s = leg.duration * f64::from(k) / 24.0;
                        let (x, v) = leg.state(&osc, s);
                        // rounding as the evaluation itself bounds it, plus that of adding the start and of the time
                        let rounding = match &leg.path {
                            Path::Flight(flight) => {
                                flight.at(s).rounding + f64::EPSILON * (x.abs() + gap.abs() + s * v.abs())
                            }
                            Path::Rest(_) => 0.0,
                        };
                        assert!(
                            x <= gap + rounding,
                            "1/beta {inverse} delta {gap} zeta {damping}: beyond the stop by {:e}, rounding {rounding:e} {leg:?}",
                            x - gap
                        );
                    }
                    if let EventKind::Stick { error, .. } = event.kind {
                        assert!(error < 1e-12);
                    }
                }
            }
        }
    }
}

/// Summed impact by impact until the time no longer changes.
fn summed(osc: &Oscillator, mut theta: f64, mut w: f64) -> f64 {
    let mut total = 0.0;
    while w > 1e-200 {
        let flight = Flight::new(osc, Start { x: osc.gap(), v: -w, phase: theta });
        let Contact::Impact { time, velocity, .. } = first_contact(osc, &flight, SearchLimits::default()) else {
            panic!("a chatter goes on")
        };
        total += time;
        theta = phase::advance(theta, osc.beta(), time);
        w = osc.restitution() * velocity;
        if time < 1e-18 * total {
            break;
        }
    }
    total
}

#[test]
fn third_order_against_impact_by_impact() {
    let mut checked = 0;
    for (beta, gap, eps, zeta) in [
        (0.9, -0.5, 0.5, 0.0),
        (1.7, 0.2, 0.8, 0.0),
        (0.4, -0.9, 0.3, 0.2),
        (3.0, 0.0, 0.6, 1.4),
        (1.0, -2.0, 0.7, 0.05),
    ] {
        let osc = Oscillator::new(beta, gap, eps).unwrap().with_damping(zeta).unwrap();
        for theta in [0.4, 1.1, 1.9, 2.4] {
            for smallness in [1e-2, 1e-3, 1e-4] {
                // the largest rebound for which the sum is used
                let mut w = 0.1;
                let sum = loop {
                    match completion(&osc, Side::Upper, theta, w, smallness) {
                        Some(sum) => break sum,
                        None if w < 1e-9 => panic!("no completion"),
                        None => w *= 0.7,
                    }
                };
                let exact = summed(&osc, theta, w);
                let error = (sum.duration - exact).abs();
                assert!(
                    error <= sum.error + 1e-14 * exact,
                    "beta {beta} theta {theta} rho {smallness}: {error:e} > {:e}",
                    sum.error
                );
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 60);
}

/// The fourth power of the force and the square of the speed are zero in doubles here; their quotient was NaN in an
/// earlier version.
#[test]
fn tiny_forces_have_a_sum() {
    for (gap, w) in [(-1e-60, 1e-130), (-1e-85, 1e-180), (-1e-150, 1e-305)] {
        let osc = Oscillator::new(1.0, gap, 0.5).unwrap();
        let sum = completion(&osc, Side::Upper, 0.0, w, DEFAULT_SMALLNESS).unwrap();
        assert!((sum.duration / (4.0 * w / -gap) - 1.0).abs() < 1e-4, "{gap:e} {sum:?}");
    }
    let osc = Oscillator::new(1.0, -5e-324, 0.5).unwrap();
    assert_eq!(completion(&osc, Side::Upper, 0.0, 0.0, DEFAULT_SMALLNESS), None);
}

#[test]
fn no_chatter_without_a_force_into_the_stop() {
    let osc = Oscillator::new(1.0, 0.5, 0.5).unwrap();
    assert_eq!(completion(&osc, Side::Upper, 0.2, 1e-9, DEFAULT_SMALLNESS), None);
    let elastic = Oscillator::new(1.0, -0.5, 1.0).unwrap();
    assert_eq!(completion(&elastic, Side::Upper, 1.0, 1e-9, DEFAULT_SMALLNESS), None);
}

#[test]
fn pressed_against_the_stop_it_chatters_sticks_and_leaves() {
    let osc = Oscillator::new(0.9, -0.5, 0.5).unwrap();
    let mut sticks = 0;
    let mut time = -1.0;
    for event in Motion::new(&osc, Start::at_rest(&osc)).take(2000) {
        assert!(event.time >= time);
        time = event.time;
        if let EventKind::Stick { .. } = event.kind {
            sticks += 1;
        }
        if event.kind == EventKind::Release {
            assert!((event.phase - (PI + 0.5_f64.asin())).abs() < 1e-14);
        }
    }
    assert!(sticks > 10, "{sticks}");
}

#[test]
fn plastic_impacts_and_eternal_rest() {
    let plastic = Oscillator::new(1.0 / 1.3, 0.4, 0.0).unwrap();
    assert!(Motion::new(&plastic, Start::at_rest(&plastic)).take(100).count() == 100);
    let pressed = Oscillator::new(0.9, -1.5, 0.5).unwrap();
    let mut motion = Motion::new(&pressed, Start { x: -3.0, v: 0.0, phase: 0.0 });
    assert!(motion.by_ref().take(10_000).count() < 10_000);
    assert_eq!(motion.end(), Some(End::Stuck(Side::Upper)));
}

#[test]
fn releases_where_the_force_changes_sign() {
    for gap in [-0.95, -0.5, 0.0, 0.5, 0.99] {
        let osc = Oscillator::new(0.7, gap, 0.5).unwrap().with_second_stop(1.5, 0.5).unwrap();
        let Rest::Until { time, phase } = rest(&osc, Side::Upper, 1.5) else { panic!() };
        assert!((phase - (PI - gap.asin())).abs() < 1e-15);
        assert!((phase - 1.5 - 0.7 * time).abs() < 1e-14);
        assert!(pressure(&osc, Side::Upper, phase).abs() < 1e-15);
        assert!(pressure(&osc, Side::Upper, phase - 1e-3) > 0.0);
    }
    let pressed = Oscillator::new(0.7, -1.0, 0.5).unwrap();
    assert_eq!(rest(&pressed, Side::Upper, 0.3), Rest::Forever);
}

#[test]
fn the_lower_stop_is_the_mirror_image() {
    let osc = Oscillator::new(0.7, 2.0, 0.5).unwrap().with_second_stop(0.3, 0.5).unwrap();
    let phase = release_phase(&osc, Side::Lower).unwrap();
    assert!((phase.sin() + 0.3).abs() < 1e-15 && phase.cos() > 0.0, "x'' turns from negative to positive there");
    assert!(pressure(&osc, Side::Lower, phase - 1e-3) > 0.0);
    assert_eq!(release_phase(&osc, Side::Upper), None);
}

#[test]
fn f05_gap_zero_and_odd_frequencies_land_without_impact() {
    for (beta, rounds) in [(3.0, 2.0), (5.0, 3.0), (1.0 / 3.0, 1.0), (1.0 / 7.0, 1.0), (101.0, 51.0)] {
        for eps in [0.0, 0.5, 1.0] {
            let one = Oscillator::new(beta, 0.0, eps).unwrap();
            let lower = one.with_second_stop(1e3, 0.5).unwrap();
            for osc in [one, lower] {
                let mut time = 0.0;
                for event in Motion::released(&osc, Side::Upper).take(20) {
                    match event.kind {
                        EventKind::Stick { chatter: false, .. } => assert_eq!(event.phase, 0.0, "{beta} {eps}"),
                        EventKind::Release => {
                            let turns = (event.time - time) / osc.period();
                            assert!((turns - rounds).abs() < 1e-12, "{beta} {eps} {turns}");
                            time = event.time;
                        }
                        other => panic!("{beta} {eps}: {other:?}"),
                    }
                }
                assert!(time > 0.0);
            }
        }
    }
    // for nearby parameters there are impacts, and a second stop close by is struck first
    for osc in [Oscillator::new(3.0, 1e-9, 0.5), Oscillator::new(3.0 + 1e-9, 0.0, 0.5), Oscillator::new(2.0, 0.0, 0.5)]
    {
        let osc = osc.unwrap();
        let mut events = Motion::released(&osc, Side::Upper);
        assert!(matches!(events.next().unwrap().kind, EventKind::Impact { .. }));
    }
    let close = Oscillator::new(3.0, 0.0, 0.5).unwrap().with_second_stop(0.4, 0.5).unwrap();
    let event = Motion::released(&close, Side::Upper).next().unwrap();
    assert_eq!(event.side, Side::Lower);
}
