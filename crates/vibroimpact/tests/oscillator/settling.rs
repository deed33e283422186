//! What motions settle into: the points of the paper, as oscillators and as machines, cycles to the last digits, and no impact.

use vibroimpact::chaos::lyapunov;
use vibroimpact::events;
use vibroimpact::flight::SearchLimits;
use vibroimpact::machine::{Machine, MachineParts};
use vibroimpact::motion::{ImpactState, Mapped, impact_map};
use vibroimpact::orbit::one_impact;
use vibroimpact::verdict::{
    Count, NoImpact, SettleOptions, StartBox, Verdict, attractors, scattered_starts, settle, settle_unreduced,
};
use vibroimpact::{Label, Oscillator, Side, Start, scenario};

#[test]
fn a_slow_departure_is_not_chaos() {
    // just beyond its flip 1/1 is left at a steady rate of 1e-4; 2/2 is stable
    let osc = Oscillator::from_inverse_beta(1.11, 1.83, 0.5).unwrap();
    let cycle = &one_impact(&osc, 1).into_iter().find(|orbit| orbit.physical).unwrap().cycle;
    let beside = cycle.points[0].state;
    let start = Start { v: -0.5 * (beside.velocity + 1e-3), ..beside.rebound(&osc) };
    let options = SettleOptions::default();
    let measured = lyapunov(&osc, beside, options.chaos_over).unwrap();
    let passing = lyapunov(&osc, ImpactState { velocity: beside.velocity + 1e-3, ..beside }, options.chaos_over);
    assert!(measured.diverges() && passing.is_some_and(|found| found.diverges() && !found.chaotic()));
    assert_eq!(settle(&osc, start, &options).verdict.label(), "2/2");
}

#[test]
fn the_papers_points_from_rest() {
    for point in scenario::PAPER {
        let osc = point.oscillator();
        let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
        assert!(point.motions.contains(&&*settled.verdict.label()), "{}: {:?}", point.name, settled.verdict);
    }
}

#[test]
fn four_over_one_at_n_to_the_last_digits() {
    let osc = scenario::N.oscillator();
    let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
    let Verdict::Periodic(cycle) = settled.verdict else { panic!() };
    let expected = [
        (0.185_568_221_573_524_7, 1.513_140_069_144_015_8),
        (1.440_306_040_352_512_3, 1.099_197_434_354_180_2),
        (2.158_838_329_628_230_4, 0.513_913_325_133_134_5),
        (2.736_447_333_268_362_8, 0.179_240_599_381_170_8),
    ];
    for (point, (theta, u)) in cycle.points.iter().zip(expected) {
        assert!((point.state.phase - theta).abs() < 1e-12 && (point.state.velocity - u).abs() < 1e-12, "{point:?}");
    }
    assert!(cycle.residual < 1e-13);
}

#[test]
fn chatter_cycles_are_superstable() {
    let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).unwrap();
    let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
    let Verdict::Periodic(cycle) = settled.verdict else { panic!("{:?}", settled.verdict) };
    assert_eq!(cycle.label.impacts, Count::Infinite);
    assert!(cycle.rests.len() == 1 && cycle.stable());
}

#[test]
fn ever_gentler_impacts_are_no_impact_in_the_limit() {
    // Q of the paper: 1/beta = 0.7, so there is a contact every ten forcing periods
    let osc = scenario::Q.oscillator();
    let mut limits = 0;
    for k in 0..60 {
        let start = Start { x: 1.5 - 0.05 * f64::from(k), v: 0.3 + 0.02 * f64::from(k), phase: 0.0 };
        match settle(&osc, start, &SettleOptions::default()).verdict {
            Verdict::NoImpact(NoImpact::GrazeLimit { .. }) => limits += 1,
            Verdict::NoImpact(_) => {}
            Verdict::Periodic(cycle) => assert_eq!(cycle.label, Label::new(1, 1)),
            other => panic!("{start:?}: {other:?}"),
        }
    }
    assert!(limits > 5, "{limits}");
}

/// At rest on the stop under a pull away, beta = 2: it grazes the stop after every natural period, for ever. An
/// earlier version of the impact map waited for an impact that never came.
#[test]
fn touches_without_impacts_end() {
    let osc = Oscillator::new(2.0, 3.0, 0.5).unwrap();
    let start = Start { x: 3.0, v: 0.0, phase: 2.0 };
    let settled = settle(&osc, start, &SettleOptions::default());
    assert!(matches!(settled.verdict, Verdict::NoImpact(NoImpact::Grazing { .. })), "{:?}", settled.verdict);
    let state = ImpactState { phase: 2.0, velocity: 0.0, side: Side::Upper };
    let mapped = impact_map(&osc, &state, SearchLimits::default());
    assert!(matches!(mapped, Mapped::End(_)), "{mapped:?}");
}

#[test]
fn the_papers_points_from_many_starts() {
    for point in scenario::PAPER {
        let census = attractors(&point.oscillator(), 50, 1, &SettleOptions::default());
        let mut labels: Vec<_> = census.motions().iter().map(|found| found.verdict.label().into_owned()).collect();
        labels.sort();
        let mut expected = point.motions.to_vec();
        expected.sort_unstable();
        assert_eq!(labels, expected, "{}", point.name);
    }
}

#[test]
fn starts_fill_the_box_and_depend_on_the_seed() {
    let osc = scenario::S.oscillator();
    let area = StartBox::natural(&osc);
    let mut quarters = [0_u32; 4];
    for index in 0..1000 {
        let start = scattered_starts(&osc, area, 7, index);
        let right = start.x > 0.5 * (area.x.0 + area.x.1);
        let up = start.v > 0.0;
        quarters[usize::from(right) + 2 * usize::from(up)] += 1;
    }
    assert!(quarters.iter().all(|q| (235..=265).contains(q)), "{quarters:?}");
    assert_ne!(scattered_starts(&osc, area, 7, 2), scattered_starts(&osc, area, 8, 2));
}

fn machine(osc: &Oscillator) -> Machine {
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

/// The paper's points as machines: the same labels, cycles and multipliers as the oscillator.
#[test]
fn the_papers_points_as_machines() {
    for point in scenario::PAPER {
        let osc = point.oscillator();
        let machine = machine(&osc);
        for (x, v) in [(0.0, 0.0), (-2.0, 0.0), (0.1, -1.0)] {
            let start = Start { x, v, phase: 0.0 };
            let expected = settle(&osc, start, &SettleOptions::default()).verdict;
            let own = events::Start { q: vec![x], qdot: vec![v], phase: 0.0, ..events::Start::default() };
            let found = settle_unreduced(&machine, &own, &SettleOptions::default()).unwrap().verdict;
            assert_eq!(found.label(), expected.label(), "{} from {x} {v}", point.name);
            if let (Verdict::Periodic(cycle), Verdict::Periodic(of)) = (&found, &expected) {
                assert!(cycle.residual < 1e-12);
                assert!((cycle.fastest() - of.fastest()).abs() < 1e-11, "{} {}", cycle.fastest(), of.fastest());
                for (a, b) in cycle.multipliers.iter().zip(of.multipliers) {
                    let apart = (a.re - b.re).abs() + (a.im - b.im).abs();
                    assert!(apart < 1e-9 || of.multipliers[0].modulus() == 0.0 && apart < 1e-3, "{a:?} {b:?}");
                }
            }
            if let (Verdict::Chaotic(own), Verdict::Chaotic(chaos)) = (&found, &expected) {
                let (a, b) = (own.spectrum.exponents[0], chaos.spectrum.exponents[0]);
                assert!((a.value - b.value).abs() < a.error + b.error, "{a:?} {b:?}");
            }
        }
    }
}
