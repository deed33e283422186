//! Error-free transformations: sums and products with their rounding errors (Dekker 1971, doi:10.1007/BF01397083).

use super::lane::Lane;
use core::ops::{Add, AddAssign, Mul};

/// `a + b` as a rounded sum and its exact error.
#[inline(always)]
pub(crate) fn two_sum<L: Lane>(a: L, b: L) -> (L, L) {
    // Knuth's six operations, which need not know which of both is larger
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// `a * b` as a rounded product and its exact error, for magnitudes below about 1e291.
///
/// Veltkamp splitting is used and no fused multiply-add, so every machine does the same operations.
#[inline(always)]
pub(crate) fn two_prod<L: Lane>(a: L, b: L) -> (L, L) {
    let (ah, al) = split(a);
    let (bh, bl) = split(b);
    let p = a * b;
    // the largest of the four exact products first, so that each difference is exact
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

/// Splits a number into two parts of at most 26 bits, whose products are exact.
#[inline(always)]
fn split<L: Lane>(a: L) -> (L, L) {
    let t = L::splat(134_217_729.0) * a; // 2^27 + 1
    let hi = t - (t - a);
    (hi, a - hi)
}

/// A number of about 32 digits, the sum of two doubles. As a running sum it loses no digits of 1e9 times of flight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Wide {
    hi: f64,
    lo: f64,
}

impl Wide {
    #[inline]
    fn of_sum(hi: f64, lo: f64) -> Self {
        let (hi, lo) = two_sum(hi, lo);
        Self { hi, lo }
    }

    /// The number, rounded once.
    #[inline]
    pub(crate) fn value(self) -> f64 {
        self.hi + self.lo
    }
}

impl From<f64> for Wide {
    #[inline]
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl AddAssign<f64> for Wide {
    #[inline]
    fn add_assign(&mut self, x: f64) {
        let (sum, error) = two_sum(self.hi, x);
        *self = Self::of_sum(sum, error + self.lo);
    }
}

impl Add for Wide {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (sum, error) = two_sum(self.hi, other.hi);
        Self::of_sum(sum, error + (self.lo + other.lo))
    }
}

impl Mul for Wide {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (product, error) = two_prod(self.hi, other.hi);
        // the product of both low parts is below the last digit
        Self::of_sum(product, error + (self.hi * other.lo + self.lo * other.hi))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_sum_keeps_its_digits() {
        let mut sum = Wide::default();
        let mut naive = 0.0;
        for _ in 0..10_000_000 {
            sum += 0.1;
            naive += 0.1;
        }
        // 0.1 is stored as 0.1000000000000000055511151231257827
        assert!((sum.value() - 1e6 - 5.551_115_123e-11).abs() < 1.2e-10);
        assert!((naive - 1e6_f64).abs() > 1e-5, "the naive sum drifts, which is why this type exists");
    }

    /// (1 + 2^-60)^2 - 1 = 2^-59, and 2^-120, which is below the last digit.
    #[test]
    fn a_wide_product_has_the_digits_of_both() {
        let small = 2.0_f64.powi(-60);
        let x = Wide::from(1.0) + Wide::from(small);
        assert_eq!((x * x + Wide::from(-1.0)).value(), 2.0 * small);
    }

    #[test]
    fn product_error_is_exact() {
        let (p, e) = two_prod(1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        assert_eq!(p, 1.0);
        assert_eq!(e, -f64::EPSILON * f64::EPSILON);
    }
}
