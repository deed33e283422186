//! The lane type of x86-64 with AVX2: four numbers in a register.
//!
//! # Safety
//! Every `unsafe` block here contains an intrinsic that needs AVX, or an unaligned load or store within a slice whose
//! length was checked. A value of this type exists only below the entry of [`super::width`] for AVX2. This entry is
//! called only on a processor that has these instructions.
#![allow(unsafe_code)]

use super::pack::Pack;
use super::pair::Half;
use super::register::{in_register, mask_in_register};
use super::single::EightSingle;
use crate::math::{Lane, Numbers, sin_cos_lanes};
use core::arch::x86_64::{
    __m256d, _CMP_LT_OQ, _mm256_add_pd, _mm256_and_pd, _mm256_andnot_pd, _mm256_blendv_pd, _mm256_castpd_si256,
    _mm256_castps128_ps256, _mm256_castps256_ps128, _mm256_castsi256_pd, _mm256_cmp_pd, _mm256_cvtpd_ps,
    _mm256_cvtps_pd, _mm256_div_pd, _mm256_extractf128_ps, _mm256_floor_pd, _mm256_insertf128_ps, _mm256_loadu_pd,
    _mm256_max_pd, _mm256_min_pd, _mm256_movemask_pd, _mm256_mul_pd, _mm256_or_pd, _mm256_permute2f128_pd,
    _mm256_set_pd, _mm256_set1_pd, _mm256_slli_epi64, _mm256_sqrt_pd, _mm256_storeu_pd, _mm256_sub_pd,
    _mm256_unpackhi_pd, _mm256_unpacklo_pd, _mm256_xor_pd,
};

in_register! {
    /// Four numbers.
    Four(__m256d), 4 of f64, mask FourMask,
    Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd;
    set1 _mm256_set1_pd, xor _mm256_xor_pd, andnot _mm256_andnot_pd, max _mm256_max_pd, min _mm256_min_pd,
    sqrt _mm256_sqrt_pd,
    less |a, b| FourMask(_mm256_cmp_pd::<_CMP_LT_OQ>(a, b)), choose |mask, yes, no| _mm256_blendv_pd(no, yes, mask)
}
mask_in_register!(FourMask(__m256d), and _mm256_and_pd, or _mm256_or_pd, bits _mm256_movemask_pd);

impl Half for Four {
    type Double = EightSingle;

    #[inline(always)]
    fn both_widened(EightSingle(from): EightSingle) -> (Self, Self) {
        unsafe {
            (
                Self(_mm256_cvtps_pd(_mm256_castps256_ps128(from))),
                Self(_mm256_cvtps_pd(_mm256_extractf128_ps::<1>(from))),
            )
        }
    }
    #[inline(always)]
    fn both_rounded(self, second: Self) -> EightSingle {
        unsafe {
            let first = _mm256_castps128_ps256(_mm256_cvtpd_ps(self.0));
            EightSingle(_mm256_insertf128_ps::<1>(first, _mm256_cvtpd_ps(second.0)))
        }
    }
}

impl Lane for Four {
    type Rough = Pack<f32, 4>;

    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        sin_cos_lanes(self)
    }

    #[inline(always)]
    fn widened(from: Pack<f32, 4>) -> Self {
        let [a, b, c, d] = from.0.map(f64::from);
        // the intrinsic takes the last number first
        Self(unsafe { _mm256_set_pd(d, c, b, a) })
    }
    #[inline(always)]
    fn rounded(self) -> Pack<f32, 4> {
        let mut four = [0.0; 4];
        self.store(&mut four);
        Pack(four.map(Numbers::splat))
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        let four: &[f64; 4] = from.first_chunk().unwrap_or(&[0.0; 4]);
        Self(unsafe { _mm256_loadu_pd(four.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        if let Some(four) = to.first_chunk_mut::<4>() {
            unsafe { _mm256_storeu_pd(four.as_mut_ptr(), self.0) }
        }
    }
    #[inline(always)]
    fn rows<const N: usize>(table: &[[f64; N]], at: &[u32]) -> [Self; N] {
        let (row_a, row_b) = (&table[at[0] as usize], &table[at[1] as usize]);
        let (row_c, row_d) = (&table[at[2] as usize], &table[at[3] as usize]);
        let mut columns = [Self::splat(0.0); N];
        // four columns at a time: load four elements of each row, then transpose
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
    #[inline(always)]
    fn turned(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        unsafe {
            let bits = _mm256_castpd_si256(quarters.0);
            // a blend uses the first bit of each element
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(bits));
            let half = _mm256_castsi256_pd(_mm256_slli_epi64::<62>(bits));
            let (a, b) = (_mm256_blendv_pd(sin.0, cos.0, odd), _mm256_blendv_pd(cos.0, sin.0, odd));
            let sign = _mm256_set1_pd(-0.0);
            let both = _mm256_xor_pd(half, odd);
            (Self(_mm256_xor_pd(a, _mm256_and_pd(half, sign))), Self(_mm256_xor_pd(b, _mm256_and_pd(both, sign))))
        }
    }
}

/// Transposes rows to columns.
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
