//! Frequency ratios that count as fractions.
//!
//! Every double is a fraction, so a rule decides which of them count as a small one. **$`\beta`$ is $`p/q`$ if
//! $`q \le 1000`$ and the stored number equals that fraction to within two units in the last place.** This holds for
//! `1/0.7`, which is $`10/7`$, and for a fraction that is given with all its digits or by its reciprocal. Any other
//! number is used as it is stored: `1.428571428571` is not $`10/7`$. Fractions with $`q \le 1000`$ are about
//! $`10^{-6}`$ apart, so another number counts as one by chance about once in $`10^{9}`$.
//!
//! This rule is applied in this file only. Without damping it has two consequences for $`\beta = p/q`$. A flight
//! without contact repeats after $`2\pi q`$ (not at resonance, 1/1, where it grows), so "never again" can be decided
//! ([`Horizon`](crate::flight::Horizon)). And impacts can fade away to a grazing motion
//! ([`graze_limit`](crate::verdict::graze_limit)). These results are exact for the fraction. The phase of the stored
//! number drifts from it by at most $`4\cdot10^{-16}\,\beta`$ per unit of time, about $`10^{-9}`$ in a million periods.

/// The largest denominator.
const LARGEST: f64 = 1000.0;
/// The largest numerator; with a larger one the force is a billion times faster than the oscillator.
const LARGEST_NUMERATOR: f64 = 1e9;

/// The common period, in periods of the first, of motions whose frequencies have these ratios to it; `None` if one is not
/// a fraction by the rule above, or if the period is longer than a million.
pub(crate) fn common_period(mut ratios: impl Iterator<Item = f64>) -> Option<f64> {
    let common = |a: u64, b: u64| {
        let (mut x, mut y) = (a, b);
        while y > 0 {
            (x, y) = (y, x % y);
        }
        a / x * b
    };
    let whole = ratios.try_fold(1, |so_far, ratio| {
        let (_, q) = fraction(ratio)?;
        Some(common(so_far, u64::from(q))).filter(|period| *period <= 1_000_000)
    })?;
    #[allow(clippy::cast_precision_loss)] // at most a million
    Some(whole as f64)
}

/// The first convergent of the continued fraction of `beta` that equals it to within two units in the last place.
pub(super) fn fraction(beta: f64) -> Option<(u32, u32)> {
    // convergents of the continued fraction
    let (mut p0, mut q0, mut p1, mut q1) = (0.0, 1.0, 1.0, 0.0);
    let mut rest = beta;
    for _ in 0..20 {
        let whole = rest.floor();
        // each convergent from the two before it
        (p0, p1) = (p1, whole * p1 + p0);
        (q0, q1) = (q1, whole * q1 + q0);
        if q1 > LARGEST || p1 > LARGEST_NUMERATOR {
            return None;
        }
        if (p1 / q1 - beta).abs() <= 2.0 * f64::EPSILON * beta {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            // whole numbers below 1e9
            return Some((p1 as u32, q1 as u32));
        }
        rest = 1.0 / (rest - whole);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_recognised() {
        assert_eq!(fraction(1.0 / 0.7), Some((10, 7)));
        assert_eq!(fraction(1.0 / 0.6), Some((5, 3)));
        assert_eq!(fraction(1.0 / 1.11), Some((100, 111)));
        assert_eq!(fraction(2.0), Some((2, 1)));
        assert_eq!(fraction(1.0 / 3.0), Some((1, 3)));
        assert_eq!(fraction(core::f64::consts::SQRT_2), None);
        assert_eq!(fraction(1e-6), None);
    }

    /// A number near a fraction does not count as the fraction.
    #[test]
    fn numbers_beside_a_fraction_are_taken_as_they_are() {
        for (p, q) in [(10.0, 7.0), (10.0, 17.0), (2.0, 1.0), (1.0, 3.0), (100.0, 111.0)] {
            for relative in [1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-9] {
                for sign in [-1.0, 1.0] {
                    assert_eq!(fraction(p / q * (1.0 + sign * relative)), None, "{p}/{q} {relative}");
                }
            }
        }
    }
}
