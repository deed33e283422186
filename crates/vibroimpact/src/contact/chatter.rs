//! The completion of a chatter: infinitely many impacts in finite time, summed.
//!
//! After an impact with rebound speed $`w`$ at phase $`\theta`$, let $`a = \sin\theta - \delta > 0`$ be the
//! acceleration into the stop, and $`j = \beta\cos\theta`$ and $`q = -\beta^2\sin\theta`$ its first two time
//! derivatives. The flight $`y(s) = -ws + \tfrac12(a + 2\zeta w)s^2 + \dots`$ returns after
//!
//! $$`s = \frac{2w}{a} - \frac{4(j+\zeta a)}{3a^3}w^2
//!      + \frac{2\,(8j^2 + 10\zeta aj + 8\zeta^2a^2 - 3a^2 - 3aq)}{9a^5}w^3 + O(w^4)`$$
//!
//! with the speed
//!
//! $$`u = w - \frac{2(2\zeta a - j)}{3a^2}w^2 + \frac{2\,(8\zeta^2a^2 - 2\zeta aj - 4j^2 + 3aq)}{9a^4}w^3 + O(w^4).`$$
//!
//! The time $`\tau_\infty(\theta, w)`$ to the accumulation point satisfies
//! $`\tau_\infty(\theta, w) = s + \tau_\infty(\theta + \beta s, \varepsilon u)`$. A power series in $`w`$, with
//! coefficients that depend on $`\theta`$ through $`a, j, q`$, is inserted and powers are compared. With
//! $`r = 1 - \varepsilon`$ this gives
//!
//! $$`\tau_\infty = \frac{2w}{ar} - \frac{4(j + \zeta a)}{3a^3r^2}w^2 +
//!   \frac{8(2+3\varepsilon+2\varepsilon^2)j^2 - 6(1+\varepsilon)^2aq + 4(5+6\varepsilon+5\varepsilon^2)\zeta aj
//!         + 16(1+\varepsilon^2)\zeta^2a^2 - 6r^2a^2}{9\,a^5r^3(1+\varepsilon+\varepsilon^2)}w^3 + O(w^4).`$$
//!
//! The first two terms are those of A. B. Nordmark and P. T. Piiroinen, "Simulation and stability analysis of impacting
//! systems with complete chattering", Nonlinear Dyn. 58 (2009) 85-106, doi:10.1007/s11071-008-9463-y. The series is one
//! in powers of a small number, estimated as $`\rho = \max(|\tau_2|/\tau_1, \sqrt{|\tau_3|/\tau_1})`$. The sum is used
//! only if $`\rho \le 10^{-4}`$, and its error is then at most about $`10\,\tau_1\rho^3 \le 10^{-11}\tau_1`$. A small
//! $`\rho`$ also shows that the chatter is complete: during $`\tau_\infty`$ the force changes by a fraction of order
//! $`\rho`$, and each rebound is smaller than the one before.

use super::ImpactState;
use super::mirrored;
use crate::math::sin_cos;
use crate::system::{Oscillator, Side};

/// The sum of a chatter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Completion {
    /// Time from the impact to the accumulation point.
    pub duration: f64,
    /// Estimated bound of the error of `duration`.
    pub error: f64,
}

/// The largest small parameter for which the third-order sum is used. The error is of the order of its cube, a few
/// parts in 1e12. A larger value saves impacts (about three for each factor of 10 at restitution 1/2) and loses
/// accuracy.
pub const DEFAULT_SMALLNESS: f64 = 1e-4;

/// A chatter is not summed if the rebound speed exceeds this times the acceleration into the stop. The small parameter
/// is of the order of this quotient; if it is smaller by a coincidence of parameters, it does not measure the error.
pub(crate) const SLOW: f64 = 0.01;

/// Whether the leg after an impact is not a flight, because the chatter is complete or the rebound speed is zero.
pub(crate) fn settles_after(osc: &Oscillator, state: &ImpactState) -> bool {
    let rebound = state.rebound(osc).v.abs();
    rebound == 0.0 || completion(osc, state.side, state.phase, rebound, DEFAULT_SMALLNESS).is_some()
}

/// The accumulation of the chatter that follows an impact with rebound speed `rebound` on the stop at `side`; `None` if
/// it is not certain that the chatter is complete, or if the accumulation point is too far away for the sum to be
/// accurate.
#[must_use]
pub fn completion(osc: &Oscillator, side: Side, phase: f64, rebound: f64, smallness: f64) -> Option<Completion> {
    let stop = osc.stop(side)?;
    let (sin, cos) = sin_cos(mirrored(side, phase));
    let (w, eps, zeta, beta) = (rebound, stop.restitution, osc.damping(), osc.beta());
    let (a, j, q) = (sin - stop.gap, beta * cos, -beta * beta * sin);
    let r = 1.0 - eps;
    if !(a > 0.0 && r > 0.0 && w < SLOW * a) {
        return None;
    }
    // all terms divided by the first, as products that do not underflow if the force a, and with it the speed w, is
    // tiny
    let k = w / a;
    let (jerk, snap, drag) = (j / a * k, q / a * k * k, zeta * k);
    let first = 2.0 * k / r;
    let second = -2.0 * (jerk + drag) / (3.0 * r);
    let sum = 8.0 * (2.0 + 3.0 * eps + 2.0 * eps * eps) * jerk * jerk - 6.0 * (1.0 + eps) * (1.0 + eps) * snap
        + 4.0 * (5.0 + 6.0 * eps + 5.0 * eps * eps) * drag * jerk
        + 16.0 * (1.0 + eps * eps) * drag * drag
        - 6.0 * r * r * k * k;
    let third = sum / (18.0 * r * r * (1.0 + eps + eps * eps));
    // near the smallest doubles j / a is infinite, and then nothing is known of the sum
    let rho = second.abs().max(third.abs().sqrt());
    (second.is_finite() && third.is_finite() && rho <= smallness)
        .then_some(Completion { duration: first * (1.0 + second + third), error: 10.0 * first * rho * rho * rho })
}
