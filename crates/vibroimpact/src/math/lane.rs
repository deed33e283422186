//! A lane type: one number or several side by side, with the operations used for the flights of a batch.
//!
//! The algorithms of lanes are written once, generic over [`Lane`]. Every operation acts on each number separately and
//! is one IEEE operation (or a choice between two numbers). So the result for a number depends neither on the other
//! numbers nor on how many there are: **scalar and lanes agree bit for bit**. The trait has no fused multiply-add, no
//! approximate reciprocal and no sum across lanes, because each would break this.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// 1.5 * 2^52: the sum of it and a number of magnitude below 2^51 is rounded to a whole number, which is in the last
/// bits.
pub(crate) const SHIFT: f64 = 6_755_399_441_055_744.0;

/// [`Lane::turned`] for one number.
#[inline(always)]
pub(crate) fn turned(quarters: f64, sin: f64, cos: f64) -> (f64, f64) {
    let bits = quarters.to_bits();
    let (odd, half) = (bits << 63, (bits >> 1) << 63);
    let (a, b) = if odd == 0 { (sin, cos) } else { (cos, sin) };
    (f64::from_bits(a.to_bits() ^ half), f64::from_bits(b.to_bits() ^ half ^ odd))
}

/// Several numbers side by side, of single or double precision.
pub(crate) trait Numbers:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// One truth value for each number.
    type Mask: Mask;
    /// The number of numbers.
    const WIDTH: usize;

    /// The same number in every lane, rounded to the precision.
    fn splat(x: f64) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self` where it is greater than `other`, else `other`.
    fn max(self, other: Self) -> Self;
    /// `self` where it is less than `other`, else `other`.
    fn min(self, other: Self) -> Self;
    /// Square root; NaN for a negative number.
    fn sqrt(self) -> Self;
    /// `self < other`; false for NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is set, else `no`.
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
}

/// Numbers of single precision. They suffice for steps whose results are only used with a margin.
pub(crate) trait Single: Numbers {
    /// The first numbers of a slice.
    fn load(from: &[f32]) -> Self;
    /// Writes them to the beginning of a slice.
    fn store(self, to: &mut [f32]);
    /// Writes the numbers whose bits are set to the beginning of a slice, in their order. The slice must have room for
    /// all numbers; the content after those written is undefined.
    fn store_some(self, bits: u32, to: &mut [f32]);
}

/// Several `f64` side by side.
pub(crate) trait Lane: Numbers {
    /// The same number of numbers in single precision.
    type Rough: Single;

    /// The same numbers in double precision.
    fn widened(from: Self::Rough) -> Self;
    /// Rounded to single precision.
    fn rounded(self) -> Self::Rough;
    /// The first numbers of a slice.
    fn load(from: &[f64]) -> Self;
    /// Writes them to the beginning of a slice.
    fn store(self, to: &mut [f64]);
    /// The columns of the rows with these indices.
    fn rows<const N: usize>(table: &[[f64; N]], at: &[u32]) -> [Self; N];
    /// Writes columns as rows, one for each number.
    fn store_rows(columns: [Self; 8], rows: &mut [[f64; 8]]);
    /// Sine and cosine, for arguments of at most 1e6 in magnitude.
    fn sine_and_cosine(self) -> (Self, Self);
    /// The largest whole number not above the number.
    fn floor(self) -> Self;
    /// The nearest whole number, ties to even, for magnitudes below 2^51.
    #[inline(always)]
    fn nearest(self) -> Self {
        let shift = Self::splat(SHIFT);
        (self + shift) - shift
    }
    /// Sine and cosine of an angle that is larger by a number of quarter turns. This number is given with [`SHIFT`]
    /// added; its last two bits determine which result is the sine, and the signs.
    fn turned(quarters: Self, sin: Self, cos: Self) -> (Self, Self);
}

/// Truth values side by side.
pub(crate) trait Mask: Copy {
    /// Both.
    fn and(self, other: Self) -> Self;
    /// At least one of them.
    fn or(self, other: Self) -> Self;
    /// As bits, the first lane lowest.
    fn bits(self) -> u32;
}
