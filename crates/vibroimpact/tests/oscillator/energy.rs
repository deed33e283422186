//! Exact identities: energy and the force's work, through impacts, damping and both stops.
//!
//! The work of the force is integrated by Gauss-Legendre quadrature along the flights, independently of the impact
//! search, and compared with what the impacts and the damper took.

use super::is_long;
use vibroimpact::motion::{EventKind, Motion, Path};
use vibroimpact::verdict::{SettleOptions, Verdict, settle};
use vibroimpact::{Oscillator, Start, scenario};

/// Nodes and weights of the 16-point rule on [-1, 1], by Newton's method on the Legendre polynomial.
fn gauss() -> Vec<(f64, f64)> {
    let n = 16.0_f64;
    let mut rule = Vec::new();
    for k in 0..16 {
        let mut x = (std::f64::consts::PI * (f64::from(k) + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..60 {
            let (mut p0, mut p1) = (1.0, x);
            for j in 2..=16 {
                let j = f64::from(j);
                (p0, p1) = (p1, ((2.0 * j - 1.0) * x * p1 - (j - 1.0) * p0) / j);
            }
            slope = n * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / slope;
        }
        rule.push((x, 2.0 / ((1.0 - x * x) * slope * slope)));
    }
    rule
}

/// Work of the force and loss in the damper along a leg.
fn work_and_loss(osc: &Oscillator, motion: &Motion<'_>, rule: &[(f64, f64)]) -> (f64, f64) {
    let leg = motion.leg().unwrap();
    let Path::Flight(flight) = leg.path else { return (0.0, 0.0) };
    let pieces = (leg.duration * (1.0 + osc.beta()) / 2.0).ceil().max(1.0);
    let h = leg.duration / pieces;
    let (mut work, mut loss) = (0.0, 0.0);
    let mut k = 0.0;
    while k < pieces {
        for (x, w) in rule {
            let s = h * (k + 0.5 * (x + 1.0));
            let v = flight.at(s).v;
            let force = (leg.phase + osc.beta() * s).sin();
            work += 0.5 * h * w * force * v;
            loss += 0.5 * h * w * 2.0 * osc.damping() * v * v;
        }
        k += 1.0;
    }
    (work, loss)
}

#[test]
fn elastic_and_undamped_over_many_impacts() {
    let most = if is_long() { 1_000_000 } else { 300_000 };
    let rule = gauss();
    let osc = Oscillator::new(1.7, 0.3, 1.0).unwrap();
    let mut motion = Motion::new(&osc, Start::at_rest(&osc));
    let energy = |u: f64| 0.5 * (0.3 * 0.3 + u * u);
    // compensated sums: what is tested is the motion, not the adding up
    let (mut sum, mut low, mut turnover) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut worst = 0.0_f64;
    let mut impacts = 0;
    while impacts < most {
        let event = motion.next().unwrap();
        let (work, _) = work_and_loss(&osc, &motion, &rule);
        let t = sum + work;
        low += if sum.abs() >= work.abs() { (sum - t) + work } else { (work - t) + sum };
        sum = t;
        turnover += work.abs();
        if let EventKind::Impact { velocity_before, .. } = event.kind {
            impacts += 1;
            // the energy now is what the force put in since the start from rest
            let now = energy(velocity_before);
            worst = worst.max((now - (sum + low)).abs() / now.max(1.0));
        }
    }
    assert!(worst < 1e-10, "worst relative imbalance {worst:e} over a turnover of {turnover:.3e}");
    println!("worst relative imbalance over {most} impacts: {worst:.2e}");
}

#[test]
fn over_a_cycle_the_work_is_what_impacts_and_damper_take() {
    let rule = gauss();
    let mut cycles = 0;
    let damped = [(1.0 / 1.3, 0.75, 0.5, 0.05), (0.9, -0.4, 0.6, 0.1), (1.0, 0.5, 0.8, 0.02)];
    let systems = scenario::PAPER
        .iter()
        .map(|point| point.oscillator())
        .chain(damped.iter().map(|(b, g, e, z)| Oscillator::new(*b, *g, *e).unwrap().with_damping(*z).unwrap()))
        .chain([Oscillator::new(0.8, 0.6, 0.7).unwrap().with_second_stop(0.6, 0.7).unwrap()]);
    for osc in systems {
        for x in [0.0_f64, -1.3] {
            let start = Start { x: x.min(osc.gap()), ..Start::at_rest(&osc) };
            if Start::new(&osc, start.x, 0.0, 0.0).is_err() {
                continue;
            }
            let Verdict::Periodic(cycle) = settle(&osc, start, &SettleOptions::default()).verdict else { continue };
            if !cycle.rests.is_empty() {
                continue;
            }
            cycles += 1;
            let mut motion = Motion::new(&osc, cycle.points[0].state.rebound(&osc));
            let (mut put_in, mut taken) = (0.0, 0.0);
            for _ in 0..cycle.points.len() {
                let event = motion.next().unwrap();
                let (work, loss) = work_and_loss(&osc, &motion, &rule);
                let EventKind::Impact { velocity_before: u, velocity_after: w } = event.kind else { panic!() };
                put_in += work;
                taken += loss + 0.5 * (u * u - w * w);
            }
            assert!((put_in - taken).abs() < 1e-12 * (1.0 + taken), "{}: {put_in} {taken}", cycle.label);
        }
    }
    assert!(cycles >= 8, "{cycles}");
}

/// Two-sided symmetric stops with one impact on each side per forcing period: the half-period map with the sign of the
/// return flipped lies on the same ellipse as the one-sided orbit of the doubled frequency does.
#[test]
fn symmetric_stops_are_struck_in_turn_with_equal_speed() {
    let mut found = 0;
    for beta in [0.6, 0.8, 1.2, 1.6] {
        for gap in [0.3, 0.6, 1.0] {
            let osc = Oscillator::new(beta, gap, 0.8).unwrap().with_second_stop(gap, 0.8).unwrap();
            let Verdict::Periodic(cycle) = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict else {
                continue;
            };
            let [a, b] = cycle.points.as_slice() else { continue };
            if a.state.side == b.state.side || cycle.label.periods != 1 {
                continue;
            }
            // symmetric orbits only: equal speeds half a turn apart
            if (a.state.velocity - b.state.velocity).abs() > 1e-9 {
                continue;
            }
            found += 1;
            // (delta - aU)^2 + (bU/beta)^2 = f^2 with T/2 for T and the return mirrored
            let t = osc.period() / 2.0;
            let (c, s) = (t.cos(), t.sin());
            let (eps, f, u) = (0.8, 1.0 / (1.0 - beta * beta), a.state.velocity);
            // x(0) = gap, v(0) = -eps u; x(t) = -gap, v(t) = -u, free part = total - f sin, mirrored by half a turn
            // free displacement D = gap - f sin(theta), free velocity C = -eps u - f beta cos(theta); after half a turn
            // both must be -D and (-u + f beta cos) = D s - ... : two linear equations in sin, cos
            let (m11, m12, m21, m22) = (c + 1.0, s, -s, c + 1.0);
            // D (c+1) + C s = 0 ; -D s + C (c+1) + eps u + u ... = 0
            let det = m11 * m22 - m12 * m21;
            let rhs = [0.0, -(1.0 + eps) * u];
            let (d, cc) = ((rhs[0] * m22 - m12 * rhs[1]) / det, (m11 * rhs[1] - m21 * rhs[0]) / det);
            let (sin, cos) = ((gap - d) / f, (-eps * u - cc) / (f * beta));
            assert!((sin * sin + cos * cos - 1.0).abs() < 1e-10, "beta {beta} gap {gap}: {}", sin * sin + cos * cos);
        }
    }
    assert!(found >= 3, "{found}");
}

/// Without damping, the energy of a flight changes by the work of the force, here integrated by Simpson's rule, and
/// an elastic impact does not change it.
#[test]
fn energy_balance_of_elastic_impacts() {
    let osc = Oscillator::new(1.7, 0.3, 1.0).unwrap();
    let energy = |(x, v): (f64, f64)| 0.5 * (x * x + v * v);
    let mut motion = Motion::new(&osc, Start::at_rest(&osc));
    let mut after = energy((Start::at_rest(&osc).x, Start::at_rest(&osc).v));
    let mut most: f64 = 0.0;
    for _ in 0..200 {
        let event = motion.next().unwrap();
        let EventKind::Impact { velocity_before, velocity_after } = event.kind else { panic!() };
        let leg = *motion.leg().unwrap();
        let power = |s: f64| (leg.phase + osc.beta() * s).sin() * leg.state(&osc, s).1;
        let h = leg.duration / 400.0;
        let weighted = (0..=400).map(|k| match k {
            0 | 400 => power(h * f64::from(k)),
            _ => f64::from(2 + 2 * (k % 2)) * power(h * f64::from(k)),
        });
        let work = weighted.sum::<f64>() * h / 3.0;
        let before = energy((osc.gap(), velocity_before));
        assert!((before - after - work).abs() < 1e-8, "{event:?}: {before} {after} {work}");
        after = energy((osc.gap(), velocity_after));
        assert_eq!(before, after);
        most = most.max(work.abs());
    }
    // the work that the balance has to account for
    assert!(most > 0.1, "{most}");
}
