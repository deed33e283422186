//! The search for periodic orbits: against shooting from a far denser grid, and each answer against simulation.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use vibroimpact::motion::{EventKind, ImpactState, Motion};
use vibroimpact::orbit::{Cycle, FindOptions, Orbit, find, shoot};
use vibroimpact::{Label, Oscillator, scenario};

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
    let vibroimpact::verdict::Count::Finite(m) = label.impacts else { panic!() };
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
