//! One impact in n forcing periods: what the amplitude form of the equations gives, worked out here, and what Newton's
//! method and continuation find without it.

use crate::{Random, guess};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, SolutionPoint};
use vibroimpact::motion::derivative;
use vibroimpact::orbit::refine;
use vibroimpact::{Oscillator, Parameter};

/// The numbers of the closed form: steady amplitude parts, and what the flight over n periods does.
pub(crate) struct Form {
    beta: f64,
    eps: f64,
    zeta: f64,
    n: u32,
    /// Steady amplitude, and its parts in phase and in quadrature over its square.
    f: f64,
    s: f64,
    c: f64,
    /// `E`, `E cos`, `m12`.
    e: f64,
    e_cos: f64,
    m12: f64,
    /// The ellipse is `(delta - a U)^2 + (b U / beta)^2 = f^2`.
    a: f64,
    b: f64,
}

impl Form {
    pub(crate) fn new(beta: f64, eps: f64, zeta: f64, n: u32) -> Self {
        let period = TAU * f64::from(n) / beta;
        let wd = (1.0 - zeta * zeta).sqrt();
        let (e, c, s) = ((-zeta * period).exp(), (wd * period).cos(), (wd * period).sin());
        let (m11, m12, m22) = (e * (c + zeta * s / wd), e * s / wd, e * (c - zeta * s / wd));
        let den = m11 + m22 - 1.0 - e * e;
        let (a, b) = ((1.0 + eps) * m12 / den, 1.0 - (1.0 + eps) * (m22 - e * e) / den);
        let square = 1.0 / ((1.0 - beta * beta).powi(2) + (2.0 * zeta * beta).powi(2));
        let (s, c) = ((1.0 - beta * beta) * square, -2.0 * zeta * beta * square);
        Self { beta, eps, zeta, n, f: square.sqrt(), s, c, e, e_cos: e * (wd * period).cos(), m12, a, b }
    }

    /// The solutions at this gap: speed and phase.
    fn orbits(&self, gap: f64) -> Vec<(f64, f64)> {
        let q = self.b / self.beta;
        let (qa, qb, qc) = (self.a * self.a + q * q, -gap * self.a, gap * gap - self.f * self.f);
        let disc = qb * qb - qa * qc;
        if disc < 0.0 {
            return Vec::new();
        }
        // the root that adds, and the other by their product
        let large = -qb - qb.signum() * disc.sqrt();
        let mut speeds = vec![large / qa, qc / large];
        speeds.retain(|u| *u > 0.0);
        let phase = |u: f64| {
            let (p, r) = (gap - self.a * u, q * u);
            (self.s * p - self.c * r).atan2(self.c * p + self.s * r)
        };
        speeds.into_iter().map(|u| (u, phase(u))).collect()
    }

    fn determinant(&self) -> f64 {
        (self.eps * self.e).powi(2)
    }

    fn trace(&self, gap: f64, u: f64, phase: f64) -> f64 {
        -2.0 * self.eps * self.e_cos + (1.0 + self.eps) * self.m12 * (phase.sin() - gap) / u
    }

    /// Gap and speed of the fold with a positive gap-speed product `a`.
    pub(crate) fn fold(&self) -> (f64, f64) {
        let q = self.b / self.beta;
        let gap = self.f * (1.0 + (self.a / q).powi(2)).sqrt();
        (gap, self.a * gap / (self.a * self.a + q * q))
    }

    /// Gap and speed of the doubling with a positive speed.
    pub(crate) fn doubling(&self) -> (f64, f64) {
        let (zeta, beta) = (self.zeta, self.beta);
        let q = (-(1.0 + self.determinant()) + 2.0 * self.eps * self.e_cos) / ((1.0 + self.eps) * self.m12);
        let rho = -(q + (1.0 - beta * beta) * self.a - 2.0 * zeta * self.b) / (beta * beta);
        let u = self.f / ((rho - self.a).powi(2) + (self.b / beta).powi(2)).sqrt();
        (rho * u, u)
    }

    fn oscillator(&self, gap: f64) -> Oscillator {
        Oscillator::new(self.beta, gap, self.eps).unwrap().with_damping(self.zeta).unwrap()
    }
}

/// Random parameters, every other set undamped; not within a thousandth of a resonance of the closed form itself.
fn random(random: &mut Random, count: u32) -> Form {
    loop {
        let n = 1 + count % 3;
        let zeta = if count.is_multiple_of(2) { 0.0 } else { random.between(0.0, 0.3) };
        let form = Form::new(random.between(0.4, 3.0), random.between(0.1, 0.95), zeta, n);
        let turn = f64::from(n) / form.beta;
        let whole = (turn - turn.round()).abs() < 1e-2 && zeta < 1e-2;
        if !whole && (form.beta - 1.0).abs() > 1e-3 {
            return form;
        }
    }
}

#[test]
fn orbits_determinants_and_traces() {
    let mut numbers = Random(1);
    let (mut compared, mut physical) = (0, 0);
    for count in 0..600 {
        let form = random(&mut numbers, count);
        // at rest on the stop with no gap among them
        let gap = if count % 10 == 0 { 0.0 } else { form.f.min(5.0) * numbers.between(-1.0, 1.5) };
        let osc = form.oscillator(gap);
        for (u, phase) in form.orbits(gap) {
            let trace = form.trace(gap, u, phase);
            // the two solutions near a fold are as far apart as the root of the distance to it: ill-conditioned
            let condition = (1.0 / (1.0 + form.determinant() - trace)).abs();
            if condition > 1e2 || u < 1e-3 {
                continue;
            }
            let near = guess(phase + 1e-3, u * 1.001, form.n, osc.period());
            let orbit = refine(&osc, &near).unwrap();
            let cycle = &orbit.cycle;
            let state = cycle.points[0].state;
            assert!((state.velocity / u - 1.0).abs() < 1e-11, "{} {u} at {osc:?}", state.velocity);
            let off = (state.phase - phase + PI).rem_euclid(TAU) - PI;
            assert!(off.abs() < 1e-11, "{} {phase} at {osc:?}", state.phase);
            let [one, two] = cycle.multipliers;
            assert!(
                (one.re + two.re - trace).abs() < 1e-11 * (1.0 + trace.abs()),
                "{one:?} {two:?} {trace} at {osc:?}"
            );
            let map = derivative(&osc, &state, &state, cycle.points[0].interval);
            assert!(
                (map.determinant() - form.determinant()).abs() < 1e-11 * (1.0 + trace * trace),
                "{map:?} at {osc:?}"
            );
            assert_eq!(cycle.stable(), trace.abs() < 1.0 + form.determinant());
            compared += 1;
            physical += u32::from(orbit.physical);
        }
    }
    assert!(compared > 500 && physical > 100, "{compared} {physical}");
}

#[test]
fn resonance_and_even_frequencies() {
    let mut numbers = Random(2);
    for count in 0..60 {
        let (n, eps, gap) = (1 + count % 4, numbers.between(0.05, 0.95), numbers.between(-1.0, 5.0));
        // beta = 1: the same orbit for every gap
        let osc = Oscillator::new(1.0, gap, eps).unwrap();
        let u = PI * f64::from(n) / (1.0 + eps);
        let cycle = refine(&osc, &guess(FRAC_PI_2 + 1e-2, 1.01 * u, n, osc.period())).unwrap().cycle;
        let state = cycle.points[0].state;
        assert!((state.velocity - u).abs() < 1e-11 * u && (state.phase - FRAC_PI_2).abs() < 1e-11, "{state:?} {osc:?}");
        let [one, two] = cycle.multipliers;
        assert!((one.re + two.re + 2.0 * eps).abs() < 1e-11);
        // beta = 2n: the mass returns with its speed reversed; both multipliers eps
        let beta = 2.0 * f64::from(n);
        let f = 1.0 / (1.0 - beta * beta);
        let gap = f * numbers.between(-0.9, 0.9);
        let osc = Oscillator::new(beta, gap, eps).unwrap();
        let u = 2.0 * beta * (f * f - gap * gap).sqrt() / (1.0 - eps);
        let phase = (gap / f).atan2((1.0 - eps) * u / (2.0 * f * beta));
        let cycle = refine(&osc, &guess(phase + 1e-2, 1.01 * u, n, osc.period())).unwrap().cycle;
        let state = cycle.points[0].state;
        assert!((state.velocity / u - 1.0).abs() < 1e-11, "{} {u}", state.velocity);
        let [one, two] = cycle.multipliers;
        assert!((one.re + two.re - 2.0 * eps).abs() < 1e-11, "{one:?} {two:?}");
    }
}

/// The solutions of 1/n for all gaps are an ellipse in gap and speed. Continuation goes round it, through negative speeds
/// too, and must pass each fold and each doubling where the curves say.
#[test]
fn fold_and_doubling_curves() {
    let mut numbers = Random(3);
    let (mut folds, mut flips) = (0, 0);
    for count in 0..120 {
        let form = random(&mut numbers, count);
        let reach = 3.0 * form.fold().0.max(form.f);
        let start = form.orbits(0.3 * form.f);
        let Some(&(u, phase)) = start.first() else { continue };
        if reach > 50.0 || reach / form.f > 50.0 || u > 50.0 {
            continue;
        }
        let osc = form.oscillator(0.3 * form.f);
        let options = BranchOptions { keep_signature: true, ..Default::default() };
        let begin = guess(phase, u, form.n, osc.period());
        let branch = Branch::new(&osc, &begin, Parameter::Gap, -reach..=reach, Direction::Up, options).unwrap();
        let points: Vec<SolutionPoint> = branch.collect();
        assert_eq!(points.last().unwrap().event, Some(BranchEvent::Closed), "{osc:?} {:?}", points.last());
        let at = |event: BranchEvent| -> Vec<(f64, f64)> {
            let there = points.iter().filter(|p| p.event == Some(event));
            there.map(|p| (p.value, p.cycle.points[0].state.velocity)).collect()
        };
        // the ellipse is symmetric: (-delta, -U) with (delta, U)
        let same = |found: Vec<(f64, f64)>, (gap, u): (f64, f64)| {
            assert_eq!(found.len(), 2, "{found:?} {gap} at {osc:?}");
            for sign in [1.0, -1.0] {
                let close = |p: &&(f64, f64)| (p.0 - sign * gap).abs() < 1e-11 * (1.0 + gap.abs());
                let near = found.iter().find(close);
                // the speed at a fold is known to the root of that only
                let speed = near.unwrap_or_else(|| panic!("{found:?} {gap} at {osc:?}")).1;
                assert!((speed - sign * u).abs() < 1e-6 * (1.0 + u.abs()), "{speed} {u} at {osc:?}");
            }
        };
        same(at(BranchEvent::Fold), form.fold());
        same(at(BranchEvent::Flip), form.doubling());
        folds += 1;
        flips += 1;
    }
    assert!(folds > 80 && flips > 80, "{folds} {flips}");
}
