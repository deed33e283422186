//! Starts of a motion: any position within the stops, any velocity and any phase of the force.

use super::oscillator::LENGTHS;
use super::{Oscillator, SystemError, phase};

/// A start: position `x`, velocity `v`, phase of the force in $`[0, 2\pi)`$.
///
/// On a stop the mass may move in either direction or be at rest; beyond a stop is an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Position $`\xi_0`$, within the stops.
    pub x: f64,
    /// Velocity $`\dot\xi_0`$.
    pub v: f64,
    /// Phase $`\varphi_0`$ of the force, in $`[0, 2\pi)`$.
    pub phase: f64,
}

impl Start {
    /// A start of `osc`, with its phase reduced to $`[0, 2\pi)`$.
    ///
    /// # Errors
    /// [`SystemError::StartNotFinite`], [`SystemError::LargeStart`], [`SystemError::LargePhase`] or [`SystemError::BeyondStop`].
    ///
    /// ```
    /// use vibroimpact::{Oscillator, Start};
    /// let osc = Oscillator::new(1.0, 2.0, 0.5)?;
    /// assert!(Start::new(&osc, 2.0, -1.0, 7.0)?.phase < 1.0);
    /// assert!(Start::new(&osc, 2.1, 0.0, 0.0).is_err());
    /// # Ok::<(), vibroimpact::SystemError>(())
    /// ```
    pub fn new(osc: &Oscillator, x: f64, v: f64, phase: f64) -> Result<Self, SystemError> {
        for (name, value) in [("x", x), ("v", v), ("phase", phase)] {
            if !value.is_finite() {
                return Err(SystemError::StartNotFinite { name, value });
            }
        }
        if let Some((name, value)) = [("x", x), ("v", v)].into_iter().find(|(_, value)| !LENGTHS.contains(value)) {
            return Err(SystemError::LargeStart { name, value });
        }
        if phase.abs() > phase::LARGEST {
            return Err(SystemError::LargePhase(phase));
        }
        let (lowest, highest) = Self::room(osc);
        if !(lowest..=highest).contains(&x) {
            return Err(SystemError::BeyondStop { x, lowest, highest });
        }
        Ok(Self { x, v, phase: phase::wrap(phase) })
    }

    /// At the rest position of the spring, without velocity, at phase 0; on the stop if the rest position lies beyond
    /// it.
    #[must_use]
    pub fn at_rest(osc: &Oscillator) -> Self {
        let (lowest, highest) = Self::room(osc);
        Self { x: 0.0_f64.clamp(lowest, highest), v: 0.0, phase: 0.0 }
    }

    /// On the steady motion without stops, at phase 0; `None` if that motion does not clear the stops or does not exist
    /// (undamped resonance).
    #[must_use]
    pub fn free_motion(osc: &Oscillator) -> Option<Self> {
        let amplitude = osc.free_amplitude();
        if !osc.stops().all(|(_, stop)| amplitude < stop.gap) {
            return None;
        }
        Some(Self::steady(osc))
    }

    /// On the steady motion $`x = S\sin\theta + C\cos\theta`$ without stops, at phase 0, whether or not it clears them:
    /// $`S = (1-\beta^2)f^2`$, $`C = -2\zeta\beta f^2`$.
    pub(crate) fn steady(osc: &Oscillator) -> Self {
        let (beta, amplitude) = (osc.beta(), osc.free_amplitude());
        let (re, im) = ((1.0 - beta) * (1.0 + beta), 2.0 * osc.damping() * beta);
        let square = amplitude * amplitude;
        Self { x: -im * square, v: beta * re * square, phase: 0.0 }
    }

    /// The range of positions within the stops.
    #[must_use]
    pub fn room(osc: &Oscillator) -> (f64, f64) {
        let lowest = osc.stop(super::Side::Lower).map_or(f64::NEG_INFINITY, |stop| -stop.gap);
        (lowest, osc.gap())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn f10b_a_phase_beyond_the_largest_is_refused() {
        let osc = Oscillator::new(1.3, 1.0, 0.5).unwrap();
        for phase in [1e15, -1e15, 7.0] {
            assert!((0.0..core::f64::consts::TAU).contains(&Start::new(&osc, 0.0, 0.0, phase).unwrap().phase));
        }
        for phase in [1e18, -1e18, 1.000_000_1e15, f64::MAX] {
            let message = Start::new(&osc, 0.0, 0.0, phase).unwrap_err().to_string();
            assert!(message.contains("lies outside -1e15 <= phase <= 1e15"), "{message}");
        }
    }

    #[test]
    fn starts_too_far_or_too_fast_are_refused() {
        let osc = Oscillator::new(1.3, 1.0, 0.5).unwrap();
        for (x, v, name) in [(-1e300, 0.0, "x"), (0.0, 1e200, "v"), (0.0, -1e200, "v")] {
            let message = Start::new(&osc, x, v, 0.0).unwrap_err().to_string();
            assert!(message.contains(&format!("lies outside -1e100 <= {name} <= 1e100")), "{message}");
        }
        assert!(Start::new(&osc, -1e100, 1e100, 0.0).is_ok());
    }

    #[test]
    fn the_free_motion_goes_on_without_a_trace_of_transient() {
        for (beta, damping, gap) in [(0.5, 0.0, 2.0), (1.7, 0.2, 1.0), (1.0, 0.3, 2.0)] {
            let osc = Oscillator::new(beta, gap, 0.5).unwrap().with_damping(damping).unwrap();
            let start = Start::free_motion(&osc).unwrap();
            let (x, v) = crate::flight::Flight::new(&osc, start).state(osc.period());
            assert!((x - start.x).abs() < 1e-14 && (v - start.v).abs() < 1e-14);
        }
        assert_eq!(Start::free_motion(&Oscillator::new(0.9, 2.0, 0.5).unwrap()), None);
        assert_eq!(Start::free_motion(&Oscillator::new(1.0, 1e100, 0.5).unwrap()), None);
    }
}
