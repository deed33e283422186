//! Sine and cosine together, with an error below one unit in the last place.
//!
//! The argument is reduced to $`|r| \le \pi/4`$ plus a low part. For $`|n| < 2^{20}`$ quarter turns this uses three
//! 33-bit pieces of $`\pi/2`$, whose products with $`n`$ are exact (Cody & Waite), and for more quarter turns exact
//! products with a 160-bit $`\pi/2`$. The two polynomials are the minimax polynomials of Sun's fdlibm (`k_sin.c`,
//! `k_cos.c`, freely usable), including the low part of the reduced argument.

use super::lane::SHIFT;
use super::{Lane, two_prod, two_sum};
use core::f64::consts::FRAC_2_PI;

/// π/2 in pieces of 33 bits: `n * piece` is exact for |n| < 2^20.
const P1: f64 = 1.570_796_326_734_125_6;
const P2: f64 = 6.077_100_506_303_966e-11;
const P3: f64 = 2.022_266_248_795_950_6e-21;
/// π/2 in three full-width pieces.
const Q1: f64 = core::f64::consts::FRAC_PI_2;
const Q2: f64 = 6.123_233_995_736_766e-17;
const Q3: f64 = -1.497_384_904_859_169_8e-33;

/// The largest argument for which the fast reduction is exact.
const FAST: f64 = 1_000_000.0;
/// From this value on neighbouring numbers are more than a radian apart and a sine has no meaning. The argument is
/// reduced modulo the double nearest 2π, so that the result is finite and reproducible.
const MEANINGLESS: f64 = 9_007_199_254_740_992.0;

/// `(sin x, cos x)`, each within 1 ulp for |x| < 2^53; NaN for a NaN or infinite `x`.
///
/// ```
/// let (s, c) = vibroimpact::math::sin_cos(1e5);
/// assert!((s - 1e5_f64.sin()).abs() < 2e-16 && (c - 1e5_f64.cos()).abs() < 2e-16);
/// ```
#[inline]
#[must_use]
#[allow(clippy::cast_possible_truncation)] // |n| < 2^53, or NaN which becomes 0 and stays NaN in r
pub fn sin_cos(x: f64) -> (f64, f64) {
    let (n, r, lo) = if x.abs() <= FAST { reduce_fast(x) } else { reduce_large(x) };
    // sine and cosine of the remainder; the number of quarter turns says which is which
    let s = kernel_sin(r, lo);
    let c = kernel_cos(r, lo);
    match n as i64 & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// The same in lanes, bit for bit, for arguments of at most 1e6 in magnitude.
#[inline(always)]
pub(crate) fn sin_cos_lanes<L: Lane>(x: L) -> (L, L) {
    let (shifted, r, lo) = reduce_shifted(x);
    L::turned(shifted, kernel_sin(r, lo), kernel_cos(r, lo))
}

#[inline(always)]
fn reduce_fast(x: f64) -> (f64, f64, f64) {
    let (shifted, r, lo) = reduce_shifted(x);
    (shifted - SHIFT, r, lo)
}

/// The number of quarter turns with [`SHIFT`] added, and the remainder as high and low part.
#[inline(always)]
fn reduce_shifted<L: Lane>(x: L) -> (L, L, L) {
    let shift = L::splat(SHIFT);
    let shifted = x * L::splat(FRAC_2_PI) + shift;
    let n = shifted - shift;
    // exact: the second piece is the smaller one, or x is so close to a multiple that the difference is exact
    let (first, second) = (x - n * L::splat(P1), n * L::splat(P2));
    let hi = first - second;
    (shifted, hi, ((first - hi) - second) - n * L::splat(P3))
}

/// The number of quarter turns, and the remainder as high and low part, for large arguments.
#[cold]
fn reduce_large(x: f64) -> (f64, f64, f64) {
    let x = if x.abs() < MEANINGLESS { x } else { x % core::f64::consts::TAU };
    // the product is rounded, so near a half-integer n may be wrong by 1: it is corrected
    let n = (x * FRAC_2_PI).round();
    let n = n + (subtract_quarters(x, n).0 * FRAC_2_PI).round();
    let (hi, lo) = subtract_quarters(x, n);
    (n, hi, lo)
}

/// $`x - n \pi/2`$ as high and low part.
fn subtract_quarters(x: f64, n: f64) -> (f64, f64) {
    // the first two pieces are full doubles: their products with n have rounding errors, which are carried along
    let (p, pe) = two_prod(n, Q1);
    let (q, qe) = two_prod(n, Q2);
    let (r, e1) = two_sum(x - p, -pe);
    let (r, e2) = two_sum(r, -q);
    let lo = ((e1 + e2) - qe) - n * Q3;
    let hi = r + lo;
    (hi, (r - hi) + lo)
}

const S: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_49,
    -0.000_198_412_698_298_579_5,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const C: [f64; 6] = [
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_411,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// The sine of `x + lo` for |x| <= pi/4.
#[inline(always)]
fn kernel_sin<L: Lane>(x: L, lo: L) -> L {
    let z = x * x;
    let w = z * z;
    let r = L::splat(S[1]) + z * (L::splat(S[2]) + z * L::splat(S[3])) + z * w * (L::splat(S[4]) + z * L::splat(S[5]));
    let v = z * x;
    x - ((z * (L::splat(0.5) * lo - v * r) - lo) - v * L::splat(S[0]))
}

/// The cosine of `x + lo` for |x| <= pi/4.
#[inline(always)]
fn kernel_cos<L: Lane>(x: L, lo: L) -> L {
    let one = L::splat(1.0);
    let z = x * x;
    let w = z * z;
    let r = z * (L::splat(C[0]) + z * (L::splat(C[1]) + z * L::splat(C[2])))
        + w * w * (L::splat(C[3]) + z * (L::splat(C[4]) + z * L::splat(C[5])));
    let hz = L::splat(0.5) * z;
    let w = one - hz;
    w + (((one - w) - hz) + (z * r - x * lo))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distance in units of the last place of `want`.
    fn ulps(got: f64, want: f64) -> f64 {
        let ulp = f64::from_bits(want.abs().to_bits() + 1) - want.abs();
        (got - want).abs() / ulp
    }

    #[test]
    fn agrees_with_a_second_implementation() {
        // libm is different code (Payne-Hanek reduction for large arguments); both are within 1 ulp, so at most 2 apart
        let mut x = 1e-9;
        let mut k = 0_u32;
        while x < 1e15 {
            for x in [x, -x, x * 1.000_1] {
                let (s, c) = sin_cos(x);
                assert!(ulps(s, libm::sin(x)) <= 1.0, "sin {x:e}: {s:e}");
                assert!(ulps(c, libm::cos(x)) <= 1.0, "cos {x:e}: {c:e}");
            }
            x *= 1.0 + 1e-3 * f64::from(k % 7 + 1);
            k += 1;
        }
        assert!(k > 10_000);
    }

    #[test]
    fn multiples_of_a_quarter_turn() {
        // the double nearest 2^k * pi/2 differs from it by a known amount; libm's Payne-Hanek reduction is the
        // reference
        for k in 0..45 {
            let x = core::f64::consts::FRAC_PI_2 * 2_f64.powi(k);
            let (s, c) = sin_cos(x);
            assert!(ulps(s, libm::sin(x)) <= 1.0, "sin 2^{k} pi/2");
            assert!(ulps(c, libm::cos(x)) <= 1.0, "cos 2^{k} pi/2");
        }
    }

    #[test]
    fn strange_arguments_do_not_panic() {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let (s, c) = sin_cos(x);
            assert!(s.is_nan() && c.is_nan());
        }
        let (s, c) = sin_cos(1e300);
        assert!((s * s + c * c - 1.0).abs() < 1e-15);
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }
}
