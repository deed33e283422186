//! Single precision on x86-64 with AVX2: eight numbers in a register. Steps of flights are taken in this type.
//!
//! # Safety
//! As in `avx2`.
#![allow(unsafe_code)]

use super::compaction::PLACES_OF_BITS;
use crate::math::{Mask, Numbers, Single};
use core::arch::x86_64::{
    __m256, _CMP_LT_OQ, _mm_cvtsi64_si128, _mm256_add_ps, _mm256_and_ps, _mm256_andnot_ps, _mm256_blendv_ps,
    _mm256_cmp_ps, _mm256_cvtepu8_epi32, _mm256_div_ps, _mm256_loadu_ps, _mm256_max_ps, _mm256_min_ps,
    _mm256_movemask_ps, _mm256_mul_ps, _mm256_or_ps, _mm256_permutevar8x32_ps, _mm256_set1_ps, _mm256_sqrt_ps,
    _mm256_storeu_ps, _mm256_sub_ps, _mm256_xor_ps,
};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Eight numbers of single precision.
#[derive(Clone, Copy)]
pub(super) struct EightSingle(pub(super) __m256);

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
single_by_intrinsic!(Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps, Div div _mm256_div_ps);

impl Neg for EightSingle {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // flips the sign bit, of zeros and NaN too, as one number does
        Self(unsafe { _mm256_xor_ps(self.0, _mm256_set1_ps(-0.0)) })
    }
}

impl Mask for EightSingleMask {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(unsafe { _mm256_and_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(unsafe { _mm256_or_ps(self.0, other.0) })
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
    fn sqrt(self) -> Self {
        Self(unsafe { _mm256_sqrt_ps(self.0) })
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
    #[inline(always)]
    fn store_some(self, bits: u32, to: &mut [f32]) {
        // the chosen numbers move to the front; what is stored behind them is overwritten by the next ones
        let places = PLACES_OF_BITS[(bits & 0xff) as usize];
        let front = unsafe {
            _mm256_permutevar8x32_ps(self.0, _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(i64::from_le_bytes(places))))
        };
        Self(front).store(to);
    }
}
