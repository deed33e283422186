//! One flight: the closed-form arc of the mass from a state until a stop is reached.
//!
//! Positions are reported as displacements from the start, so that the gap left to a stop loses no digits when the
//! flight begins on that stop and is short - the regime of chattering, where flights of $`10^{-9}`$ still have to be right
//! to their last bits. While $`\mu s < 1/4`$, with $`\mu = \max(\beta, \zeta + \sqrt{\zeta^2+1})`$ the fastest rate in the
//! system, the arc is summed as its Taylor series
//!
//! $$`x^{(k+2)} = \beta^k \sin(\varphi + k\pi/2) - x^{(k)} - 2\zeta x^{(k+1)},`$$
//!
//! beyond that taken from [`Response`](super::Response).

use super::response::Response;
use crate::math::sin_cos;
use crate::system::{Oscillator, Side, Start, phase};

/// A point of a flight, a time `s` after its beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Displacement $`x(s) - x_0`$ since the beginning.
    pub displacement: f64,
    /// Velocity.
    pub v: f64,
    /// Acceleration.
    pub a: f64,
    /// Third derivative.
    pub j: f64,
    /// How far rounding may have moved `displacement`: a bound on the error of this evaluation, from the size of its
    /// terms and of its arguments.
    pub rounding: f64,
}

/// The closed-form motion from a state, as long as no stop is struck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    response: Response,
    /// Position at the beginning.
    pub x: f64,
    /// Velocity at the beginning.
    pub v: f64,
    /// Phase of the force at the beginning.
    pub phase: f64,
    sin: f64,
    cos: f64,
    /// Acceleration at the beginning.
    pub(super) a: f64,
    pub(super) fastest: f64,
}

/// Terms of the Taylor series: at $`\mu s = 1/4`$ the first one left out is below $`2^{-60}`$ of the leading ones.
const TERMS: usize = 15;
/// 1/k.
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
/// Reach of the Taylor series in $`\mu s`$.
const SERIES_REACH: f64 = 0.25;
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

    /// The flight that follows a release from the stop on `side`: at rest on it, the force just changing sign, so the
    /// acceleration is exactly zero whatever rounding made of $`\sin\theta - \delta`$.
    #[must_use]
    pub fn release(osc: &Oscillator, side: Side, phase: f64) -> Self {
        let x = osc.stop(side).map_or(0.0, |stop| side.sign() * stop.gap);
        Self { a: 0.0, ..Self::new(osc, Start { x, v: 0.0, phase }) }
    }

    /// The point a time `s >= 0` after the beginning.
    #[inline]
    #[must_use]
    pub fn at(&self, s: f64) -> Point {
        if s * self.fastest < SERIES_REACH { self.by_series(s) } else { self.by_response(s) }
    }

    fn by_response(&self, s: f64) -> Point {
        let (beta, zeta) = (self.response.beta(), self.response.damping());
        let p = self.response.at(s);
        let free = self.v * p.s - self.x * p.one_minus_c;
        let forced = self.sin * p.kc + self.cos * p.ks;
        let displacement = free + forced;
        let v = self.v * (p.c - 2.0 * zeta * p.s) - self.x * p.s
            + self.sin * (p.s - beta * p.ks)
            + self.cos * (beta * p.kc);
        let force = self.sin * p.cos_turn + self.cos * p.sin_turn;
        let a = force - (self.x + displacement) - 2.0 * zeta * v;
        let j = beta * (self.cos * p.cos_turn - self.sin * p.sin_turn) - v - 2.0 * zeta * a;
        // each term carries a few roundings; each angle ws, (beta - w)s/2 is off by half an ulp, which moves the free
        // part by about s |free velocity| and the forced one by s |K'|
        let (x, v0, kc, ks) = (self.x.abs(), self.v.abs(), p.kc.abs(), p.ks.abs());
        let terms = x * p.one_minus_c.max(0.5) + v0 * p.s.abs() + p.forced_size;
        let angles = s * (x * p.s.abs() + v0 * p.c.abs() + p.s.abs() + beta * (kc + ks));
        Point { displacement, v, a, j, rounding: HALF_ULP * (5.0 * terms + angles) }
    }

    #[inline(never)]
    fn by_series(&self, s: f64) -> Point {
        let zeta2 = 2.0 * self.response.damping();
        let beta = self.response.beta();
        // derivatives 1.. at the beginning; the force's run through sin, cos, -sin, -cos with a factor beta each
        let mut d = [0.0; TERMS + 3];
        (d[0], d[1]) = (self.v, self.a);
        let (mut sine, mut cosine) = (self.sin, self.cos);
        for k in 2..TERMS + 3 {
            (sine, cosine) = (beta * cosine, -beta * sine);
            d[k] = sine - d[k - 2] - zeta2 * d[k - 1];
        }
        let (mut x, mut v, mut a, mut j) = (0.0, 0.0, 0.0, 0.0);
        for k in (0..TERMS).rev() {
            x = d[k] + x * s * INVERSE[k + 2];
            v = d[k] + v * s * INVERSE[k + 1];
            a = d[k + 1] + a * s * INVERSE[k + 1];
            j = d[k + 2] + j * s * INVERSE[k + 1];
        }
        let size = s * (self.v.abs() + 0.5 * s * (self.a.abs() + s * (d[2].abs() + s * self.fastest * d[2].abs())));
        Point { displacement: x * s, v, a, j, rounding: HALF_ULP * 4.0 * size }
    }

    /// Rate and bounds need the response too.
    #[inline]
    #[must_use]
    pub(super) const fn response(&self) -> &Response {
        &self.response
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
        (self.x + point.displacement, point.v)
    }

    /// Phase of the force a time `s` after the beginning, in $`[0, 2\pi)`$.
    #[inline]
    #[must_use]
    pub fn phase_at(&self, s: f64) -> f64 {
        phase::advance(self.phase, self.response.beta(), s)
    }
}
