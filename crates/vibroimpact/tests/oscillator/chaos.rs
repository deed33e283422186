//! Lyapunov exponents against what is known without them: the identity of their sum, multipliers, flights without impacts,
//! neighbours followed as motions of their own, and each other. Sections of an attractor.

use vibroimpact::chaos::{ExponentOptions, Exponents, Grounds, Measured, exponents, lyapunov, section};
use vibroimpact::flight::SearchLimits;
use vibroimpact::motion::{EventKind, ImpactState, Mapped, Motion, impact_map, stroboscopic_map};
use vibroimpact::orbit::{FindOptions, find};
use vibroimpact::verdict::NoImpact;
use vibroimpact::{Oscillator, Side, Start, scenario};

/// 1/beta, gap, restitution, damping, second gap and restitution.
type Parameters = (f64, f64, f64, f64, Option<(f64, f64)>);

/// All chaotic from rest.
const CHAOTIC: [Parameters; 14] = [
    (1.11, 3.0, 0.5, 0.0, None),
    (1.837, 2.1, 0.43, 0.0001, None),
    (1.391, 3.36, 0.93, 0.0, None),
    (1.898, 1.42, 0.452, 0.0, None),
    (1.07, 3.32, 0.395, 0.0124, None),
    (1.912, 1.15, 0.88, 0.0116, None),
    (0.7, -0.49, 0.9, 0.0, None),
    (1.67, 1.38, 0.577, 0.0107, None),
    (1.617, -0.307, 0.675, 0.0, None),
    (1.07, 0.49, 0.8, 0.0, Some((0.17, 0.77))),
    (1.88, 1.3, 0.89, 0.03, Some((0.47, 0.8))),
    (1.714, 2.92, 0.69, 0.0453, Some((1.41, 0.78))),
    (0.914, 0.34, 0.46, 0.0, Some((0.22, 0.9))),
    (1.55, 1.82, 0.856, 0.052, Some((1.05, 0.9))),
];

fn system((inverse, gap, eps, damping, second): Parameters) -> Oscillator {
    let osc = Oscillator::from_inverse_beta(inverse, gap, eps).and_then(|osc| osc.with_damping(damping));
    let osc = match second {
        Some((gap, eps)) => osc.and_then(|osc| osc.with_second_stop(gap, eps)),
        None => osc,
    };
    osc.expect("the parameters are legal")
}

fn from_rest(osc: &Oscillator, impacts: u64) -> Exponents {
    exponents(osc, Start::at_rest(osc), &ExponentOptions::new(impacts, 500))
}

/// Measured from the stretches of two vectors, which know nothing of the determinant.
#[test]
fn the_sum_of_the_exponents_is_the_identity() {
    for parameters in CHAOTIC {
        let osc = system(parameters);
        let found = from_rest(&osc, 20_000);
        let [one, two] = found.exponents[..] else { panic!("two") };
        assert!(one.value > one.error, "{parameters:?} is not chaotic: {one:?}");
        let expected = match osc.stop(Side::Lower) {
            Some(_) => found.identity,
            // one stop: from nothing but the rate
            None => {
                let rate = found.impact_rate.value;
                2.0 * osc.restitution().ln() * rate - 2.0 * osc.damping()
            }
        };
        let residual = (one.value + two.value - expected).abs();
        assert!(residual < 1e-11 && (found.identity - expected).abs() < 1e-13, "{parameters:?}: {residual:e}");
        assert!((found.sum.value - expected).abs() < 1e-11);
    }
}

/// With two stops the mean of the logarithm goes by how often each is struck, counted here in a motion of its own.
#[test]
fn with_two_stops_each_counts_as_often_as_it_is_struck() {
    let (mut both, mut damped) = (0, 0);
    for osc in CHAOTIC.map(system).into_iter().filter(|osc| osc.stop(Side::Lower).is_some()) {
        let found = from_rest(&osc, 20_000);
        let (mut struck, mut passed, mut begin, mut end) = ([0_u32; 2], 0, 0.0, 0.0);
        for event in Motion::new(&osc, Start::at_rest(&osc)) {
            if !matches!(event.kind, EventKind::Impact { .. }) {
                continue;
            }
            passed += 1;
            end = event.time;
            if passed == 500 {
                begin = event.time;
            } else if passed > 500 {
                struck[usize::from(event.side == Side::Lower)] += 1;
            }
            if passed == 20_500 {
                break;
            }
        }
        let logarithms: f64 =
            osc.stops().zip(struck).map(|((_, stop), count)| f64::from(count) * stop.restitution.ln()).sum();
        let expected = 2.0 * logarithms / (end - begin) - 2.0 * osc.damping();
        assert!((found.sum.value - expected).abs() < 1e-11, "{osc:?}: {} {expected}", found.sum.value);
        if struck.iter().all(|count| *count > 1000) {
            (both, damped) = (both + 1, damped + i32::from(osc.damping() > 0.0));
        }
    }
    assert!(both >= 4 && damped >= 2, "{both} systems strike both stops, {damped} of them damped");
}

#[test]
fn two_runs_at_u_agree_within_their_error_bars() {
    let osc = scenario::U.oscillator();
    let options = ExponentOptions::new(100_000, 1000);
    let one = exponents(&osc, Start::at_rest(&osc), &options);
    let two = exponents(&osc, Start { x: -1.0, v: 0.3, phase: 2.0 }, &options);
    let agree = |a: Measured, b: Measured| {
        assert!(a.value != b.value, "the runs are one and the same");
        assert!((a.value - b.value).abs() <= a.error + b.error && a.error < 0.02 * a.value.abs(), "{a:?} {b:?}");
    };
    agree(one.exponents[0], two.exponents[0]);
    agree(one.exponents[1], two.exponents[1]);
    agree(one.impact_rate, two.impact_rate);
    agree(one.section_dimension.unwrap(), two.section_dimension.unwrap());
    assert!((one.flow_dimension.unwrap().value - one.section_dimension.unwrap().value - 1.0).abs() < 1e-15);
}

/// Many short runs scatter about a long one as their error bars say: neither wider nor much narrower.
#[test]
fn error_bars_tell_the_scatter() {
    let osc = scenario::U.oscillator();
    let of = |found: &Exponents| {
        [found.exponents[0], found.exponents[1], found.impact_rate, found.section_dimension.unwrap()]
    };
    let long = of(&from_rest(&osc, 1_000_000));
    let mut squares = [0.0; 4];
    for k in 0..60 {
        let start = Start { x: 3.0 - 0.05 * f64::from(k), v: 0.1 * f64::from(k % 17), phase: 0.1 * f64::from(k) };
        let short = of(&exponents(&osc, start, &ExponentOptions::new(5_000, 500)));
        for (sum, (s, l)) in squares.iter_mut().zip(short.iter().zip(&long)) {
            let deviation = 3.0 * (s.value - l.value) / s.error;
            assert!(deviation.abs() < 4.0, "{s:?} {l:?}");
            *sum += deviation * deviation / 60.0;
        }
    }
    for square in squares {
        assert!((0.7..1.2).contains(&square.sqrt()), "{squares:?}");
    }
}

/// A neighbour simulated as a motion of its own, drawn near again after every forcing period: no derivative anywhere.
#[test]
fn neighbours_part_at_the_larger_exponent() {
    const NEAR: f64 = 1e-9;
    for osc in [scenario::U.oscillator(), system(CHAOTIC[5])] {
        let mut state = stroboscopic_map(&osc, Start::at_rest(&osc), 1000).unwrap().state;
        let (mut dx, mut dv) = (NEAR, 0.0);
        let mut logarithms = Vec::new();
        for _ in 0..20_500 {
            let x = (state.x + dx).min(osc.gap());
            let beside = stroboscopic_map(&osc, Start { x, v: state.v + dv, ..state }, 1000).unwrap().state;
            state = stroboscopic_map(&osc, state, 1000).unwrap().state;
            (dx, dv) = (beside.x - state.x, beside.v - state.v);
            let distance = dx.hypot(dv);
            logarithms.push((distance / NEAR).ln());
            (dx, dv) = (dx * NEAR / distance, dv * NEAR / distance);
        }
        let blocks: Vec<f64> = logarithms[500..].chunks(500).map(|part| part.iter().sum::<f64>() / 500.0).collect();
        let mean = blocks.iter().sum::<f64>() / 40.0;
        let error = 3.0 * (blocks.iter().map(|b| (b - mean) * (b - mean)).sum::<f64>() / (40.0 * 39.0)).sqrt();
        let found = from_rest(&osc, 50_000).exponents[0].scaled(osc.period());
        assert!((mean - found.value).abs() < error + found.error && error < 0.1 * mean, "{mean} +- {error} {found:?}");
    }
}

#[test]
fn cycles_have_the_exponents_of_their_multipliers() {
    for (point, label) in [(scenario::S, "2/1"), (scenario::N, "4/1"), (scenario::T, "1/2")] {
        let osc = point.oscillator();
        let found = from_rest(&osc, 20_000);
        let orbits = find(&osc, label.parse().unwrap(), FindOptions::default());
        let orbit = orbits.iter().find(|orbit| orbit.physical && orbit.cycle.stable()).unwrap();
        let length = f64::from(orbit.cycle.label.periods);
        for (measured, multiplier) in
            found.exponents.iter().map(|of| of.scaled(osc.period())).zip(orbit.cycle.multipliers)
        {
            let expected = multiplier.modulus().ln() / length;
            assert!((measured.value - expected).abs() <= measured.error, "{}: {measured:?} {expected}", point.name);
            assert!(measured.error < 1e-2, "{measured:?}");
        }
        let Grounds::Measured { time, .. } = found.grounds else { panic!("{found:?}") };
        assert!(found.exponents[0].error * time >= 0.999_999, "another length would change that much");
        assert_eq!(found.section_dimension.map(|d| d.value), Some(0.0));
        assert_eq!(found.flow_dimension.map(|d| d.value), Some(1.0));
    }
}

#[test]
fn flights_without_impacts_are_exact() {
    for (damping, expected) in [(0.0, [0.0, 0.0]), (0.2, [-0.2, -0.2]), (1.0, [-1.0, -1.0]), (1.25, [-0.5, -2.0])] {
        let osc = Oscillator::from_inverse_beta(0.7, 4.0, 0.5).unwrap().with_damping(damping).unwrap();
        let found = from_rest(&osc, 1000);
        assert!(matches!(found.grounds, Grounds::Flight(NoImpact::Flight(_))), "{found:?}");
        assert_eq!(found.exponents, expected.map(|value| Measured { value, error: 0.0 }));
        assert_eq!(found.impact_rate.value, 0.0);
        // an undamped flight attracts nothing
        assert_eq!(found.section_dimension.map(|d| d.value), (damping > 0.0).then_some(0.0));
    }
}

#[test]
fn what_sticks_forgets_everything() {
    let sticks = |inverse, gap, eps| {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap();
        let found = from_rest(&osc, 5000);
        assert_eq!(found.grounds, Grounds::Sticks(Side::Upper), "{inverse} {gap} {eps}");
        assert_eq!(found.exponents, [Measured { value: f64::NEG_INFINITY, error: 0.0 }; 2]);
        assert_eq!(found.section_dimension.map(|d| d.value), Some(0.0));
        found.impact_rate.value * osc.period()
    };
    assert_eq!(sticks(1.11, -0.5, 0.5), f64::INFINITY);
    // restitution 0: the mass sticks after one impact, or after two
    assert_eq!((sticks(1.3, 0.4, 0.0), sticks(1.3, 0.75, 0.0)), (1.0, 2.0));
    let pressed = Oscillator::new(0.9, -1.5, 0.5).unwrap();
    let found = exponents(&pressed, Start { x: -3.0, v: 0.0, phase: 1.0 }, &ExponentOptions::default());
    assert_eq!((found.grounds, found.exponents[0].value), (Grounds::Stuck(Side::Upper), f64::NEG_INFINITY));
}

/// A start on the stop sticks once, and what follows the release never does again: only that counts.
#[test]
fn a_stick_on_the_way_is_no_more_than_a_beginning() {
    let osc = Oscillator::from_inverse_beta(0.6, 0.75, 0.5).unwrap();
    let found = exponents(&osc, Start { x: 0.75, v: 0.0, phase: 1.5 }, &ExponentOptions::new(2000, 500));
    assert!(matches!(found.grounds, Grounds::Measured { impacts: 2000, transient: 500, blocks: 128, .. }));
    assert!(found.exponents[0].value.is_finite() && (found.sum.value - found.identity).abs() < 1e-12, "{found:?}");
}

/// Restitution 0 away from the force's pressure: the speed of arrival is forgotten, the phase is not. Of 1/1 it is a map of the phase
/// alone, whose slope is the multiplier.
#[test]
fn without_restitution_one_exponent_is_minus_infinity() {
    let osc = Oscillator::from_inverse_beta(1.11, 3.0, 0.0).unwrap();
    let found = from_rest(&osc, 5000);
    assert!(matches!(found.grounds, Grounds::Measured { .. }));
    assert_eq!(
        (found.exponents[1].value, found.sum.value, found.identity),
        (f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY)
    );
    let next = |phase: f64| {
        let event = Motion::new(&osc, Start { x: 3.0, v: 0.0, phase }).next().unwrap();
        assert!(matches!(event.kind, EventKind::Impact { .. }));
        event.phase
    };
    let fixed = (0..2000).fold(2.0, |phase, _| next(phase));
    let slope = (next(fixed + 1e-5) - next(fixed - 1e-5)) / 2e-5;
    let expected = slope.abs().ln() / osc.period();
    let one = found.exponents[0];
    assert!((one.value - expected).abs() < 1e-8 && one.value < -one.error, "{one:?} {expected}");
}

#[test]
fn touches_have_no_derivative() {
    let touching = Oscillator::new(2.0, 3.0, 0.5).unwrap();
    let found = exponents(&touching, Start { x: 3.0, v: 0.0, phase: 2.0 }, &ExponentOptions::default());
    assert!(matches!(found.grounds, Grounds::Touches(NoImpact::Grazing { .. })));
    let fading = scenario::Q.oscillator();
    let found = exponents(&fading, Start { x: 0.25, v: 0.8, phase: 0.0 }, &ExponentOptions::default());
    assert!(matches!(found.grounds, Grounds::Touches(NoImpact::GrazeLimit { .. })), "{found:?}");
    assert!(found.exponents[0].value.is_nan() && found.section_dimension.is_none());
    // plastic impacts fade away at the first tangential return; they were measured as noise of 5e-9
    let plastic = Oscillator::from_inverse_beta(0.6, 1.2, 0.0).unwrap();
    let found = from_rest(&plastic, 5000);
    assert!(matches!(found.grounds, Grounds::Touches(NoImpact::GrazeLimit { .. })), "{found:?}");
    assert!(found.exponents[0].value.is_nan() && found.section_dimension.is_none());
}

/// Elastic and undamped: area is kept, so the exponents are opposite and the chaotic sea has the dimension of the plane.
#[test]
fn elastic_chaos_keeps_area() {
    let osc = Oscillator::new(0.9, 0.5, 1.0).unwrap();
    let found = from_rest(&osc, 20_000);
    let [one, two] = found.exponents[..] else { panic!("two") };
    assert!(one.value > one.error && (one.value + two.value).abs() < 1e-13, "{found:?}");
    assert_eq!((found.identity, found.section_dimension.map(|d| d.value)), (0.0, Some(2.0)));
}

#[test]
fn a_budget_that_runs_out_says_so() {
    let osc = scenario::U.oscillator();
    let options = ExponentOptions { max_steps: 5_000, ..ExponentOptions::default() };
    let found = exponents(&osc, Start::at_rest(&osc), &options);
    assert!(matches!(found.grounds, Grounds::Undecided { impacts: 100..=5000 }), "{found:?}");
    assert!(found.exponents[0].value.is_nan() && found.impact_rate.value.is_nan());
}

#[test]
fn a_cycle_is_a_few_points() {
    let osc = scenario::S.oscillator();
    let found = section(&osc, Start::at_rest(&osc), 400, 6);
    let expected = [(0.829_989_671_461_920_7, 2.644_018_587_785_435), (3.194_590_893_857_773, 0.777_626_654_634_881_7)];
    for impact in &found.impacts {
        let near = |(phase, velocity): &(f64, f64)| {
            (impact.phase - phase).abs() < 1e-12 && (impact.velocity - velocity).abs() < 1e-12
        };
        assert!(expected.iter().any(near), "{impact:?}");
    }
    for strobe in &found.strobes {
        let first = found.strobes[0];
        assert!((strobe.x - first.x).abs() < 1e-12 && (strobe.v - first.v).abs() < 1e-12);
    }
}

#[test]
fn motions_that_end_leave_what_they_have() {
    // pressed against the stop: a few impacts, then at rest in every period
    let stuck = Oscillator::new(0.9, -1.5, 0.5).unwrap();
    let found = section(&stuck, Start { x: -3.0, v: 0.0, phase: 1.0 }, 0, 100);
    assert!((3..60).contains(&found.impacts.len()) && found.impacts[0].side == Side::Upper);
    assert_eq!(found.strobes.len(), 100);
    assert_eq!((found.strobes[99].x, found.strobes[99].v), (-1.5, 0.0));
    // it grazes the stop after every natural period, for ever
    let touching = Oscillator::new(2.0, 3.0, 0.5).unwrap();
    let found = section(&touching, Start { x: 3.0, v: 0.0, phase: 2.0 }, 0, 10);
    assert_eq!((found.impacts.len(), found.strobes.len()), (0, 10));
    // a complete chatter in every period
    let chatter = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).unwrap();
    assert_eq!(section(&chatter, Start::at_rest(&chatter), 100, 200).impacts.len(), 200);
}

#[test]
fn sum_of_exponents_is_the_identity() {
    for (inverse, gap, eps, zeta) in [(1.11, 3.0, 0.5, 0.0), (1.11, 2.9, 0.5, 0.001), (1.15, 3.0, 0.6, 0.0)] {
        let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(zeta).unwrap();
        let from = ImpactState { phase: 1.4, velocity: 2.4, side: Side::Upper };
        let spectrum = lyapunov(&osc, from, 20_000).unwrap();
        let last = (0..20_000).fold(from, |state, _| match impact_map(&osc, &state, SearchLimits::default()) {
            Mapped::Impact { state, .. } => state,
            other => panic!("{other:?}"),
        });
        let [one, two] = spectrum.exponents;
        let rate = spectrum.impact_rate.value;
        let identity = 2.0 * eps.ln() * rate - 2.0 * zeta;
        // the area changes by U0/U1, which leaves a bounded number over t in the sum
        let end = (from.velocity / last.velocity).ln().abs() / (20_000.0 / rate);
        assert!((one.value + two.value - identity).abs() <= 1e-9 + 1.01 * end, "{one:?} {two:?} {identity}");
    }
}

#[test]
fn a_periodic_motion_has_the_exponents_of_its_multipliers() {
    let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap();
    let from = ImpactState { phase: 0.829_989_671_461_920_7, velocity: 2.644_018_587_785_435, side: Side::Upper };
    let spectrum = lyapunov(&osc, from, 10_000).unwrap();
    let expected = [0.443_795_500_242_f64, 0.140_830_630_247].map(|m| m.ln() / osc.period());
    for (measured, want) in spectrum.exponents.iter().zip(expected) {
        assert!((measured.value - want).abs() < 2e-3, "{measured:?} {want}");
    }
    assert!((spectrum.impact_rate.value * osc.period() - 2.0).abs() < 1e-9);
}
