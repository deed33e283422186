//! One flight: the closed-form motion of the mass from a state until it reaches a stop.
//!
//! Positions are computed as displacements from the start. So the distance from a stop loses no digits if the flight
//! begins on that stop and is short. Chatter needs this: flights of $`10^{-9}`$ must be correct to their last bits. For
//! such flights the arc is summed as its Taylor series,
//!
//! $$`x^{(k+2)} = \beta^k \sin(\varphi + k\pi/2) - x^{(k)} - 2\zeta x^{(k+1)},`$$
//!
//! while $`\mu s`$ is small, where $`\mu = \max(\beta, 1 + 2\zeta)`$ is the fastest rate in the system. Otherwise it is
//! computed from [`Response`](super::Response).

use crate::math::sin_cos;
use crate::system::Response;
use crate::system::{Oscillator, Side, Start, phase};

/// A point of a flight, a time `s` after its beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlightPoint {
    /// Displacement $`x(s) - x_0`$ since the beginning.
    pub displacement: f64,
    /// Position.
    pub x: f64,
    /// Whether the free part has changed so much that the position is more accurate than the displacement.
    pub(super) far: bool,
    /// Velocity.
    pub v: f64,
    /// Acceleration.
    pub a: f64,
    /// Third derivative.
    pub j: f64,
    /// A bound on the rounding error of `displacement`, from the size of its terms and of its arguments.
    pub rounding: f64,
}

/// The closed-form motion from a state, as long as no stop is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    response: Response,
    /// Position at the beginning.
    pub x: f64,
    /// Velocity at the beginning.
    pub v: f64,
    /// Phase of the force at the beginning.
    pub phase: f64,
    /// Sine and cosine of this phase.
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    /// Acceleration at the beginning.
    pub(super) a: f64,
    pub(super) fastest: f64,
}

/// The largest number of terms of the Taylor series, and the largest $`\mu s`$ for which it suffices: the first omitted
/// term is below $`2^{-64}`$ of the leading ones.
const TERMS: usize = 32;
const LONG_REACH: f64 = 3.0;
/// Up to this value twelve terms suffice.
const SHORT_TERMS: usize = 12;
const SHORT_REACH: f64 = 0.25;
/// The terms of the closed form are of the size of the time of flight, so at speeds below this it would lose digits of
/// the displacement. The series is then used as far as it is accurate; at higher speeds only where it is cheap.
const SLOW: f64 = 0.125;
/// 1/k for each index k.
const INVERSE: [f64; TERMS + 2] = {
    let mut inverse = [0.0; TERMS + 2];
    let (mut k, mut real) = (1, 1.0);
    while k < TERMS + 2 {
        inverse[k] = 1.0 / real;
        real += 1.0;
        k += 1;
    }
    inverse
};
/// Half a unit in the last place, relative.
const HALF_ULP: f64 = 0.5 * f64::EPSILON;

impl Flight {
    /// The flight of `osc` from a start.
    #[inline]
    #[must_use]
    pub fn new(osc: &Oscillator, start: Start) -> Self {
        let (sin, cos) = sin_cos(start.phase);
        let response = *osc.response();
        let zeta = response.damping();
        Self {
            response,
            x: start.x,
            v: start.v,
            phase: start.phase,
            sin,
            cos,
            a: sin - start.x - 2.0 * zeta * start.v,
            fastest: response.beta().max(1.0 + 2.0 * zeta),
        }
    }

    /// The flight after a release from the stop on `side`: at rest on it, at the phase at which the force changes sign.
    /// The acceleration is set to exactly zero, without the rounding error of $`\sin\theta - \delta`$.
    #[must_use]
    pub fn release(osc: &Oscillator, side: Side, phase: f64) -> Self {
        let x = osc.stop(side).map_or(0.0, |stop| side.sign() * stop.gap);
        Self { a: 0.0, ..Self::new(osc, Start { x, v: 0.0, phase }) }
    }

    /// The point a time `s >= 0` after the beginning.
    #[inline]
    #[must_use]
    pub fn at(&self, s: f64) -> FlightPoint {
        let turn = s * self.fastest;
        if turn < SHORT_REACH {
            self.by_series(s, SHORT_TERMS)
        } else if turn < LONG_REACH && self.v.abs() < SLOW {
            self.by_series(s, TERMS)
        } else {
            self.by_response(s)
        }
    }

    /// The point by the closed form.
    fn by_response(&self, s: f64) -> FlightPoint {
        let (beta, zeta) = (self.response.beta(), self.response.damping());
        let p = self.response.at(s);
        let free = self.v * p.s - self.x * p.one_minus_c;
        let forced = self.sin * p.kc + self.cos * p.ks;
        let displacement = free + forced;
        // with K' = S + i beta K
        let v = self.v * p.s_rate - self.x * p.s + self.sin * (p.s - beta * p.ks) + self.cos * (beta * p.kc);
        let force = self.sin * p.cos_turn + self.cos * p.sin_turn;
        let a = force - (self.x + displacement) - 2.0 * zeta * v;
        let force_rate = self.cos * p.cos_turn - self.sin * p.sin_turn;
        let j = beta * force_rate - v - 2.0 * zeta * a;
        // after a quarter of a free oscillation the terms of the position itself are smaller
        let far = p.c < 0.5;
        let x = if far { self.x * p.c + self.v * p.s + forced } else { self.x + displacement };
        // each term has a few rounding errors; the rounding error of an angle also affects the free part
        let (x0, v0, s_abs) = (self.x.abs(), self.v.abs(), p.s.abs());
        let start = x0 * if far { p.c.abs() } else { p.free_size };
        let terms = start + v0 * s_abs + p.forced_size;
        let angles = p.free_angle * (x0 * s_abs + v0 * p.c.abs()) + p.forced_angle * force_rate.abs();
        let rounding = HALF_ULP * (5.0 * terms + angles + x.abs().min(displacement.abs()));
        FlightPoint { displacement, x, far, v, a, j, rounding }
    }

    /// The point by the Taylor series with this number of terms.
    #[inline(never)]
    fn by_series(&self, s: f64, terms: usize) -> FlightPoint {
        let zeta2 = 2.0 * self.response.damping();
        let beta = self.response.beta();
        // c[k] = x^(k) / k!; the derivatives of the force are sin, cos, -sin, -cos in turn, with a factor beta / k each
        let mut c = [0.0; TERMS + 1];
        (c[1], c[2]) = (self.v, 0.5 * self.a);
        let (mut sine, mut cosine) = (self.sin, self.cos);
        let mut k = 1;
        let mut real = 1.0;
        while k + 2 <= terms {
            (sine, cosine) = (beta * cosine * INVERSE[k], -beta * sine * INVERSE[k]);
            // x^(k+2) of the module's recursion, over (k+2)!
            c[k + 2] = (sine - c[k] - zeta2 * (real + 1.0) * c[k + 1]) * (INVERSE[k + 1] * INVERSE[k + 2]);
            k += 1;
            real += 1.0;
        }
        let (mut x, mut v, mut a, mut j, mut size) = (0.0, 0.0, 0.0, 0.0, 0.0);
        real += 1.0; // = terms, as a float
        // Horner's scheme for the function and its first three derivatives at once
        for k in (1..=terms).rev() {
            x = x * s + c[k];
            size = size * s + c[k].abs();
            v = v * s + real * c[k];
            if k >= 2 {
                a = a * s + real * (real - 1.0) * c[k];
            }
            if k >= 3 {
                j = j * s + real * (real - 1.0) * (real - 2.0) * c[k];
            }
            real -= 1.0;
        }
        let displacement = x * s;
        FlightPoint { displacement, x: self.x + displacement, far: false, v, a, j, rounding: HALF_ULP * 4.0 * size * s }
    }

    /// The response, from which the bounds of a flight are computed.
    #[inline]
    #[must_use]
    pub(crate) const fn response(&self) -> &Response {
        &self.response
    }

    /// The fastest rate at which the flight changes, $`\max(\beta, 1 + 2\zeta)`$.
    #[inline]
    pub(crate) const fn fastest(&self) -> f64 {
        self.fastest
    }

    /// Third derivative at the beginning.
    pub(super) fn jerk(&self) -> f64 {
        self.response.beta() * self.cos - self.v - 2.0 * self.response.damping() * self.a
    }

    /// Fourth derivative at the beginning.
    pub(super) fn snap(&self) -> f64 {
        -self.response.beta() * self.response.beta() * self.sin - self.a - 2.0 * self.response.damping() * self.jerk()
    }

    /// Position and velocity a time `s` after the beginning.
    #[must_use]
    pub fn state(&self, s: f64) -> (f64, f64) {
        let point = self.at(s);
        (point.x, point.v)
    }

    /// Phase of the force a time `s` after the beginning, in $`[0, 2\pi)`$.
    #[inline]
    #[must_use]
    pub fn phase_at(&self, s: f64) -> f64 {
        phase::advance(self.phase, self.response.beta(), s)
    }
}
