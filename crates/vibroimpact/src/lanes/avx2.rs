//! The lane type of x86-64 with AVX2: four numbers in a register.
//!
//! # Safety
//! All `unsafe` here is the same: an intrinsic that needs AVX (or an unaligned load or store within a slice whose length
//! was checked). A value of this type exists only below [`super::width`]'s entry for AVX2, which is taken
//! after the processor was asked, so the instructions are there.
#![allow(unsafe_code)]

use crate::math::{Lane, Mask, Numbers, Single, picked};
use core::arch::x86_64::{
    __m256, __m256d, _CMP_LT_OQ, _mm256_add_pd, _mm256_add_ps, _mm256_and_pd, _mm256_and_ps, _mm256_andnot_pd,
    _mm256_andnot_ps, _mm256_blendv_pd, _mm256_blendv_ps, _mm256_cmp_pd, _mm256_cmp_ps, _mm256_div_pd, _mm256_floor_pd,
    _mm256_loadu_pd, _mm256_loadu_ps, _mm256_max_pd, _mm256_max_ps, _mm256_min_pd, _mm256_min_ps, _mm256_movemask_pd,
    _mm256_movemask_ps, _mm256_mul_pd, _mm256_mul_ps, _mm256_permute2f128_pd, _mm256_set_pd, _mm256_set1_pd,
    _mm256_set1_ps, _mm256_storeu_pd, _mm256_storeu_ps, _mm256_sub_pd, _mm256_sub_ps, _mm256_unpackhi_pd,
    _mm256_unpacklo_pd, _mm256_xor_pd, _mm256_xor_ps,
};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Four numbers.
#[derive(Clone, Copy)]
pub(super) struct Four(__m256d);

/// Four truth values: all bits of a place, or none.
#[derive(Clone, Copy)]
pub(super) struct FourMask(__m256d);

macro_rules! by_intrinsic {
    ($($operation:ident $method:ident $intrinsic:ident),*) => {$(
        impl $operation for Four {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )*};
}
by_intrinsic!(Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd);

impl Neg for Four {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

impl Mask for FourMask {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(unsafe { _mm256_and_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        unsafe { _mm256_movemask_pd(self.0) }.cast_unsigned()
    }
}

impl Numbers for Four {
    type Mask = FourMask;
    const WIDTH: usize = 4;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(unsafe { _mm256_set1_pd(x) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
    // `maxpd` and `minpd` give the second operand unless the first is greater (less): what the trait asks
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn less(self, other: Self) -> FourMask {
        FourMask(unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn choose(mask: FourMask, yes: Self, no: Self) -> Self {
        Self(unsafe { _mm256_blendv_pd(no.0, yes.0, mask.0) })
    }
}

impl Four {
    /// The first numbers of a slice.
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        let four: &[f64; 4] = from.first_chunk().unwrap_or(&[0.0; 4]);
        Self(unsafe { _mm256_loadu_pd(four.as_ptr()) })
    }
}

impl Lane for Four {
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        if let Some(four) = to.first_chunk_mut::<4>() {
            unsafe { _mm256_storeu_pd(four.as_mut_ptr(), self.0) }
        }
    }
    #[inline(always)]
    fn pick(from: &[[[f32; 8]; 5]], column: usize, at: &[u32; 8]) -> Self {
        let (a, b) = (picked(from, column, at[0]), picked(from, column, at[1]));
        let (c, d) = (picked(from, column, at[2]), picked(from, column, at[3]));
        Self(unsafe { _mm256_set_pd(d, c, b, a) })
    }
    #[inline(always)]
    fn rows<const N: usize>(table: &[[f64; N]], at: &[u32]) -> [Self; N] {
        let (row_a, row_b) = (&table[at[0] as usize], &table[at[1] as usize]);
        let (row_c, row_d) = (&table[at[2] as usize], &table[at[3] as usize]);
        let mut columns = [Self::splat(0.0); N];
        // four columns at a time: load a quarter of each row, then transpose
        let mut first = 0;
        while first < N {
            let (a, b) = (Self::load(&row_a[first..]).0, Self::load(&row_b[first..]).0);
            let (c, d) = (Self::load(&row_c[first..]).0, Self::load(&row_d[first..]).0);
            let [a, b, c, d] = transposed(a, b, c, d);
            columns[first] = Self(a);
            columns[first + 1] = Self(b);
            columns[first + 2] = Self(c);
            columns[first + 3] = Self(d);
            first += 4;
        }
        columns
    }
    #[inline(always)]
    fn store_rows(columns: [Self; 8], rows: &mut [[f64; 8]]) {
        let left = transposed(columns[0].0, columns[1].0, columns[2].0, columns[3].0);
        let right = transposed(columns[4].0, columns[5].0, columns[6].0, columns[7].0);
        let mut k = 0;
        while k < 4 {
            Self(left[k]).store(&mut rows[k][..4]);
            Self(right[k]).store(&mut rows[k][4..]);
            k += 1;
        }
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(unsafe { _mm256_floor_pd(self.0) })
    }
}

/// Rows as columns.
#[inline(always)]
fn transposed(a: __m256d, b: __m256d, c: __m256d, d: __m256d) -> [__m256d; 4] {
    unsafe {
        let (ab_low, ab_high) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd_low, cd_high) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab_low, cd_low),
            _mm256_permute2f128_pd::<0x20>(ab_high, cd_high),
            _mm256_permute2f128_pd::<0x31>(ab_low, cd_low),
            _mm256_permute2f128_pd::<0x31>(ab_high, cd_high),
        ]
    }
}

/// Eight numbers of single precision.
#[derive(Clone, Copy)]
pub(super) struct EightSingle(__m256);

/// Eight truth values.
#[derive(Clone, Copy)]
pub(super) struct EightSingleMask(__m256);

macro_rules! single_by_intrinsic {
    ($($operation:ident $method:ident $intrinsic:ident),*) => {$(
        impl $operation for EightSingle {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )*};
}
single_by_intrinsic!(Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps);

impl Neg for EightSingle {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(unsafe { _mm256_xor_ps(self.0, _mm256_set1_ps(-0.0)) })
    }
}

impl Mask for EightSingleMask {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(unsafe { _mm256_and_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        unsafe { _mm256_movemask_ps(self.0) }.cast_unsigned()
    }
}

impl Numbers for EightSingle {
    type Mask = EightSingleMask;
    const WIDTH: usize = 8;
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(unsafe { _mm256_set1_ps(<f32 as Numbers>::splat(x)) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn less(self, other: Self) -> EightSingleMask {
        EightSingleMask(unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn choose(mask: EightSingleMask, yes: Self, no: Self) -> Self {
        Self(unsafe { _mm256_blendv_ps(no.0, yes.0, mask.0) })
    }
}

impl Single for EightSingle {
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        let eight: &[f32; 8] = from.first_chunk().unwrap_or(&[0.0; 8]);
        Self(unsafe { _mm256_loadu_ps(eight.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        if let Some(eight) = to.first_chunk_mut::<8>() {
            unsafe { _mm256_storeu_ps(eight.as_mut_ptr(), self.0) }
        }
    }
}
