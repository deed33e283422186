//! One oscillator with one or two stops and checked parameters.
//!
//! $$`\ddot\xi + 2\zeta\dot\xi + \xi = \sin(\beta\tau + \varphi_0), \qquad \xi \le \delta \tag{2}`$$
//! $$`\xi = \delta,\ u_- > 0:\quad u_+ = -\varepsilon u_- \tag{9}`$$
//!
//! | symbol | name here | meaning | range |
//! |---|---|---|---|
//! | $`\beta`$ | `beta` | forcing frequency over natural frequency | $`[10^{-15}, 10^{15}]`$ |
//! | $`\delta`$ | `gap` | distance of the stop from the rest position; negative: preload | $`[-10^{100}, 10^{100}]`$ |
//! | $`\varepsilon`$ | `restitution` | rebound speed over arrival speed | $`[0, 1]`$ |
//! | $`\zeta`$ | `damping` | damping ratio | $`[0, 10^{15}]`$ |
//! | $`\delta_2, \varepsilon_2`$ | second stop | stands at $`\xi = -\delta_2`$ | $`\delta + \delta_2 > 0`$ |
//!
//! Equation numbers are those of K. Fukaya and T. Irie, "On the Transient Oscillation of a Vibro-Impact System",
//! Bull. Fac. Eng. Hokkaido Univ. 62 (1971) 31-39, <https://hdl.handle.net/2115/41063>, which has no damping and one stop.

use super::response::Response;
use super::{SystemError, phase};
use crate::math::hypot;

/// One of the two stops: the first, at `x = gap`, or the second, at `x = -gap` with its own gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// The first stop, which bounds `x` from above.
    Upper,
    /// The second stop, which bounds `x` from below.
    Lower,
}

impl Side {
    /// `+1` for the upper stop, `-1` for the lower: the factor that mirrors the lower stop to an upper one.
    #[inline]
    #[must_use]
    pub const fn sign(self) -> f64 {
        match self {
            Self::Upper => 1.0,
            Self::Lower => -1.0,
        }
    }

    /// The place of the stop among the stops: 0 for the upper, 1 for the lower.
    #[must_use]
    pub const fn place(self) -> usize {
        match self {
            Self::Upper => 0,
            Self::Lower => 1,
        }
    }

    /// The side of the stop at this [`place`](Self::place).
    #[must_use]
    pub const fn at(place: usize) -> Self {
        if place == 0 { Self::Upper } else { Self::Lower }
    }

    /// The side with this [`sign`](Self::sign).
    #[inline]
    pub(crate) const fn of_sign(sign: f64) -> Self {
        if sign < 0.0 { Self::Lower } else { Self::Upper }
    }
}

/// A rigid stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Distance $`\delta`$ of the stop from the rest position, outwards, nondimensional; negative for preload.
    pub gap: f64,
    /// Restitution $`\varepsilon`$ in [0, 1].
    pub restitution: f64,
}

impl Stop {
    /// The speed at which the mass leaves the stop after it arrives with `speed`: the law of impact,
    /// $`u_+ = -\varepsilon u_-`$ (eq. 9 of the 1971 paper).
    #[must_use]
    pub fn rebound(&self, speed: f64) -> f64 {
        self.restitution * speed
    }
}

/// The range of frequency ratios. At a larger ratio the rounding error of the phase of the force is of the order of a
/// radian for each radian of natural time; at a smaller one the same holds for the natural phase in one radian of the
/// force.
const RATIOS: core::ops::RangeInclusive<f64> = 1.0 / phase::LARGEST..=phase::LARGEST;
/// The smallest damping ratio besides 0.
const LEAST_DAMPING: f64 = 1e-100;

/// The range of gaps, and of positions and velocities of starts. Their squares, and their products with the largest
/// ratios, are finite.
pub(super) const LENGTHS: core::ops::RangeInclusive<f64> = -1e100..=1e100;

/// An oscillator with checked parameters. It is cheap to copy.
///
/// ```
/// use vibroimpact::Oscillator;
/// let osc = Oscillator::new(1.0 / 1.8, 0.25, 0.5)?;
/// assert!((osc.free_amplitude() - 1.446_428_571_428_571_4).abs() < 1e-12);
/// assert!(Oscillator::new(-1.0, 0.25, 0.5).is_err());
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    response: Response,
    /// The frequency ratio as a fraction, if it counts as one.
    fraction: Option<(u32, u32)>,
    upper: Stop,
    lower: Option<Stop>,
}

impl Oscillator {
    /// An undamped oscillator with one stop.
    ///
    /// # Errors
    /// [`SystemError`] for a `beta` outside [1e-15, 1e15], a `gap` outside [-1e100, 1e100], or a `restitution` outside
    /// [0, 1].
    pub fn new(beta: f64, gap: f64, restitution: f64) -> Result<Self, SystemError> {
        if !RATIOS.contains(&beta) {
            return Err(SystemError::Beta(beta));
        }
        let (response, upper) = (Response::new(beta, 0.0), stop(gap, restitution)?);
        Ok(Self { response, fraction: super::commensurable::fraction(beta), upper, lower: None })
    }

    /// The same with the frequency ratio given as $`1/\beta = \omega_n/\omega`$, the abscissa of the 1971 paper.
    ///
    /// # Errors
    /// As [`Oscillator::new`].
    pub fn from_inverse_beta(inverse_beta: f64, gap: f64, restitution: f64) -> Result<Self, SystemError> {
        // both, so that the error names the number that was given
        if !(RATIOS.contains(&inverse_beta) && RATIOS.contains(&(1.0 / inverse_beta))) {
            return Err(SystemError::InverseBeta(inverse_beta));
        }
        Self::new(1.0 / inverse_beta, gap, restitution)
    }

    /// The same oscillator with viscous damping $`\zeta = 0`$ or $`10^{-100} \le \zeta \le 10^{15}`$; 1 is critical. The square of the
    /// amplitude at resonance, $`1/2\zeta`$, must be a number.
    ///
    /// # Errors
    /// [`SystemError::Damping`] for any other `damping`.
    pub fn with_damping(self, damping: f64) -> Result<Self, SystemError> {
        if damping != 0.0 && !(LEAST_DAMPING..=*RATIOS.end()).contains(&damping) {
            return Err(SystemError::Damping(damping));
        }
        Ok(Self { response: Response::new(self.beta(), damping), ..self })
    }

    /// The same oscillator with a second stop at `x = -gap`.
    ///
    /// # Errors
    /// [`SystemError::NoRoom`] if the two stops touch or cross, otherwise as [`Oscillator::new`].
    pub fn with_second_stop(self, gap: f64, restitution: f64) -> Result<Self, SystemError> {
        let lower = stop(gap, restitution)?;
        let width = self.upper.gap + lower.gap;
        if width > 0.0 {
            Ok(Self { lower: Some(lower), ..self })
        } else {
            Err(SystemError::NoRoom { upper: self.upper.gap, lower: -lower.gap, width })
        }
    }

    /// The fraction $`p/q`$ in lowest terms, $`q \le 1000`$, that equals $`\beta`$ to within two units in the last
    /// place; `None` if there is none.
    ///
    /// ```
    /// use vibroimpact::Oscillator;
    /// assert_eq!(Oscillator::from_inverse_beta(0.7, 2.5, 0.5)?.fraction(), Some((10, 7)));
    /// assert_eq!(Oscillator::new(1.4285714285728572, 2.5, 0.5)?.fraction(), None);
    /// # Ok::<(), vibroimpact::SystemError>(())
    /// ```
    #[must_use]
    pub const fn fraction(&self) -> Option<(u32, u32)> {
        self.fraction
    }

    /// This fraction, if flights repeat after a common period: without damping and away from resonance.
    pub(crate) fn common_period(&self) -> Option<(u32, u32)> {
        // at resonance the motion grows and does not repeat
        if self.damping() > 0.0 { None } else { self.fraction.filter(|(p, q)| p != q) }
    }

    /// Frequency ratio $`\beta = \omega/\omega_n`$.
    #[inline]
    #[must_use]
    pub const fn beta(&self) -> f64 {
        self.response.beta()
    }

    /// Damping ratio $`\zeta`$.
    #[inline]
    #[must_use]
    pub const fn damping(&self) -> f64 {
        self.response.damping()
    }

    /// Gap $`\delta`$ of the first stop.
    #[inline]
    #[must_use]
    pub const fn gap(&self) -> f64 {
        self.upper.gap
    }

    /// Restitution $`\varepsilon`$ of the first stop.
    #[inline]
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.upper.restitution
    }

    /// The stop on that side; `None` if there is none.
    #[inline]
    #[must_use]
    pub const fn stop(&self, side: Side) -> Option<Stop> {
        match side {
            Side::Upper => Some(self.upper),
            Side::Lower => self.lower,
        }
    }

    /// The stops, the first one first.
    pub fn stops(&self) -> impl Iterator<Item = (Side, Stop)> {
        [Some((Side::Upper, self.upper)), self.lower.map(|stop| (Side::Lower, stop))].into_iter().flatten()
    }

    /// Forcing period $`2\pi/\beta`$.
    #[must_use]
    pub fn period(&self) -> f64 {
        core::f64::consts::TAU / self.beta()
    }

    /// Amplitude of the steady motion without stops, $`|f| = 1/\sqrt{(1-\beta^2)^2 + (2\zeta\beta)^2}`$; infinite at
    /// undamped resonance.
    #[must_use]
    pub fn free_amplitude(&self) -> f64 {
        let beta = self.beta();
        // two factors: 1 - beta^2 would cancel near resonance
        1.0 / hypot((1.0 - beta) * (1.0 + beta), 2.0 * self.damping() * beta)
    }

    /// A length of the order of the size of its motions, $`1 + |\delta| + \min(|f|, 10)`$. Boxes of starts and starting
    /// guesses are proportional to it.
    pub(crate) fn size(&self) -> f64 {
        1.0 + self.gap().abs() + self.free_amplitude().min(10.0)
    }

    /// The closed-form response of this oscillator.
    #[inline]
    #[must_use]
    pub const fn response(&self) -> &Response {
        &self.response
    }
}

fn stop(gap: f64, restitution: f64) -> Result<Stop, SystemError> {
    if !LENGTHS.contains(&gap) {
        return Err(SystemError::Gap(gap));
    }
    if !(0.0..=1.0).contains(&restitution) {
        return Err(SystemError::Restitution(restitution));
    }
    Ok(Stop { gap, restitution })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_systems_are_named() {
        for beta in [0.0, -1.0, f64::NAN, f64::INFINITY, 9e-16, 1.1e15, 5e-324, 1e50] {
            assert!(matches!(Oscillator::new(beta, 1.0, 0.5), Err(SystemError::Beta(_))));
            assert!(matches!(Oscillator::from_inverse_beta(beta, 1.0, 0.5), Err(SystemError::InverseBeta(_))));
        }
        for gap in [f64::NAN, f64::INFINITY, -1.1e100, 1e300] {
            assert!(matches!(Oscillator::new(1.0, gap, 0.5), Err(SystemError::Gap(_))));
        }
        for eps in [-1e-9, 1.0 + 1e-9, f64::NAN] {
            assert!(matches!(Oscillator::new(1.0, 1.0, eps), Err(SystemError::Restitution(_))));
        }
        let osc = Oscillator::new(1.0, 1.0, 0.5).unwrap();
        assert_eq!(osc.with_damping(-0.1), Err(SystemError::Damping(-0.1)));
        assert!(osc.with_damping(1e155).is_err() && osc.with_damping(1e15).is_ok());
        assert!(
            osc.with_damping(1e-101).is_err() && osc.with_damping(1e-100).is_ok() && osc.with_damping(-0.0).is_ok()
        );
        assert!(osc.with_damping(f64::NAN).is_err());
        for beta in [1e-15, 1e15] {
            assert!(Oscillator::new(beta, 1.0, 0.5).is_ok() && Oscillator::from_inverse_beta(beta, 1.0, 0.5).is_ok());
        }
        assert!(SystemError::Beta(5e-324).to_string().starts_with("frequency ratio beta = 5e-324 lies outside"));
        assert!(matches!(osc.with_second_stop(-1.0, 0.5), Err(SystemError::NoRoom { .. })));
        assert!(osc.with_second_stop(-0.5, 0.5).is_ok());
        let sentence = SystemError::Restitution(1.4).to_string();
        assert!(sentence.starts_with("restitution eps = 1.4 lies outside 0 <= eps <= 1"));
    }
}
