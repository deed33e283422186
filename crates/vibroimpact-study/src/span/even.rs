//! The values between the two ends of a range, as close to the exact ones as doubles allow.
//!
//! $$`x_k = \frac{(n - k)\,a + k\,b}{n}, \qquad x_k = a\,(b/a)^{k/n}, \qquad k = 0 \dots n`$$
//!
//! The ends are decimal numbers. If both are integer multiples of a sufficiently small power of ten, the first formula
//! is a quotient of two integers that are doubles, and its division rounds only once. So `0.4:2:33` contains exactly
//! the 0.45 and 1.2 that a user would type, and `-0.1:0.3:5` contains 0. In other cases sums and products carry their
//! rounding errors along, so rising exact values never give falling computed values.

use super::double::{Double, product};

/// The way in which values between the ends are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// Evenly spaced, for the ends `a / unit` and `b / unit`.
    Decimal { a: i64, b: i64, unit: f64 },
    /// Evenly spaced, for any ends.
    Weighted,
    /// With a constant ratio, given by the logarithms of the first end and of the ratio of both ends.
    Geometric { first: Double, ratio: Double },
}

/// All integers up to this one are doubles.
const WHOLE: i64 = 1 << 53;
/// Powers of ten up to this one are doubles.
const TENS: i32 = 22;

impl Rule {
    /// The rule for `steps + 1` evenly spaced values.
    pub(super) fn even(first: f64, last: f64, steps: u32) -> Self {
        decimal(first, last, steps).unwrap_or(Self::Weighted)
    }

    /// The rule for values with a constant ratio between two positive ends.
    pub(super) fn geometric(first: f64, last: f64) -> Self {
        let first = as_written(first).ln();
        Self::Geometric { first, ratio: as_written(last).ln().plus(first.negative()) }
    }

    /// Value number `k` of `steps + 1`, for 0 < k < steps.
    pub(super) fn at(&self, first: f64, last: f64, k: u32, steps: u32) -> f64 {
        let (low, high) = (first.min(last), first.max(last));
        let value = match self {
            // the product fits, because `decimal` has checked its size
            #[allow(clippy::cast_precision_loss)]
            Self::Decimal { a, b, unit } => (i64::from(steps - k) * a + i64::from(k) * b) as f64 / unit,
            Self::Weighted => weighted(first, last, k, steps),
            Self::Geometric { first, ratio } => ratio.times(f64::from(k)).over(f64::from(steps)).plus(*first).exp(),
        };
        value.clamp(low, high)
    }
}

/// The rule with a quotient of integers, if all of them are doubles.
fn decimal(first: f64, last: f64, steps: u32) -> Option<Rule> {
    let ((a, ten), (b, other)) = (digits(first)?, digits(last)?);
    let least = ten.min(other).min(0);
    if -least > TENS {
        return None;
    }
    let whole = |digits: i64, ten: i32| digits.checked_mul(10_i64.checked_pow(ten.abs_diff(least))?);
    let (a, b) = (whole(a, ten)?, whole(b, other)?);
    let most = WHOLE / i64::from(steps.max(1));
    let unit = i64::from(steps.max(1)).checked_mul(10_i64.checked_pow(least.unsigned_abs())?)?;
    #[allow(clippy::cast_precision_loss)] // no more than 2^53
    let rule = |unit: i64| Rule::Decimal { a, b, unit: unit as f64 };
    (a.abs() <= most && b.abs() <= most && unit <= WHOLE).then(|| rule(unit))
}

/// A number in its shortest decimal form: an integer and a power of ten.
fn digits(value: f64) -> Option<(i64, i32)> {
    let text = format!("{value:e}");
    let (mantissa, power) = text.split_once('e')?;
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let power: i32 = power.parse().ok()?;
    Some((format!("{whole}{part}").parse().ok()?, power - i32::try_from(part.len()).ok()?))
}

/// A number in its shortest decimal form as a double-double: the double, and its difference from the decimal number.
/// Without the difference if the integer or the power of ten is too large.
fn as_written(value: f64) -> Double {
    let rest = digits(value).filter(|(whole, ten)| whole.abs() <= WHOLE && ten.abs() <= TENS).map(|(whole, ten)| {
        let power = libm::pow(10.0, f64::from(ten.abs()));
        #[allow(clippy::cast_precision_loss)] // no more than 2^53
        let whole = whole as f64;
        if ten < 0 { libm::fma(-value, power, whole) / power } else { libm::fma(whole, power, -value) }
    });
    Double { high: value, low: rest.unwrap_or(0.0) }
}

/// The weighted mean, with the rounding errors of its products and its sum taken into account.
fn weighted(first: f64, last: f64, k: u32, steps: u32) -> f64 {
    let (k, n) = (f64::from(k), f64::from(steps));
    // a power of two that prevents overflow and underflow of the products
    let scale = match first.abs().max(last.abs()) {
        large if large > 1e200 => 2.0_f64.powi(-200),
        small if small < 1e-200 => 2.0_f64.powi(200),
        _ => 1.0,
    };
    let sum = product(n - k, first * scale).plus(product(k, last * scale));
    sum.over(n).value() / scale
}
