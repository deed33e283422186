//! Chatter and sticking over preload and frequency: every run ends in a verdict, time advances, the mass stays on its
//! side, and cycles with complete chatter are what theory says.

use std::f64::consts::PI;
use vibroimpact::motion::{EventKind, Motion, Path};
use vibroimpact::verdict::{Count, SettleOptions, StartBox, Verdict, scattered_starts, settle};
use vibroimpact::{Oscillator, Start};

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
