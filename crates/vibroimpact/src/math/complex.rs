//! Complex numbers, as far as eigenvalues need them.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A complex number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Complex {
    pub(crate) re: f64,
    pub(crate) im: f64,
}

impl Complex {
    pub(crate) const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    pub(crate) fn modulus(self) -> f64 {
        super::hypot(self.re, self.im)
    }

    pub(crate) fn sqrt(self) -> Self {
        let size = self.modulus();
        if size == 0.0 {
            return Self::default();
        }
        // the larger part by the root, the other one by the quotient: no difference loses digits
        let re = (0.5 * (size + self.re.abs())).sqrt();
        let im = 0.5 * self.im.abs() / re;
        let (re, im) = if self.re < 0.0 { (im, re) } else { (re, im) };
        Self { re, im: if self.im < 0.0 { -im } else { im } }
    }
}

impl From<f64> for Complex {
    fn from(re: f64) -> Self {
        Self { re, im: 0.0 }
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        // scaled, so that the square of a large divisor does not overflow
        let size = other.re.abs().max(other.im.abs());
        let (re, im) = (other.re / size, other.im / size);
        let norm = (re * re + im * im) * size;
        Self { re: (self.re * re + self.im * im) / norm, im: (self.im * re - self.re * im) / norm }
    }
}
