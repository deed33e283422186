//! Where a motion starts: any phase of the force, anywhere the stops allow.

use super::{Oscillator, SystemError, phase};

/// A starting point: position `x`, velocity `v`, phase of the force in $`[0, 2\pi)`$.
///
/// On a stop the mass may move either way or be at rest; beyond it is an error.
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
    /// A start of `osc`, its phase wrapped into $`[0, 2\pi)`$.
    ///
    /// # Errors
    /// [`SystemError::StartNotFinite`] or [`SystemError::BeyondStop`].
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
        let (lowest, highest) = Self::room(osc);
        if !(lowest..=highest).contains(&x) {
            return Err(SystemError::BeyondStop { x, lowest, highest });
        }
        Ok(Self { x, v, phase: phase::wrap(phase) })
    }

    /// At rest, unstretched, at phase 0; on the stop where that place is beyond one.
    #[must_use]
    pub fn at_rest(osc: &Oscillator) -> Self {
        let (lowest, highest) = Self::room(osc);
        Self { x: 0.0_f64.clamp(lowest, highest), v: 0.0, phase: 0.0 }
    }

    /// The range of positions the stops allow.
    #[must_use]
    pub fn room(osc: &Oscillator) -> (f64, f64) {
        let lowest = osc.stop(super::Side::Lower).map_or(f64::NEG_INFINITY, |stop| -stop.gap);
        (lowest, osc.gap())
    }
}
