//! Orbits with one impact in n forcing periods, in closed form that also holds at resonance.
//!
//! A flight from $`x = \delta`$, $`v = -\varepsilon U`$ at phase $`\theta`$ must arrive after $`T = 2\pi n/\beta`$ at
//! $`x = \delta`$ with $`v = U`$. With the propagator at $`T`$ this is linear in $`\sin\theta`$, $`\cos\theta`$ and
//! $`U`$:
//!
//! $$`\begin{pmatrix} K_c & K_s \\ S - \beta K_s & \beta K_c \end{pmatrix}
//!   \begin{pmatrix} \sin\theta \\ \cos\theta \end{pmatrix} =
//!   \begin{pmatrix} \delta(1-C) \\ \delta S \end{pmatrix} +
//!   U \begin{pmatrix} \varepsilon S \\ 1 + \varepsilon(C - 2\zeta S) \end{pmatrix},`$$
//!
//! and with $`\sin^2\theta + \cos^2\theta = 1`$ this gives a quadratic in $`U`$, so there are at most two orbits. No
//! formula divides by $`1-\beta^2`$. Away from resonance this is the ellipse of Shaw & Holmes (J. Sound Vib. 90 (1983)
//! 129-155, doi:10.1016/0022-460X(83)90407-8). An algebraic solution can be inadmissible, because its flight passes
//! through a stop. [`OneImpact::physical`] states this; it is computed from the flight.

use super::ring::Ring;
use super::{Cycle, earlier_contact, free, newton, shooting};
use crate::math::{atan2, sort_by};
use crate::motion::ImpactState;
use crate::system::{Oscillator, Side, phase};

/// A solution of the equations for one impact in n forcing periods on the first stop.
#[derive(Clone, Debug, PartialEq)]
pub struct OneImpact {
    /// The cycle, with its multipliers, also if it is inadmissible.
    pub cycle: Cycle,
    /// Whether it is admissible: the flight reaches no stop before its end.
    pub physical: bool,
}

impl OneImpact {
    fn judged(osc: &Oscillator, cycle: Cycle) -> Self {
        Self { physical: earlier_contact(osc, &cycle).is_none(), cycle }
    }
}

/// All solutions with one impact on the first stop in `n` forcing periods, the slower arrival first.
///
/// At $`U = 0`$ the quadratic is $`\delta^2/f^2 - 1`$. If the gap equals $`|f|`$, exactly or to within the rounding
/// error of $`|f|`$, one root is 0. That is the motion without impacts, which grazes the stop, and it is not listed.
///
/// ```
/// use vibroimpact::{Oscillator, orbit::one_impact};
/// // T of the 1971 paper: the fundamental motion exists and is unstable
/// let osc = Oscillator::from_inverse_beta(1.11, 2.0, 0.5)?;
/// let orbits = one_impact(&osc, 1);
/// let physical: Vec<_> = orbits.iter().filter(|o| o.physical).collect();
/// assert_eq!(physical.len(), 1);
/// assert!(!physical[0].cycle.stable());
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn one_impact(osc: &Oscillator, n: u32) -> Vec<OneImpact> {
    let (beta, eps, gap) = (osc.beta(), osc.restitution(), osc.gap());
    let interval = osc.period() * f64::from(n);
    if interval < TINY && gap < 0.0 {
        return bouncing(osc, n);
    }
    let p = osc.response().at(interval);
    let (a, b, c, d) = (p.kc, p.ks, p.s - beta * p.ks, beta * p.kc);
    let det = a * d - b * c;
    // n/beta is a whole number and there is no resonance: the force does no net work on the oscillator, so no such
    // orbit exists
    let scale = osc.free_amplitude().min(interval);
    if det.abs() <= 1e-13 * scale * scale {
        return Vec::new();
    }
    let solve = |r: [f64; 2]| [(d * r[0] - b * r[1]) / det, (a * r[1] - c * r[0]) / det];
    let base = solve([gap * p.one_minus_c, gap * p.s]);
    let slope = solve([eps * p.s, 1.0 + eps * p.s_rate]);
    // the quadratic |base + U slope|^2 = 1
    let (qa, qb) = (slope[0] * slope[0] + slope[1] * slope[1], base[0] * slope[0] + base[1] * slope[1]);
    let qc = base[0] * base[0] + base[1] * base[1] - 1.0;
    // this is delta^2/f^2 - 1, which loses digits where the motion without impacts grazes the stop
    let qc = if qc.abs() < NEAR_TOUCH { free::excess(osc, Side::Upper) } else { qc };
    let disc = qb * qb - qa * qc;
    if !(disc >= 0.0 && qa > 0.0) {
        return Vec::new();
    }
    // the root in which nothing cancels; the other one from the product of both
    let large = if qb > 0.0 { -qb - disc.sqrt() } else { -qb + disc.sqrt() };
    let mut roots = [large / qa, if large == 0.0 { 0.0 } else { qc / large }];
    sort_by(&mut roots, f64::total_cmp);
    // there one root is exactly 0; if the other one is 0 too, it is so to within the rounding errors of base and slope
    let rounding = f64::EPSILON * (4.0 + 2.0 * interval) * (a * a + b * b + c * c + d * d) / det.abs();
    let zero = if qc == 0.0 { 2.0 * rounding / qa.sqrt() } else { 0.0 };
    let mut orbits = Vec::new();
    for velocity in roots {
        if !(velocity > zero && velocity.is_finite()) {
            continue;
        }
        let theta = phase::wrap(atan2(base[0] + velocity * slope[0], base[1] + velocity * slope[1]));
        let state = ImpactState { phase: theta, velocity, side: Side::Upper };
        let cycle = shooting::assemble(osc, vec![(state, interval)], n, 0.0);
        let cycle = if interval < SHORT { polished(osc, &cycle).unwrap_or(cycle) } else { cycle };
        orbits.push(OneImpact::judged(osc, cycle));
    }
    orbits
}

/// If the square of the gap over the amplitude differs from 1 by less than this, the difference is computed without
/// cancellation.
const NEAR_TOUCH: f64 = 1e-6;

/// Intervals in which Newton's method follows the closed form. Over a short interval the coefficients are differences of
/// nearly equal numbers: at $`\beta = 640`$ the speed from the closed form is right to $`10^{-5}`$ only. The equations of
/// the flight divide the distance by the interval, so they lose nothing.
const SHORT: f64 = 1.0;
/// Newton's method moves the speed by less than this, relative to it; otherwise it has found another cycle.
const MOVED: f64 = 1e-2;

/// Intervals over which the closed form has too few digits left for Newton's method. There the flight is that of a ball on
/// a vibrating table, with a relative error of the order of the square of the interval.
const TINY: f64 = 0.02;

/// The solutions over a tiny interval $`T`$ with a stop that presses. Over it the force less that of the spring is
/// $`\sin(\theta + \beta s) - \delta`$, so that
///
/// $$`(1+\varepsilon)U = -\delta T, \qquad \cos\theta = \pi n\delta\frac{1-\varepsilon}{1+\varepsilon};`$$
///
/// Newton's method on the equations of the flight leads from there to the cycle.
fn bouncing(osc: &Oscillator, n: u32) -> Vec<OneImpact> {
    let (eps, gap) = (osc.restitution(), osc.gap());
    let interval = osc.period() * f64::from(n);
    let cosine = core::f64::consts::PI * f64::from(n) * gap * (1.0 - eps) / (1.0 + eps);
    let sine = (1.0 - cosine * cosine).sqrt();
    let orbit = |sine: f64| {
        let velocity = -gap * interval / (1.0 + eps);
        let state = ImpactState { phase: phase::wrap(atan2(sine, cosine)), velocity, side: Side::Upper };
        polished(osc, &shooting::assemble(osc, vec![(state, interval)], n, 0.0))
            .map(|cycle| OneImpact::judged(osc, cycle))
    };
    // beyond the fold the sine is not a number, and there is no cycle
    let mut orbits: Vec<OneImpact> = [sine, -sine].into_iter().filter(|s| s.is_finite()).filter_map(orbit).collect();
    let speed = |of: &OneImpact| of.cycle.points.first().map_or(0.0, |point| point.state.velocity);
    sort_by(&mut orbits, |a, b| speed(a).total_cmp(&speed(b)));
    orbits
}

/// The cycle after Newton's method on the equations of its flight.
fn polished(osc: &Oscillator, cycle: &Cycle) -> Option<Cycle> {
    let (ring, flights) = newton::solve(osc, Ring::of(osc, cycle)?)?;
    let better = newton::cycle(osc, &ring, &flights);
    let (before, after) = (cycle.points.first()?.state, better.points.first()?.state);
    let near = (after.velocity / before.velocity - 1.0).abs() < MOVED
        && phase::difference(after.phase, before.phase).abs() < MOVED;
    near.then_some(better)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1/beta, delta, n, U, theta, trace; computed in 40-digit arithmetic from the amplitude form of the equations.
    const TABLE: [(f64, f64, u32, f64, f64, f64); 3] = [
        (1.11, 2.0, 1, 1.579_471_043_444_031_3, 1.488_135_732_365_034, -1.377_932_200_888_471),
        (1.11, 2.0, 2, 3.547_778_641_985_508_3, 1.384_257_046_450_963_5, -0.609_896_976_682_181_3),
        (1.3, 0.75, 1, 2.797_349_151_953_767_4, 1.190_509_613_787_888_5, 0.400_077_661_640_385),
    ];

    #[test]
    fn table_of_known_orbits() {
        for (inverse, gap, n, velocity, theta, trace) in TABLE {
            let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
            let orbits = one_impact(&osc, n);
            let orbit = orbits.iter().find(|o| (o.cycle.points[0].state.velocity - velocity).abs() < 1e-12).unwrap();
            assert!((orbit.cycle.points[0].state.phase - theta).abs() < 1e-13);
            let [one, two] = orbit.cycle.multipliers;
            assert!((one.re + two.re - trace).abs() < 1e-12, "{one:?} {two:?}");
            assert!(orbit.physical);
        }
    }

    /// A ball on a table, the limit of high frequency ratios: the flight from the impact arrives with the same phase and
    /// speed, whose relative accuracy does not depend on the frequency ratio.
    #[test]
    fn high_frequency_ratios_lose_no_digits() {
        for beta in [10.0, 40.0, 160.0, 640.0, 2560.0, 1e5] {
            let osc = Oscillator::new(beta, -1.0 / (0.4 * core::f64::consts::PI), 0.5).unwrap();
            let orbits = one_impact(&osc, 1);
            assert_eq!(orbits.len(), 2, "{beta}");
            for orbit in &orbits {
                assert!(orbit.physical, "{beta}");
                let state = orbit.cycle.points[0].state;
                let next =
                    crate::motion::Motion::after(&osc, &state, crate::flight::SearchLimits::default()).next().unwrap();
                let crate::motion::EventKind::Impact { velocity_before, .. } = next.kind else { panic!("{next:?}") };
                let (moved, ratio) = (phase::difference(next.phase, state.phase), velocity_before / state.velocity);
                assert!(moved.abs() < 1e-12 && (ratio - 1.0).abs() < 1e-12, "{beta}: {moved:e} {:e}", ratio - 1.0);
                // the work of the force is what the impact takes
                let of = crate::quantities::of_cycle(&osc, &orbit.cycle).unwrap();
                let lost = of.get(crate::quantities::Quantity::ImpactLossPerPeriod);
                let work = of.get(crate::quantities::Quantity::WorkPerPeriod);
                assert!((work / lost - 1.0).abs() < 1e-11, "{beta}: {work} {lost}");
            }
        }
    }

    #[test]
    fn resonance_and_twice_n() {
        let at = |beta: f64, gap: f64, n| one_impact(&Oscillator::new(beta, gap, 0.5).unwrap(), n).pop().unwrap().cycle;
        for gap in [-0.5, 0.3, 2.0] {
            for n in [1, 2] {
                let cycle = at(1.0, gap, n);
                let pi_n = core::f64::consts::PI * f64::from(n);
                assert!((cycle.points[0].state.velocity - pi_n / 1.5).abs() < 1e-13);
                assert!((cycle.points[0].state.phase - core::f64::consts::FRAC_PI_2).abs() < 1e-13);
                assert!(cycle.multipliers.iter().all(|m| (m.re + 0.5).abs() < 1e-7 && m.im.abs() < 1e-7));
            }
        }
        let f = 1.0 / (1.0 - 4.0_f64);
        let cycle = at(2.0, 0.2, 1);
        assert!((cycle.points[0].state.velocity - 4.0 * (f * f - 0.04_f64).sqrt() / 0.5).abs() < 1e-13);
    }

    #[test]
    fn whole_natural_periods_drive_no_orbit() {
        for (inverse, n) in [(1.5, 2), (0.5, 2), (2.0, 1), (3.0, 1), (1.0 / 3.0, 3)] {
            for gap in [0.1, 0.5, 1.3] {
                let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
                assert_eq!(one_impact(&osc, n).len(), 0, "1/beta {inverse} n {n} gap {gap}");
            }
        }
    }

    /// On the fold curve both roots coincide and a multiplier is +1; on the flip curve one is -1 (closed forms from the
    /// amplitude equations, derived independently of the code above).
    #[test]
    fn fold_and_doubling_curves() {
        for (beta, eps, zeta) in [(0.8, 0.5, 0.0), (1.4, 0.7, 0.05), (0.9, 0.3, 0.2), (2.6, 0.6, 0.01_f64)] {
            let (wd, period) = ((1.0 - zeta * zeta).sqrt(), core::f64::consts::TAU / beta);
            let (e, c, s) = ((-zeta * period).exp(), (wd * period).cos(), (wd * period).sin());
            let (m11, m12, m22) = (e * (c + zeta * s / wd), e * s / wd, e * (c - zeta * s / wd));
            let den = m11 + m22 - 1.0 - e * e;
            let (a, b) = ((1.0 + eps) * m12 / den, 1.0 - (1.0 + eps) * (m22 - e * e) / den);
            let f = 1.0 / ((1.0 - beta * beta).powi(2) + (2.0 * zeta * beta).powi(2)).sqrt();
            let det = (eps * e).powi(2);
            let q = (-(1.0 + det) + 2.0 * eps * e * c) / ((1.0 + eps) * m12);
            let rho = -(q + (1.0 - beta * beta) * a - 2.0 * zeta * b) / (beta * beta);
            let velocity = f / ((rho - a).powi(2) + (b / beta).powi(2)).sqrt();
            let osc = Oscillator::new(beta, rho * velocity, eps).unwrap().with_damping(zeta).unwrap();
            let orbit = one_impact(&osc, 1)
                .into_iter()
                .find(|o| (o.cycle.points[0].state.velocity / velocity - 1.0).abs() < 1e-9)
                .unwrap();
            let [one, two] = orbit.cycle.multipliers;
            assert!((one.re + 1.0).abs() < 1e-10 && (two.re + det).abs() < 1e-10, "{one:?} {two:?}");
            // just inside the fold the two orbits are close, with multipliers on either side of +1
            let fold = f * (1.0 + (beta * a / b).powi(2)).sqrt() * a.signum();
            let near = Oscillator::new(beta, fold * (1.0 - 1e-8), eps).unwrap().with_damping(zeta).unwrap();
            let past = Oscillator::new(beta, fold * (1.0 + 1e-8), eps).unwrap().with_damping(zeta).unwrap();
            let two_orbits = one_impact(&near, 1);
            assert_eq!((two_orbits.len(), one_impact(&past, 1).len()), (2, 0));
            let large: Vec<f64> = two_orbits.iter().map(|o| o.cycle.multipliers[0].re).collect();
            assert!(large.iter().any(|m| *m > 1.0) && large.iter().any(|m| *m < 1.0), "{large:?}");
        }
    }
}
