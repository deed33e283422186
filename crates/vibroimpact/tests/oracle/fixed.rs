//! Numbers with 256 binary places, in whole-number arithmetic: nothing here rounds like a double does.
//!
//! Two's complement, five words of 64 bits, the last one the whole part: magnitudes below $2^{63}$, steps of
//! $2^{-256} \approx 10^{-77}$. A product or quotient is off by a few steps. The textbook formulas of the oracle lose
//! up to 24 digits beside resonance and 18 more in a flight of $10^{-9}$; more than thirty are left.
//! Leaving the range is a panic, never a wrong number.

use core::ops::{Add, Mul, Neg, Sub};

const WORDS: usize = 5;
/// Words behind the point.
const PLACES: usize = 4;

/// A number with 256 binary places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fixed([u64; WORDS]);

impl Fixed {
    pub(crate) const ZERO: Self = Self([0; WORDS]);
    pub(crate) const ONE: Self = Self([0, 0, 0, 0, 1]);
    /// $\pi/2$, from mpmath 1.3.0: `floor(pi/2 * 2**256 + 1/2)`; a test compares it with astro-float's.
    pub(crate) const HALF_PI: Self =
        Self([0x0417_7d4c_7627_3645, 0x5204_9c11_14cf_98e8, 0x898c_c517_01b8_39a2, 0x921f_b544_42d1_8469, 1]);

    /// The exact value of `x`, but for digits below $2^{-256}$.
    pub(crate) fn from_f64(x: f64) -> Self {
        assert!(x.abs() < 9e18, "{x} is beyond the range of the fixed-point oracle");
        let bits = x.abs().to_bits();
        let (exponent, fraction) = (bits >> 52, bits & ((1 << 52) - 1));
        let (mantissa, exponent) = if exponent == 0 { (fraction, 1) } else { (fraction | (1 << 52), exponent) };
        // value = mantissa * 2^(exponent - 1075); the lowest bit here is 2^-256
        let mut words = [0; WORDS];
        if exponent >= 819 {
            let shift = usize::try_from(exponent - 819).expect("an exponent has eleven bits");
            let (word, bit) = (shift / 64, shift % 64);
            words[word] = mantissa << bit;
            if bit > 0 && word + 1 < WORDS {
                words[word + 1] = mantissa >> (64 - bit);
            }
        } else if 819 - exponent < 64 {
            words[0] = mantissa >> (819 - exponent);
        }
        if x < 0.0 { -Self(words) } else { Self(words) }
    }

    pub(crate) fn from_int(n: i64) -> Self {
        Self([0, 0, 0, 0, n.cast_unsigned()])
    }

    /// The value to within one unit in the last place of the double.
    pub(crate) fn to_f64(self) -> f64 {
        let words = self.abs().0;
        let Some(top) = (0..WORDS).rev().find(|&i| words[i] != 0) else {
            return 0.0;
        };
        let zeros = words[top].leading_zeros();
        let below = if top > 0 { words[top - 1] } else { 0 };
        let head = if zeros == 0 { words[top] } else { (words[top] << zeros) | (below >> (64 - zeros)) };
        // the highest bit of `head` stands for 2^(64 top + 63 - zeros - 256)
        let exponent = i32::try_from(64 * top).expect("small") - 256 - i32::try_from(zeros).expect("small");
        #[allow(clippy::cast_precision_loss)] // rounding is what is wanted here
        let value = head as f64 * 2_f64.powi(exponent);
        if self.is_negative() { -value } else { value }
    }

    pub(crate) const fn is_negative(self) -> bool {
        self.0[WORDS - 1] >> 63 == 1
    }

    pub(crate) fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// Divided by $2^{bits}$.
    pub(crate) fn halved(self, bits: u32) -> Self {
        assert!(bits < 64);
        if bits == 0 {
            return self;
        }
        let mut words = self.abs().0;
        for i in 0..WORDS {
            let above = if i + 1 < WORDS { words[i + 1] << (64 - bits) } else { 0 };
            words[i] = (words[i] >> bits) | above;
        }
        if self.is_negative() { -Self(words) } else { Self(words) }
    }

    /// Times a whole number.
    pub(crate) fn times(self, n: i64) -> Self {
        let factor = u128::from(n.unsigned_abs());
        let (mut words, mut carry) = (self.abs().0, 0_u128);
        for word in &mut words {
            let wide = u128::from(*word) * factor + carry;
            (*word, carry) = (low(wide), wide >> 64);
        }
        assert!(carry == 0 && words[WORDS - 1] >> 63 == 0, "a multiple left the range of the fixed-point oracle");
        if self.is_negative() == (n < 0) { Self(words) } else { -Self(words) }
    }

    /// Divided by a small whole number.
    pub(crate) fn over(self, n: u64) -> Self {
        let (mut words, mut rest) = (self.abs().0, 0_u128);
        for word in words.iter_mut().rev() {
            let wide = (rest << 64) | u128::from(*word);
            (*word, rest) = (low(wide / u128::from(n)), wide % u128::from(n));
        }
        if self.is_negative() { -Self(words) } else { Self(words) }
    }

    /// $1/x$, by Newton's iteration from a double: 52, 104, 208, 416 bits.
    pub(crate) fn inverse(self) -> Self {
        let mut inverse = Self::from_f64(1.0 / self.to_f64());
        for _ in 0..4 {
            inverse = inverse + inverse * (Self::ONE - self * inverse);
        }
        inverse
    }

    /// $1/\sqrt{x}$ of a positive number, by Newton's iteration.
    pub(crate) fn inverse_sqrt(self) -> Self {
        let mut inverse = Self::from_f64(1.0 / self.to_f64().sqrt());
        for _ in 0..4 {
            inverse = inverse + (inverse * (Self::ONE - self * inverse * inverse)).halved(1);
        }
        inverse
    }
}

#[allow(clippy::cast_possible_truncation)] // the lower half is what is wanted
const fn low(wide: u128) -> u64 {
    wide as u64
}

impl Add for Fixed {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (mut words, mut carry) = (self.0, false);
        for (word, addend) in words.iter_mut().zip(other.0) {
            let (sum, first) = word.overflowing_add(addend);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            (*word, carry) = (sum, first | second);
        }
        let sum = Self(words);
        let overflow = self.is_negative() == other.is_negative() && sum.is_negative() != self.is_negative();
        assert!(!overflow, "a sum left the range of the fixed-point oracle");
        sum
    }
}

impl Neg for Fixed {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        let (mut words, mut carry) = (self.0, true);
        for word in &mut words {
            let (sum, over) = (!*word).overflowing_add(u64::from(carry));
            (*word, carry) = (sum, over);
        }
        Self(words)
    }
}

impl Sub for Fixed {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Fixed {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.abs().0, other.abs().0);
        let mut product = [0_u64; 2 * WORDS];
        for i in 0..WORDS {
            let mut carry = 0_u128;
            for j in 0..WORDS {
                let wide = u128::from(a[i]) * u128::from(b[j]) + u128::from(product[i + j]) + carry;
                (product[i + j], carry) = (low(wide), wide >> 64);
            }
            product[i + WORDS] = low(carry);
        }
        let mut words = [0; WORDS];
        words.copy_from_slice(&product[PLACES..PLACES + WORDS]);
        assert!(
            product[PLACES + WORDS] == 0 && words[WORDS - 1] >> 63 == 0,
            "a product left the range of the fixed-point oracle"
        );
        if self.is_negative() == other.is_negative() { Self(words) } else { -Self(words) }
    }
}
