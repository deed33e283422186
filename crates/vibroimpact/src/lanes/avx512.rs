//! The lane type of x86-64 with AVX-512: eight numbers in a register, truth values in a mask register.
//!
//! # Safety
//! As in `avx2`: a value of this type exists only below the entry of [`Width`](super::Width) for AVX-512, which is
//! called only on a processor that has these instructions. Loads and stores stay within a slice whose length was
//! checked.
#![allow(unsafe_code)]

use super::pair::{Half, Pair};
use super::register::in_register;
use super::single::EightSingle;
use crate::math::{Lane, Mask, Numbers, sin_cos_lanes};
use core::arch::x86_64::{
    __m512d, _CMP_LT_OQ, _MM_FROUND_NO_EXC, _MM_FROUND_TO_NEG_INF, _mm512_add_pd, _mm512_and_pd, _mm512_andnot_pd,
    _mm512_castpd_si512, _mm512_castsi512_pd, _mm512_cmp_pd_mask, _mm512_cvtpd_ps, _mm512_cvtps_pd, _mm512_div_pd,
    _mm512_loadu_pd, _mm512_mask_blend_pd, _mm512_max_pd, _mm512_min_pd, _mm512_movepi64_mask, _mm512_mul_pd,
    _mm512_roundscale_pd, _mm512_set1_pd, _mm512_shuffle_f64x2, _mm512_slli_epi64, _mm512_sqrt_pd, _mm512_storeu_pd,
    _mm512_sub_pd, _mm512_unpackhi_pd, _mm512_unpacklo_pd, _mm512_xor_pd,
};

in_register! {
    /// Eight numbers.
    Eight(__m512d), 8 of f64, mask EightMask,
    Add add _mm512_add_pd, Sub sub _mm512_sub_pd, Mul mul _mm512_mul_pd, Div div _mm512_div_pd;
    set1 _mm512_set1_pd, xor _mm512_xor_pd, andnot _mm512_andnot_pd, max _mm512_max_pd, min _mm512_min_pd,
    sqrt _mm512_sqrt_pd,
    less |a, b| EightMask(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b)),
    choose |mask, yes, no| _mm512_mask_blend_pd(mask, no, yes)
}

/// Eight truth values.
#[derive(Clone, Copy)]
pub(super) struct EightMask(u8);

impl Mask for EightMask {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self.0)
    }
}

impl Half for Eight {
    type Double = Pair<EightSingle>;

    #[inline(always)]
    fn both_widened(from: Pair<EightSingle>) -> (Self, Self) {
        (Self::widened(from.0), Self::widened(from.1))
    }
    #[inline(always)]
    fn both_rounded(self, second: Self) -> Pair<EightSingle> {
        Pair(self.rounded(), second.rounded())
    }
}

impl Lane for Eight {
    type Rough = EightSingle;

    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        sin_cos_lanes(self)
    }

    #[inline(always)]
    fn widened(from: EightSingle) -> Self {
        Self(unsafe { _mm512_cvtps_pd(from.0) })
    }
    #[inline(always)]
    fn rounded(self) -> EightSingle {
        EightSingle(unsafe { _mm512_cvtpd_ps(self.0) })
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        let eight: &[f64; 8] = from.first_chunk().unwrap_or(&[0.0; 8]);
        Self(unsafe { _mm512_loadu_pd(eight.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        if let Some(eight) = to.first_chunk_mut::<8>() {
            unsafe { _mm512_storeu_pd(eight.as_mut_ptr(), self.0) }
        }
    }
    #[inline(always)]
    fn rows<const N: usize>(table: &[[f64; N]], at: &[u32]) -> [Self; N] {
        let mut columns = [Self::splat(0.0); N];
        // eight columns at a time: load eight elements of each row, then transpose by pairs, quarters and halves
        let mut first = 0;
        while first < N {
            let (a, b) = (Self::load(&table[at[0] as usize][first..]).0, Self::load(&table[at[1] as usize][first..]).0);
            let (c, d) = (Self::load(&table[at[2] as usize][first..]).0, Self::load(&table[at[3] as usize][first..]).0);
            let (e, f) = (Self::load(&table[at[4] as usize][first..]).0, Self::load(&table[at[5] as usize][first..]).0);
            let (g, h) = (Self::load(&table[at[6] as usize][first..]).0, Self::load(&table[at[7] as usize][first..]).0);
            let rows = transposed([a, b, c, d, e, f, g, h]);
            let mut k = 0;
            while k < 8 {
                columns[first + k] = Self(rows[k]);
                k += 1;
            }
            first += 8;
        }
        columns
    }
    #[inline(always)]
    fn store_rows(c: [Self; 8], rows: &mut [[f64; 8]]) {
        let transposed = transposed([c[0].0, c[1].0, c[2].0, c[3].0, c[4].0, c[5].0, c[6].0, c[7].0]);
        let mut k = 0;
        while k < 8 {
            Self(transposed[k]).store(&mut rows[k]);
            k += 1;
        }
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(unsafe { _mm512_roundscale_pd::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(self.0) })
    }
    #[inline(always)]
    fn turned(quarters: Self, sin: Self, cos: Self) -> (Self, Self) {
        unsafe {
            // the low bits of the sum with the shift count quarter turns: the lowest, and the one above it, are moved
            // to the sign
            let bits = _mm512_castpd_si512(quarters.0);
            let (odd, half) = (_mm512_slli_epi64::<63>(bits), _mm512_slli_epi64::<62>(bits));
            let swapped = _mm512_movepi64_mask(odd);
            let (a, b) = (_mm512_mask_blend_pd(swapped, sin.0, cos.0), _mm512_mask_blend_pd(swapped, cos.0, sin.0));
            let sign = _mm512_set1_pd(-0.0);
            // the cosine changes its sign in the second and third quarter
            let both = _mm512_xor_pd(_mm512_castsi512_pd(half), _mm512_castsi512_pd(odd));
            (
                Self(_mm512_xor_pd(a, _mm512_and_pd(_mm512_castsi512_pd(half), sign))),
                Self(_mm512_xor_pd(b, _mm512_and_pd(both, sign))),
            )
        }
    }
}

/// Transposes rows to columns.
#[inline(always)]
fn transposed([a, b, c, d, e, f, g, h]: [__m512d; 8]) -> [__m512d; 8] {
    unsafe {
        let low = quarters(
            _mm512_unpacklo_pd(a, b),
            _mm512_unpacklo_pd(c, d),
            _mm512_unpacklo_pd(e, f),
            _mm512_unpacklo_pd(g, h),
        );
        let high = quarters(
            _mm512_unpackhi_pd(a, b),
            _mm512_unpackhi_pd(c, d),
            _mm512_unpackhi_pd(e, f),
            _mm512_unpackhi_pd(g, h),
        );
        [low.0, high.0, low.1, high.1, low.2, high.2, low.3, high.3]
    }
}

/// From four registers of two rows each, interleaved by column, the columns of one parity: quarter k of each, in order.
#[inline(always)]
fn quarters(ab: __m512d, cd: __m512d, ef: __m512d, gh: __m512d) -> (__m512d, __m512d, __m512d, __m512d) {
    unsafe {
        // quarters 0 and 2, quarters 1 and 3 of two registers
        let (even, odd) =
            (_mm512_shuffle_f64x2::<0b10_00_10_00>(ab, cd), _mm512_shuffle_f64x2::<0b11_01_11_01>(ab, cd));
        let (even2, odd2) =
            (_mm512_shuffle_f64x2::<0b10_00_10_00>(ef, gh), _mm512_shuffle_f64x2::<0b11_01_11_01>(ef, gh));
        (
            _mm512_shuffle_f64x2::<0b10_00_10_00>(even, even2),
            _mm512_shuffle_f64x2::<0b10_00_10_00>(odd, odd2),
            _mm512_shuffle_f64x2::<0b11_01_11_01>(even, even2),
            _mm512_shuffle_f64x2::<0b11_01_11_01>(odd, odd2),
        )
    }
}
