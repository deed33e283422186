//! Numbers of about 105 bits: a double and a second one that holds its rounding error (Dekker 1971,
//! doi:10.1007/BF01397083).

/// The number `high + low`, where `low` is at most the rounding error of `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Double {
    pub(super) high: f64,
    pub(super) low: f64,
}

/// The exact product. It uses the fused multiply-add of `libm`, whose result is the same on every machine.
pub(super) fn product(a: f64, b: f64) -> Double {
    let high = a * b;
    Double { high, low: libm::fma(a, b, -high) }
}

/// The natural logarithm of 2.
const LN_2: Double = Double { high: core::f64::consts::LN_2, low: 2.319_046_813_846_299_6e-17 };
/// Number of times an exponent is halved before its series is summed.
const HALVINGS: i32 = 9;
/// Number of terms of the series. The next term is less than 1e-32 of the sum for exponents up to ln 2 / 2^10.
const TERMS: u32 = 8;

impl Double {
    /// The nearest double.
    pub(super) fn value(self) -> f64 {
        self.high + self.low
    }

    pub(super) fn negative(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        let high = self.high + other.high;
        let taken = high - self.high;
        let error = (self.high - (high - taken)) + (other.high - taken);
        Self { high, low: error + (self.low + other.low) }.settled()
    }

    pub(super) fn times(self, factor: f64) -> Self {
        let Self { high, low } = product(self.high, factor);
        Self { high, low: low + self.low * factor }.settled()
    }

    pub(super) fn over(self, divisor: f64) -> Self {
        let high = self.high / divisor;
        let rest = libm::fma(-high, divisor, self.high) + self.low;
        Self { high, low: rest / divisor }.settled()
    }

    fn by(self, other: Self) -> Self {
        let Self { high, low } = product(self.high, other.high);
        Self { high, low: low + (self.high * other.low + self.low * other.high) }.settled()
    }

    /// The same value, normalised so that `high` is the double nearest to it.
    fn settled(self) -> Self {
        let high = self.high + self.low;
        Self { high, low: self.low - (high - self.high) }
    }

    /// The exponential as a factor and a power of two.
    fn exp_parts(self) -> (Self, i32) {
        #[allow(clippy::cast_possible_truncation)] // of logarithms of doubles: at most some thousands
        let twos = (self.high / LN_2.high).round() as i32;
        let rest = self.plus(LN_2.times(-f64::from(twos))).times(0.5_f64.powi(HALVINGS));
        // e^r - 1 by Horner's rule, then doubled: e^2r - 1 = 2 (e^r - 1) + (e^r - 1)^2
        let one = Self { high: 1.0, low: 0.0 };
        let series = (2..=TERMS).rev().fold(one, |sum, term| rest.by(sum).over(f64::from(term)).plus(one)).by(rest);
        let less_one = (0..HALVINGS).fold(series, |e, _| e.times(2.0).plus(e.by(e)));
        (less_one.plus(one), twos)
    }

    /// The exponential, as a double.
    pub(super) fn exp(self) -> f64 {
        let (mantissa, twos) = self.exp_parts();
        libm::ldexp(mantissa.value(), twos)
    }

    /// The natural logarithm of a positive number.
    pub(super) fn ln(self) -> Self {
        // a step of Newton's method for exp y = x, with the next term of its error: y + r - r^2 / 2, r = x exp(-y) - 1
        let (mantissa, power) = libm::frexp(self.high);
        let scaled = Self { high: mantissa, low: libm::ldexp(self.low, -power) };
        let guess = libm::log(mantissa);
        let (inverse, twos) = Self { high: -guess, low: 0.0 }.exp_parts();
        let near = scaled.by(inverse);
        let two = libm::ldexp(1.0, twos);
        let rest = near.times(two).plus(Self { high: -1.0, low: 0.0 });
        let step = rest.plus(rest.by(rest).times(-0.5));
        step.plus(Self { high: guess, low: 0.0 }).plus(LN_2.times(f64::from(power)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(high: f64) -> Double {
        Double { high, low: 0.0 }
    }

    /// Digits of OEIS A002162 (ln 2), A002392 (ln 10) and A001113 (e), as `high` and `low`.
    #[test]
    fn known_digits() {
        for (found, high, rest) in [
            (of(10.0).ln(), core::f64::consts::LN_10, -2.170_756_223_382_249_4e-16),
            (of(2.0).ln(), core::f64::consts::LN_2, LN_2.low),
            (of(1024.0).ln().over(10.0), core::f64::consts::LN_2, LN_2.low),
            (of(1e-300).ln().over(-300.0), core::f64::consts::LN_10, -2.170_756_223_382_249_4e-16),
        ] {
            let off = (found.high - high) + (found.low - rest);
            // the double 1e-300 differs from the power of ten by a relative 1e-17, of which a 300th remains
            assert!(off.abs() < 1e-19, "{found:?} {high} {rest}: {off:e}");
        }
        let (e, twos) = of(1.0).exp_parts();
        let off = (e.times(2.0_f64.powi(twos)).high - core::f64::consts::E)
            + (e.times(2.0_f64.powi(twos)).low - 1.445_646_891_729_250_2e-16);
        assert!(off.abs() < 1e-30, "{off:e}");
    }

    #[test]
    fn logarithms_and_exponentials_undo_each_other() {
        for k in 1..2000_u32 {
            let x = libm::exp(0.7 * (f64::from(k) - 1000.0));
            if x > 0.0 && x.is_finite() {
                assert_eq!(of(x).ln().exp(), x, "{x:e}");
            }
        }
    }
}
