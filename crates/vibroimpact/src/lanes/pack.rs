//! The portable lane type: an array with operations on each element. The compiler uses the vector instructions of the
//! target (NEON on ARM, SSE2 on any x86-64).

use crate::math::{Lane, Mask, Numbers, Single, sin_cos_lanes, turned};
use core::array::from_fn;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// `N` numbers, of double or single precision.
#[derive(Clone, Copy)]
pub(super) struct Pack<T, const N: usize>(pub(super) [T; N]);

/// `N` truth values.
#[derive(Clone, Copy)]
pub(super) struct PackMask<const N: usize>([bool; N]);

macro_rules! place_by_place {
    ($($operation:ident $method:ident),*) => {$(
        impl<T: Copy + $operation<Output = T>, const N: usize> $operation for Pack<T, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(from_fn(|k| self.0[k].$method(other.0[k])))
            }
        }
    )*};
}
place_by_place!(Add add, Sub sub, Mul mul, Div div);

impl<T: Copy + Neg<Output = T>, const N: usize> Neg for Pack<T, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(from_fn(|k| -self.0[k]))
    }
}

impl<const N: usize> Mask for PackMask<N> {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] & other.0[k]))
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] | other.0[k]))
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        // from the last to the first, which has the lowest bit
        self.0.iter().rev().fold(0, |bits, &set| bits << 1 | u32::from(set))
    }
}

impl<T: Numbers<Mask = bool>, const N: usize> Numbers for Pack<T, N> {
    type Mask = PackMask<N>;
    const WIDTH: usize = N;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([T::splat(x); N])
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(from_fn(|k| self.0[k].abs()))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k].max(other.0[k])))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k].min(other.0[k])))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(from_fn(|k| self.0[k].sqrt()))
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        PackMask(from_fn(|k| self.0[k].less(other.0[k])))
    }
    #[inline(always)]
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self {
        // a choice in each element and no branch, so that the compiler can use the vector instruction
        Self(from_fn(|k| T::choose(mask.0[k], yes.0[k], no.0[k])))
    }
}

impl<const N: usize> Lane for Pack<f64, N> {
    type Rough = Pack<f32, N>;

    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        sin_cos_lanes(self)
    }

    #[inline(always)]
    fn widened(from: Pack<f32, N>) -> Self {
        Self(from.0.map(f64::from))
    }
    #[inline(always)]
    fn rounded(self) -> Pack<f32, N> {
        Pack(self.0.map(Numbers::splat))
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self(from_fn(|k| from[k]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[..N].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn rows<const M: usize>(table: &[[f64; M]], at: &[u32]) -> [Self; M] {
        from_fn(|column| Self(from_fn(|k| table[at[k] as usize][column])))
    }
    #[inline(always)]
    fn store_rows(columns: [Self; 8], rows: &mut [[f64; 8]]) {
        for (k, row) in rows.iter_mut().take(N).enumerate() {
            *row = from_fn(|column| columns[column].0[k]);
        }
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(from_fn(|k| self.0[k].floor()))
    }
    #[inline(always)]
    fn turned(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        // the scalar function in each element, so that the bits are those of the scalar sine and cosine
        let both = from_fn::<_, N, _>(|k| turned(quarters.0[k], sin.0[k], cos.0[k]));
        (Self(both.map(|(sin, _)| sin)), Self(both.map(|(_, cos)| cos)))
    }
}

impl<const N: usize> Single for Pack<f32, N> {
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        Self(from_fn(|k| from[k]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        to[..N].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn store_some(self, bits: u32, to: &mut [f32]) {
        let mut count = 0;
        for k in 0..N {
            // chosen numbers follow each other without gaps: the next block reads them as one list
            if bits >> k & 1 == 1 {
                to[count] = self.0[k];
                count += 1;
            }
        }
    }
}
