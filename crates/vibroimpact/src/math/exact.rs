//! Error-free transformations: sums and products with their rounding errors (Dekker 1971, doi:10.1007/BF01397083).

use super::lane::Lane;

/// `a + b` as a rounded sum and its exact error.
#[inline(always)]
pub(crate) fn two_sum<L: Lane>(a: L, b: L) -> (L, L) {
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
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

/// Splits a number into two parts of at most 26 bits, whose products are exact.
#[inline(always)]
fn split<L: Lane>(a: L) -> (L, L) {
    let t = L::splat(134_217_729.0) * a; // 2^27 + 1
    let hi = t - (t - a);
    (hi, a - hi)
}

/// A running sum with its rounding error, so that the sum of 1e9 times of flight loses no digits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sum {
    hi: f64,
    lo: f64,
}

impl Sum {
    /// Adds `x`.
    #[inline]
    pub(crate) fn add(&mut self, x: f64) {
        let (s, e) = two_sum(self.hi, x);
        let (hi, lo) = two_sum(s, e + self.lo);
        self.hi = hi;
        self.lo = lo;
    }

    /// The sum, rounded once.
    #[inline]
    pub(crate) fn value(self) -> f64 {
        self.hi + self.lo
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_sum_keeps_its_digits() {
        let mut sum = Sum::default();
        let mut naive = 0.0;
        for _ in 0..10_000_000 {
            sum.add(0.1);
            naive += 0.1;
        }
        // 0.1 is stored as 0.1000000000000000055511151231257827
        assert!((sum.value() - 1e6 - 5.551_115_123e-11).abs() < 1.2e-10);
        assert!((naive - 1e6_f64).abs() > 1e-5, "the naive sum drifts, which is why this type exists");
    }

    #[test]
    fn product_error_is_exact() {
        let (p, e) = two_prod(1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        assert_eq!(p, 1.0);
        assert_eq!(e, -f64::EPSILON * f64::EPSILON);
    }
}
