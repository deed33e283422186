//! Derivatives of flights and impacts against differences of motions, and against each other.

use vibroimpact::chaos::tangent::{flight, saltation};
use vibroimpact::flight::SearchLimits;
use vibroimpact::math::Matrix2;
use vibroimpact::motion::{EventKind, ImpactState, Mapped, Motion, derivative, impact_map};
use vibroimpact::system::phase;
use vibroimpact::{Oscillator, Side, Start};

fn step(osc: &Oscillator, state: &ImpactState) -> (ImpactState, f64) {
    match impact_map(osc, state, SearchLimits::default()) {
        Mapped::Impact { state, interval } => (state, interval),
        other => panic!("{other:?}"),
    }
}

#[test]
fn derivative_by_differences_and_determinant() {
    for (beta, gap, eps, zeta, lower) in [
        (0.9, 2.0, 0.5, 0.0, None),
        (0.6, 0.3, 0.8, 0.03, None),
        (1.0, 1.0, 0.4, 0.0, None),
        (0.7, 0.6, 0.7, 0.1, Some(0.8)),
        (1.3, 0.2, 0.9, 1.2, Some(0.1)),
    ] {
        let mut osc = Oscillator::new(beta, gap, eps).unwrap().with_damping(zeta).unwrap();
        if let Some(gap) = lower {
            osc = osc.with_second_stop(gap, 0.6).unwrap();
        }
        let mut state = ImpactState { phase: 1.2, velocity: 1.9, side: Side::Upper };
        for _ in 0..5 {
            let (next, t) = step(&osc, &state);
            let d = derivative(&osc, &state, &next, t);
            let eps0 = osc.stop(state.side).unwrap().restitution;
            let det = eps0 * eps0 * (-2.0 * zeta * t).exp() * state.velocity / next.velocity;
            assert!((d.determinant() / det - 1.0).abs() < 1e-9, "{} {det}", d.determinant());
            let h = 1e-6;
            for (column, (dp, du)) in [(1.0, 0.0), (0.0, 1.0)].into_iter().enumerate() {
                let shifted = |h: f64| {
                    step(&osc, &ImpactState { phase: state.phase + h * dp, velocity: state.velocity + h * du, ..state })
                        .0
                };
                let (up, down) = (shifted(h), shifted(-h));
                let difference =
                    [phase::difference(up.phase, down.phase) / (2.0 * h), (up.velocity - down.velocity) / (2.0 * h)];
                for row in 0..2 {
                    let exact = d.0[row][column];
                    assert!((difference[row] - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{difference:?} {d:?}");
                }
            }
            state = next;
        }
    }
}

fn systems() -> [Oscillator; 3] {
    let osc = |beta, gap, eps, zeta| Oscillator::new(beta, gap, eps).unwrap().with_damping(zeta).unwrap();
    let two = osc(0.7, 0.6, 0.7, 0.1).with_second_stop(0.8, 0.6).unwrap();
    [osc(0.9, 2.0, 0.5, 0.0), two, osc(1.3, 0.2, 0.9, 1.2)]
}

/// The state a time `span` after `start`, with one impact between.
fn later(osc: &Oscillator, start: Start, span: f64) -> [f64; 2] {
    let mut motion = Motion::new(osc, start);
    let mut impacts = 0;
    loop {
        let event = motion.next().unwrap();
        let leg = motion.leg().unwrap();
        if leg.begin + leg.duration > span {
            assert_eq!(impacts, 1);
            let (x, v) = leg.state(osc, span - leg.begin);
            return [x, v];
        }
        impacts += u32::from(matches!(event.kind, EventKind::Impact { .. }));
    }
}

/// Flight, saltation and flight, compared with differences of whole motions, which use neither matrix.
#[test]
fn neighbours_move_as_the_matrices_say() {
    for osc in systems() {
        let start = Start { x: 0.1, v: 0.7, phase: 0.4 };
        let mut motion = Motion::new(&osc, start);
        let first = motion.next().unwrap();
        let EventKind::Impact { velocity_before: velocity, .. } = first.kind else { panic!() };
        let second = motion.next().unwrap();
        let span = 0.5 * (first.time + second.time);
        let at = ImpactState { phase: first.phase, velocity, side: first.side };
        let before = flight(&osc, first.time);
        let product = flight(&osc, span - first.time).times(saltation(&osc, &at).times(before));
        let h = 1e-6;
        for (column, (dx, dv)) in [(h, 0.0), (0.0, h)].into_iter().enumerate() {
            let up = later(&osc, Start { x: start.x + dx, v: start.v + dv, ..start }, span);
            let down = later(&osc, Start { x: start.x - dx, v: start.v - dv, ..start }, span);
            for row in 0..2 {
                let (difference, exact) = ((up[row] - down[row]) / (2.0 * h), product.0[row][column]);
                assert!((difference - exact).abs() < 1e-7 * (1.0 + exact.abs()), "{difference} {exact}");
            }
        }
        let eps = osc.stop(at.side).unwrap().restitution;
        let det = eps * eps * (-2.0 * osc.damping() * span).exp();
        assert!((product.determinant() / det - 1.0).abs() < 1e-9);
    }
}

/// The same neighbours described by phase and arrival speed: a second derivation of the derivative.
#[test]
fn the_impact_map_has_the_same_derivative() {
    for osc in systems() {
        let state = ImpactState { phase: 1.2, velocity: 1.9, side: Side::Upper };
        let limits = SearchLimits::default();
        let Mapped::Impact { state: next, interval } = impact_map(&osc, &state, limits) else { panic!() };
        // dx = -v dt, dv = sigma dU - a dt for an arrival dt later
        let basis = |at: &ImpactState| {
            let (sign, gap) = (at.side.sign(), osc.stop(at.side).unwrap().gap);
            let v = sign * at.velocity;
            let a = at.phase.sin() - sign * gap - 2.0 * osc.damping() * v;
            Matrix2([[-v / osc.beta(), 0.0], [-a / osc.beta(), sign]])
        };
        let direct = flight(&osc, interval).times(saltation(&osc, &state)).times(basis(&state));
        let round = basis(&next).times(derivative(&osc, &state, &next, interval));
        for (a, b) in direct.0.iter().flatten().zip(round.0.iter().flatten()) {
            assert!((a - b).abs() < 1e-11 * (1.0 + b.abs()), "{direct:?} {round:?}");
        }
    }
}
