//! A lane type: one number or several side by side, with the few operations the flights of a batch are made of.
//!
//! What lanes compute is written once, generic over [`Lane`]. Every operation acts on each number by itself and is one IEEE
//! operation (or a choice between two numbers), so a number's result does not depend on what lies beside it or on how
//! many there are: **scalar and lanes agree bit for bit**. There is no fused multiply-add, no approximate reciprocal and
//! no sum across lanes in the trait, because each would break that.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// 1.5 * 2^52: a number of magnitude below 2^51 added to it is rounded to a whole one, which stands in the last bits.
pub(crate) const SHIFT: f64 = 6_755_399_441_055_744.0;

/// [`Lane::turned`] of one number.
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
    /// One truth value a number.
    type Mask: Mask;
    /// How many numbers.
    const WIDTH: usize;

    /// The same number everywhere, rounded to the precision.
    fn splat(x: f64) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// `self` where it is greater than `other`, else `other`.
    fn max(self, other: Self) -> Self;
    /// `self` where it is less than `other`, else `other`.
    fn min(self, other: Self) -> Self;
    /// Square root; NaN of what is negative.
    fn sqrt(self) -> Self;
    /// `self < other`; false for NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is set, else `no`.
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
}

/// Numbers of single precision: enough to pass time in, where what they say is only used with a margin.
pub(crate) trait Single: Numbers {
    /// The first numbers of a slice.
    fn load(from: &[f32]) -> Self;
    /// Writes them to the beginning of a slice.
    fn store(self, to: &mut [f32]);
    /// Writes those whose bits are set to the beginning of a slice that has room for all, in their order; what follows them there
    /// is of no meaning.
    fn store_some(self, bits: u32, to: &mut [f32]);
}

/// Several `f64` side by side.
pub(crate) trait Lane: Numbers {
    /// As many numbers of single precision.
    type Rough: Single;

    /// The same numbers in double precision.
    fn widened(from: Self::Rough) -> Self;
    /// Rounded to single precision.
    fn rounded(self) -> Self::Rough;
    /// The first numbers of a slice.
    fn load(from: &[f64]) -> Self;
    /// Writes them to the beginning of a slice.
    fn store(self, to: &mut [f64]);
    /// The columns of the rows at these places.
    fn rows<const N: usize>(table: &[[f64; N]], at: &[u32]) -> [Self; N];
    /// Writes columns as rows, one for each number.
    fn store_rows(columns: [Self; 8], rows: &mut [[f64; 8]]);
    /// Sine and cosine, for arguments of at most 1e6 in magnitude.
    fn sine_and_cosine(self) -> (Self, Self);
    /// The largest whole number not above.
    fn floor(self) -> Self;
    /// The nearest whole number, ties to even, for magnitudes below 2^51.
    #[inline(always)]
    fn nearest(self) -> Self {
        let shift = Self::splat(SHIFT);
        (self + shift) - shift
    }
    /// Sine and cosine of an angle that is so many quarter turns more, their number being shifted by [`SHIFT`]: its last two bits
    /// say which of the two is which, and their signs.
    fn turned(quarters: Self, sin: Self, cos: Self) -> (Self, Self);
}

/// Truth values side by side.
pub(crate) trait Mask: Copy {
    /// Both.
    fn and(self, other: Self) -> Self;
    /// One of them, or both.
    fn or(self, other: Self) -> Self;
    /// As bits, the first lane lowest.
    fn bits(self) -> u32;
}
