//! One number as a lane.

use super::lane::{Lane, Mask, Numbers, Single, turned};
use super::trig::sin_cos;

impl Mask for bool {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self & other
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        self | other
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
}

macro_rules! one_number {
    ($($precision:ty),*) => {$(
        impl Numbers for $precision {
            type Mask = bool;
            const WIDTH: usize = 1;
            #[inline(always)]
            fn splat(x: f64) -> Self {
                #[allow(clippy::cast_possible_truncation)] // single precision: rounded on purpose
                let x = x as Self;
                x
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self::abs(self)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // the operand is chosen as by the vector instructions, also if one is not a number
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self::sqrt(self)
            }
            #[inline(always)]
            fn less(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn choose(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
        }
    )*};
}
one_number!(f64, f32);

/// The scalar instance: lanes are compared with it, and single motions use it.
impl Lane for f64 {
    type Rough = f32;

    #[inline(always)]
    fn widened(from: f32) -> Self {
        Self::from(from)
    }
    #[inline(always)]
    fn rounded(self) -> f32 {
        Numbers::splat(self)
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        from[0]
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self;
    }
    #[inline(always)]
    fn rows<const N: usize>(table: &[[f64; N]], at: &[u32]) -> [Self; N] {
        table[at[0] as usize]
    }
    #[inline(always)]
    fn store_rows(columns: [Self; 8], rows: &mut [[f64; 8]]) {
        rows[0] = columns;
    }
    /// For arguments of any size, with the same bits.
    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        sin_cos(self)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self::floor(self)
    }
    #[inline(always)]
    fn turned(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        turned(quarters, sin, cos)
    }
}

impl Single for f32 {
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        from[0]
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        to[0] = self;
    }
    #[inline(always)]
    fn store_some(self, _: u32, to: &mut [f32]) {
        to[0] = self;
    }
}
