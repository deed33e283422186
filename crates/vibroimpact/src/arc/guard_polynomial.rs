//! Guards as polynomials over a window.

use super::polynomial::{first_zero, is_positive};
use crate::regime::TERMS;

/// The place of the bound of the remainder.
pub(super) const ORDER: usize = TERMS - 1;
/// The most zeros that are divided out: the terms after them must decide over a window of some length.
pub(super) const HIGHEST: usize = ORDER - 3;

/// A guard over a window, by powers of the part of the window that has passed.
#[derive(Clone, Copy, Debug)]
pub(super) struct GuardPolynomial {
    /// Its coefficients, with the bound of the remainder in the last place. Zeros at the beginning that are known are not
    /// divided out.
    pub(super) p: [f64; TERMS],
    /// How many of them there are.
    pub(super) known: usize,
    /// A bound of the rounding error of its value.
    pub(super) error: f64,
    /// The size of its terms.
    pub(super) size: f64,
    /// A point before which it is positive even with its remainder, if it may have a zero.
    pub(super) from: Option<f64>,
}

impl GuardPolynomial {
    pub(super) fn new(p: [f64; TERMS], known: usize, error: f64, size: f64) -> Self {
        // higher zeros are zero within rounding over a window in which only these are divided out
        let mut of = Self { p, known: known.min(HIGHEST), error, size, from: None };
        // contacts on which the flight begins are divided out; a derivative that is zero within rounding is zero, and the
        // next one decides
        while of.known > 0
            && of.known < HIGHEST
            && of.p[of.known] <= 0.0
            && -of.p[of.known] <= 64.0 * f64::EPSILON * of.size
        {
            of.known += 1;
        }
        of
    }

    /// One that is positive.
    pub(super) fn passed() -> Self {
        let mut p = [0.0; TERMS];
        p[0] = 1.0;
        Self { p, known: 0, error: 0.0, size: 1.0, from: None }
    }

    /// Whether it does not change over the window: then it falls nowhere, also where it is zero. A free body that rests beside an open stop
    /// touches it for ever.
    pub(super) fn is_constant(&self) -> bool {
        self.p[1..].iter().all(|p| *p == 0.0)
    }

    /// Whether it is nowhere below zero by more than so many rounding errors, of itself or a larger one, over the whole window.
    pub(super) fn is_flat(&self, roundings: f64, larger: f64) -> bool {
        let mut q = self.p;
        q[0] += roundings * self.error.max(larger);
        q[ORDER] = -q[ORDER];
        q[0] > 0.0 && first_zero(&q).is_none()
    }

    /// A point at which it is below zero by so many rounding errors, if it is not at the beginning.
    pub(super) fn below(&self, roundings: f64) -> Option<f64> {
        let mut q = self.p;
        q[0] += roundings * self.error;
        if q[0] > 0.0 { first_zero(&q) } else { None }
    }

    /// Whether it is positive over the window, by a quick test; `false` may be wrong.
    pub(super) fn is_positive(&self) -> bool {
        is_positive(&self.beside(-1.0))
    }

    /// The polynomial with its bound of the remainder added or subtracted, and known zeros divided out.
    pub(super) fn beside(&self, sign: f64) -> [f64; TERMS] {
        let mut q = self.p;
        q[ORDER] *= sign;
        if self.known > 0 {
            q.rotate_left(self.known);
            q[TERMS - self.known..].fill(0.0);
        } else {
            q[0] += sign * self.error;
        }
        q
    }

    /// The polynomial whose slope is that of the guard, with known zeros divided out and without them with its remainder.
    pub(super) fn steep(&self) -> [f64; TERMS] {
        if self.known > 0 { self.beside(1.0) } else { self.p }
    }
}

/// The first point where one may be zero, and its guard.
pub(super) fn first_of(polynomials: &mut [GuardPolynomial]) -> Option<(f64, usize)> {
    let mut first: Option<(f64, usize)> = None;
    for (g, of) in polynomials.iter_mut().enumerate() {
        of.from = first_zero(&of.beside(-1.0));
        if let Some(t) = of.from
            && first.is_none_or(|(least, _)| t < least)
        {
            first = Some((t, g));
        }
    }
    first
}
