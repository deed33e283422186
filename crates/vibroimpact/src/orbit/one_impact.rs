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
