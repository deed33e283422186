//! The stability of a motion, from its Floquet multipliers.
//!
//! A multiplier inside the unit circle is a direction in which neighbours come nearer, one outside a direction in which they
//! go away. Without any loss, as in every elastic motion, multipliers lie on the circle itself: neighbours stay as far away.
//! Computed multipliers then lie inside or outside by rounding errors, which say nothing.
//!
//! A multiplier $`\lambda`$ is on the circle to rounding if a derivative that differs from the computed one by its
//! rounding error $`\rho`$ can have a multiplier at the point $`z = \lambda/|\lambda|`$ of the circle, that is if
//!
//! $$`\prod_{|z-\mu|<1} |z-\mu| \le \rho,`$$
//!
//! the product over all multipliers near $`z`$: a multiplier alone moves by $`\rho`$, and the two of a pair that meet, as at
//! a fold or a flip, by $`\sqrt\rho`$.

use crate::math::Multiplier;
use core::fmt;

/// Whether neighbours of a motion approach it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stability {
    /// All neighbours approach: all multipliers lie inside the unit circle.
    Stable,
    /// A multiplier lies on the unit circle to rounding and none outside: there are neighbours that stay as far away, to
    /// first order. Every motion without damping and without losses at its stops is neutral or unstable.
    Neutral,
    /// There are neighbours that go away: a multiplier lies outside the unit circle.
    Unstable,
}

impl Stability {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Stable, Self::Neutral, Self::Unstable];

    /// Its name in text, JSON and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Neutral => "neutral",
            Self::Unstable => "unstable",
        }
    }

    /// Whether all neighbours approach.
    #[must_use]
    pub const fn is_stable(self) -> bool {
        matches!(self, Self::Stable)
    }

    /// That of a motion with these multipliers, which come from a derivative with this rounding error.
    pub(crate) fn of(multipliers: &[Multiplier], rounding: f64) -> Self {
        Self::each(multipliers, rounding).max().unwrap_or(Self::Stable)
    }

    /// That of each direction; the largest is that of the motion.
    pub(crate) fn each(multipliers: &[Multiplier], rounding: f64) -> impl Iterator<Item = Self> {
        multipliers.iter().map(move |multiplier| {
            if on_circle(multiplier, multipliers, rounding) {
                Self::Neutral
            } else if multiplier.modulus() < 1.0 {
                Self::Stable
            } else {
                Self::Unstable
            }
        })
    }
}

impl fmt::Display for Stability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Whether one of these multipliers is on the unit circle to rounding.
fn on_circle(of: &Multiplier, all: &[Multiplier], rounding: f64) -> bool {
    let size = of.modulus();
    if !(size > 0.5 && size < 2.0) {
        return false;
    }
    let (re, im) = (of.re / size, of.im / size);
    let distances = all.iter().map(|other| crate::math::hypot(other.re - re, other.im - im));
    distances.filter(|distance| *distance < 1.0).product::<f64>() <= rounding
}

/// The rounding error of a derivative of this size that is the product of those of so many steps. Each step adds that of a
/// few operations, and its sines and cosines.
#[allow(clippy::cast_precision_loss)] // counts far below 2^53
pub(crate) fn rounding(steps: usize, size: f64) -> f64 {
    EACH * f64::EPSILON * (steps + 1) as f64 * size.max(1.0)
}

/// The rounding errors of one step, in units of the last place. Undamped, elastic machines and oscillators have multipliers
/// whose moduli differ from 1 by up to a tenth of this.
const EACH: f64 = 64.0;

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: f64 = 1e-14;

    fn real(values: &[f64]) -> Vec<Multiplier> {
        values.iter().map(|re| Multiplier { re: *re, im: 0.0 }).collect()
    }

    fn turned(size: f64, angle: f64) -> Vec<Multiplier> {
        let (sin, cos) = crate::math::sin_cos(angle);
        [1.0, -1.0].map(|sign| Multiplier { re: size * cos, im: sign * size * sin }).to_vec()
    }

    #[test]
    fn three_words() {
        for (multipliers, expected) in [
            (real(&[0.9, -0.2]), Stability::Stable),
            (real(&[1.0 - 1e-12, 0.3]), Stability::Stable),
            (real(&[1.0 + 1e-12, 0.3]), Stability::Unstable),
            (real(&[1.0 - 1e-15, 0.3]), Stability::Neutral),
            (real(&[-1.0 - 1e-15, 0.3]), Stability::Neutral),
            (real(&[f64::INFINITY, 0.0]), Stability::Unstable),
            (real(&[f64::NAN, 0.0]), Stability::Unstable),
            (real(&[0.0, 0.0]), Stability::Stable),
            (turned(1.0 + 1e-15, 0.7), Stability::Neutral),
            (turned(1.0 - 1e-15, 0.7), Stability::Neutral),
            (turned(1.0 - 1e-12, 0.7), Stability::Stable),
            (turned(1.0 + 1e-12, 0.7), Stability::Unstable),
            // one outside decides
            ([turned(1.0, 0.7), real(&[1.1, 0.2])].concat(), Stability::Unstable),
            // what rounding makes of two that meet
            (real(&[1.0 + 1e-8, 1.0 - 1e-8]), Stability::Neutral),
            (turned(1.0, 1e-8), Stability::Neutral),
        ] {
            assert_eq!(Stability::of(&multipliers, EXACT), expected, "{multipliers:?}");
        }
        assert_eq!(Stability::of(&[], EXACT), Stability::Stable);
        assert_eq!(Stability::ALL.map(Stability::name), ["stable", "neutral", "unstable"]);
    }
}
