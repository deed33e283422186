//! Single precision on x86-64 with AVX2: eight numbers in a register. Steps of flights are taken in this type.
//!
//! # Safety
//! As in `avx2`.
#![allow(unsafe_code)]

use super::compaction::PLACES_OF_BITS;
use super::register::{in_register, mask_in_register};
use crate::math::Single;
use core::arch::x86_64::{
    __m256, _CMP_LT_OQ, _mm_cvtsi64_si128, _mm256_add_ps, _mm256_and_ps, _mm256_andnot_ps, _mm256_blendv_ps,
    _mm256_cmp_ps, _mm256_cvtepu8_epi32, _mm256_div_ps, _mm256_loadu_ps, _mm256_max_ps, _mm256_min_ps,
    _mm256_movemask_ps, _mm256_mul_ps, _mm256_or_ps, _mm256_permutevar8x32_ps, _mm256_set1_ps, _mm256_sqrt_ps,
    _mm256_storeu_ps, _mm256_sub_ps, _mm256_xor_ps,
};

in_register! {
    /// Eight numbers of single precision.
    EightSingle(__m256), 8 of f32, mask EightSingleMask,
    Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps, Div div _mm256_div_ps;
    set1 _mm256_set1_ps, xor _mm256_xor_ps, andnot _mm256_andnot_ps, max _mm256_max_ps, min _mm256_min_ps,
    sqrt _mm256_sqrt_ps,
    less |a, b| EightSingleMask(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b)),
    choose |mask, yes, no| _mm256_blendv_ps(no, yes, mask)
}
mask_in_register!(EightSingleMask(__m256), and _mm256_and_ps, or _mm256_or_ps, bits _mm256_movemask_ps);

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
