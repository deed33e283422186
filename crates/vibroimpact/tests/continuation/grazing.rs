//! At resonance with damping, beta = 1, zeta = 0.05, eps = 0.8, the gap going from 1 to loss of contact at |f| = 10: an
//! example often computed with collocation (H. Dankowicz & F. Schilder, Recipes for Continuation, SIAM 2013). Newton's
//! method has to converge as near to the grazing as one likes.

use crate::guess;
use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, EventDetail, SolutionPoint};
use vibroimpact::orbit::{FindOptions, find, refine};
use vibroimpact::{Label, Oscillator, Parameter};

fn at(gap: f64) -> Oscillator {
    Oscillator::new(1.0, gap, 0.8).unwrap().with_damping(0.05).unwrap()
}

/// Slope and intercept-free form of the ellipse of 1/1, `(delta - aU)^2 + (bU)^2 = f^2` with f = 10.
fn ellipse() -> (f64, f64) {
    let (zeta, eps, period) = (0.05_f64, 0.8, std::f64::consts::TAU);
    let wd = (1.0 - zeta * zeta).sqrt();
    let (e, c, s) = ((-zeta * period).exp(), (wd * period).cos(), (wd * period).sin());
    let (m11, m12, m22) = (e * (c + zeta * s / wd), e * s / wd, e * (c - zeta * s / wd));
    let den = m11 + m22 - 1.0 - e * e;
    ((1.0 + eps) * m12 / den, 1.0 - (1.0 + eps) * (m22 - e * e) / den)
}

#[test]
fn from_gap_one_to_the_grazing() {
    let orbits = find(&at(1.0), Label::new(1, 1), FindOptions::default());
    let begin = &orbits.iter().find(|o| o.physical).unwrap().cycle;
    let range = 1.0..=12.0;
    let branch = Branch::new(&at(1.0), begin, Parameter::Gap, range, Direction::Up, BranchOptions::default()).unwrap();
    let points: Vec<SolutionPoint> = branch.collect();
    let (a, b) = ellipse();
    for point in points.iter().filter(|p| !p.cycle.points.is_empty()) {
        assert!(point.physical);
        let u = point.cycle.points[0].state.velocity;
        let off = (point.value - a * u).powi(2) + (b * u).powi(2) - 100.0;
        assert!(off.abs() < 1e-11, "{off:e} at {}", point.value);
    }
    let events: Vec<(BranchEvent, f64)> = points.iter().filter_map(|p| Some((p.event?, p.value))).collect();
    let [(BranchEvent::Fold, fold), (event @ BranchEvent::Grazing { turns, .. }, graze), (end, _)] = events[..] else {
        panic!("{events:?}")
    };
    let EventDetail { phase, labels: (_, after), .. } = event.detail().unwrap();
    // the gentle orbit comes from above, and the motion without impacts goes back up
    assert!(after == Some(Label::new(0, 1)) && turns && end == BranchEvent::EndOfRange);
    assert!((fold - 10.0 * (1.0 + (a / b).powi(2)).sqrt()).abs() < 1e-11, "{fold}");
    assert!((graze - 10.0).abs() < 1e-11, "{graze}");
    // the steady motion is a quarter of a period behind
    assert!((phase - std::f64::consts::PI).abs() < 1e-9, "{phase}");
}

#[test]
fn newton_converges_at_every_distance() {
    let (a, b) = ellipse();
    for k in 3..=10 {
        let d = 10_f64.powi(-k);
        let gap = 10.0 + d;
        // the gentle orbit: U is the small root; delta - f is exact
        let off = gap - 10.0;
        let (qa, qb, qc) = (a * a + b * b, gap * a, off * (gap + 10.0));
        let u = qc / (qb + (qb * qb - qa * qc).sqrt());
        let osc = at(gap);
        // from twice and from half the speed, and a phase off by much more than the distance
        for (factor, shift) in [(2.0, 1e-3), (0.5, -1e-3), (1.0, 1e-2)] {
            let orbit = refine(&osc, &guess(std::f64::consts::PI + shift, factor * u, 1, osc.period())).unwrap();
            let found = orbit.cycle.points[0].state.velocity;
            assert!((found - u).abs() < 1e-12, "{d:e}: {found} {u}");
            assert!(orbit.physical, "{d:e}: {orbit:?}");
            assert!(orbit.cycle.residual < 1e-13 && orbit.cycle.multipliers[0].re > 1.0);
        }
        // on the other side of the grazing it goes on, with a negative speed: a solution, but no motion
        let osc = at(10.0 - d);
        let orbit = refine(&osc, &guess(std::f64::consts::PI, u, 1, osc.period())).unwrap();
        assert!(orbit.cycle.points[0].state.velocity < 0.0 && !orbit.physical, "{d:e}: {orbit:?}");
    }
}
