//! Two stops alike: orbits with one impact on each in a period, symmetric under a half turn, by their closed form; where
//! symmetry is lost; and a branch through the place where the mass begins to stick.

use crate::Random;
use std::f64::consts::{PI, TAU};
use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, SolutionPoint};
use vibroimpact::motion::ImpactState;
use vibroimpact::orbit::{Cycle, CyclePoint, FindOptions, find, refine};
use vibroimpact::verdict::{SettleOptions, settle};
use vibroimpact::{Label, Oscillator, Parameter, Side};

/// Speed and phase on the upper stop of the symmetric orbits, and the trace of the half turn: the closed form of one impact
/// on one stop with half the flight time and the return mirrored.
fn mirrored(beta: f64, gap: f64, eps: f64, zeta: f64) -> Vec<(f64, f64, f64)> {
    let time = PI / beta;
    let wd = (1.0 - zeta * zeta).sqrt();
    let (e, c, s) = ((-zeta * time).exp(), -(wd * time).cos(), -(wd * time).sin());
    let (m11, m12, m22) = (e * (c + zeta * s / wd), e * s / wd, e * (c - zeta * s / wd));
    let den = m11 + m22 - 1.0 - e * e;
    let (a, b) = ((1.0 + eps) * m12 / den, 1.0 - (1.0 + eps) * (m22 - e * e) / den);
    let square = 1.0 / ((1.0 - beta * beta).powi(2) + (2.0 * zeta * beta).powi(2));
    let (in_phase, across) = ((1.0 - beta * beta) * square, -2.0 * zeta * beta * square);
    let q = b / beta;
    let (qa, qb, qc) = (a * a + q * q, -gap * a, gap * gap - square);
    let disc = qb * qb - qa * qc;
    let roots = if disc < 0.0 { vec![] } else { vec![(-qb - disc.sqrt()) / qa, (-qb + disc.sqrt()) / qa] };
    let whole = |u: f64| {
        let (p, r) = (gap - a * u, q * u);
        let phase = (in_phase * p - across * r).atan2(across * p + in_phase * r);
        (u, phase, -2.0 * eps * e * c + (1.0 + eps) * m12 * (phase.sin() - gap) / u)
    };
    roots.into_iter().filter(|u| *u > 1e-3).map(whole).collect()
}

#[test]
fn the_symmetric_orbit_and_its_multipliers() {
    let mut numbers = Random(11);
    let mut compared = 0;
    for count in 0..200 {
        let (beta, eps) = (numbers.between(0.4, 3.0), numbers.between(0.2, 0.95));
        let zeta = if count % 2 == 0 { 0.0 } else { numbers.between(0.0, 0.2) };
        let osc = Oscillator::new(beta, 1.0, eps).unwrap().with_damping(zeta).unwrap();
        let gap = numbers.between(0.1, 1.2) * osc.free_amplitude().min(3.0);
        let osc = Parameter::Gap.set(&osc, gap).unwrap().with_second_stop(gap, eps).unwrap();
        for (u, phase, half) in mirrored(beta, gap, eps, zeta) {
            let det = (eps * (-zeta * PI / beta).exp()).powi(2);
            if (1.0 / (1.0 + det - half)).abs() > 1e2 || (1.0 / (1.0 + det + half)).abs() > 1e2 {
                continue;
            }
            let point = |side: Side, phase: f64| CyclePoint {
                state: ImpactState { phase: phase.rem_euclid(TAU), velocity: 1.001 * u, side },
                interval: PI / beta,
            };
            let guess = Cycle {
                label: Label::new(2, 1),
                points: vec![point(Side::Upper, phase + 1e-3), point(Side::Lower, phase + PI)],
                rests: Vec::new(),
                multipliers: Default::default(),
                residual: f64::NAN,
            };
            let cycle = refine(&osc, &guess).unwrap().cycle;
            let upper = cycle.points.iter().find(|p| p.state.side == Side::Upper).unwrap().state;
            assert!((upper.velocity / u - 1.0).abs() < 1e-11, "{} {u} at {osc:?}", upper.velocity);
            assert!(((upper.phase - phase + PI).rem_euclid(TAU) - PI).abs() < 1e-11);
            // a whole turn is the half turn twice
            let trace = half * half - 2.0 * det;
            let [one, two] = cycle.multipliers;
            assert!((one.re + two.re - trace).abs() < 1e-11 * (1.0 + trace.abs()), "{one:?} {two:?} {trace}");
            compared += 1;
        }
    }
    assert!(compared > 150, "{compared}");
}

/// At a branch point of the symmetric orbit the half turn has the multiplier -1; two branches leave there, mirror images.
#[test]
fn symmetry_is_lost_at_a_branch_point() {
    let (gap, eps, zeta) = (0.4, 0.8, 0.02);
    let at = |beta: f64| {
        let osc = Oscillator::new(beta, gap, eps).unwrap().with_damping(zeta).unwrap();
        osc.with_second_stop(gap, eps).unwrap()
    };
    let range = 1.5..=2.0;
    let orbits = find(&at(2.0), Label::new(2, 1), FindOptions::default());
    let begin = &orbits.iter().find(|o| o.physical && o.cycle.stable()).unwrap().cycle;
    let options = BranchOptions::default();
    let branch = Branch::new(&at(2.0), begin, Parameter::Beta, range.clone(), Direction::Down, options).unwrap();
    let point = branch.into_iter().find(|p| p.event == Some(BranchEvent::BranchPoint)).unwrap();
    // the closed form, where the half turn's trace is -(1 + det)
    let off = |beta: f64| {
        let det = (eps * (-zeta * PI / beta).exp()).powi(2);
        mirrored(beta, gap, eps, zeta).last().unwrap().2 + 1.0 + det
    };
    assert!(off(point.value - 1e-11) * off(point.value + 1e-11) < 0.0, "{}", point.value);
    let [one, other] = Branch::from_branch_point(&at(2.0), &point, Parameter::Beta, range, options).unwrap();
    let (one, other): (Vec<SolutionPoint>, Vec<SolutionPoint>) = (one.take(30).collect(), other.take(30).collect());
    for (a, b) in one.iter().zip(&other).skip(1) {
        assert!((a.value - b.value).abs() < 1e-9, "{} {}", a.value, b.value);
        let speed = |p: &SolutionPoint, side: Side| {
            p.cycle.points.iter().find(|q| q.state.side == side).unwrap().state.velocity
        };
        // unlike on the two stops, and the mirror image has them the other way round
        assert!((speed(a, Side::Upper) - speed(a, Side::Lower)).abs() > 1e-4);
        assert!((speed(a, Side::Upper) - speed(b, Side::Lower)).abs() < 1e-9);
    }
    assert!(one.iter().skip(1).all(|p| p.physical));
}

/// Between two stops alike a symmetric motion touches both, half a turn apart, and both touches are told: where the motion without
/// impacts comes to the stops and where the impacts of a symmetric orbit lose their speed.
#[test]
fn both_touches_of_a_symmetric_orbit() {
    let at = |gap: f64| {
        let osc = Oscillator::new(0.7, gap, 0.6).unwrap().with_damping(0.1).unwrap();
        osc.with_second_stop(gap, 0.6).unwrap()
    };
    let free = find(&at(3.0), Label::new(0, 1), FindOptions::default()).pop().unwrap();
    // both gaps vary only with the force's frequency: towards resonance the motion grows
    let options = BranchOptions::default();
    let branch = Branch::new(&at(3.0), &free.cycle, Parameter::Beta, 0.7..=1.2, Direction::Up, options).unwrap();
    let points: Vec<SolutionPoint> = branch.collect();
    let touches: Vec<&SolutionPoint> =
        points.iter().filter(|p| matches!(p.event, Some(BranchEvent::Grazing { .. }))).collect();
    assert!(!touches.is_empty());
    for point in touches {
        let Some(BranchEvent::Grazing { stop, also: Some(also), detail: Some(detail), .. }) = point.event else {
            panic!("{:?}", point.event)
        };
        let (_, phase) = detail.also.unwrap();
        assert!(also != stop && ((phase - detail.phase).abs() - PI).abs() < 1e-9, "{:?}", point.event);
    }
    // with stops unlike it is the nearer one alone
    let unlike = at(3.0).with_second_stop(3.1, 0.6).unwrap();
    let branch = Branch::new(&unlike, &free.cycle, Parameter::Beta, 0.7..=1.2, Direction::Up, options).unwrap();
    let first = branch.into_iter().find_map(|p| p.event).unwrap();
    assert!(matches!(first, BranchEvent::Grazing { stop: 0, also: None, .. }), "{first:?}");
}

/// Restitution 0: the mass leaves the stop at once while the force pulls it away at the impact, and stays where it presses. The branch
/// goes on through this place both ways.
#[test]
fn a_branch_goes_on_where_the_mass_sticks() {
    let osc = Oscillator::from_inverse_beta(0.8, 1.5, 0.0).unwrap().with_damping(0.02).unwrap();
    let orbits = find(&osc, Label::new(1, 1), FindOptions::default());
    let begin = &orbits.iter().find(|o| o.physical && o.cycle.rests.is_empty()).unwrap().cycle;
    let follow = |osc: &Oscillator, begin: &Cycle, direction: Direction| -> Vec<SolutionPoint> {
        Branch::new(osc, begin, Parameter::Gap, 0.2..=2.0, direction, BranchOptions::default()).unwrap().collect()
    };
    let down = follow(&osc, begin, Direction::Down);
    let sticks =
        |point: &SolutionPoint| matches!(point.event, Some(BranchEvent::Sticking { stop: 0, begins: true, .. }));
    let place = down.iter().position(sticks).unwrap();
    let (at, (before, beyond)) = (&down[place], down.split_at(place + 1));
    let theta = at.cycle.points[0].state.phase;
    assert!((theta.sin() - at.value).abs() < 1e-11, "{theta} {}", at.value);
    assert!(before.iter().all(|point| point.cycle.rests.is_empty()) && !beyond.is_empty());
    assert!(beyond.iter().all(|point| point.cycle.rests.len() == 1 && point.physical && point.value < at.value));
    let last = beyond.last().unwrap();
    assert_eq!((last.value, last.event), (0.2, Some(BranchEvent::EndOfRange)));
    // each is where a motion from beside it settles
    for point in beyond.iter().step_by(7) {
        let osc = Parameter::Gap.set(&osc, point.value).unwrap();
        let settled = settle(&osc, point.cycle.points[0].state.rebound(&osc), &SettleOptions::default());
        assert_eq!(settled.verdict.label(), "1/1", "{}", point.value);
    }
    let there = Parameter::Gap.set(&osc, 0.2).unwrap();
    let up = follow(&there, &last.cycle, Direction::Up);
    let ends =
        |point: &SolutionPoint| matches!(point.event, Some(BranchEvent::Sticking { stop: 0, begins: false, .. }));
    let place = up.iter().position(ends).unwrap();
    assert!((up[place].value - at.value).abs() < 1e-9, "{} {}", up[place].value, at.value);
    assert!(up[place + 1..].iter().all(|point| point.cycle.rests.is_empty() && point.physical));
    assert_eq!(up.last().unwrap().event, Some(BranchEvent::EndOfRange));
}
