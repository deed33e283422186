//! An impact: how the mass arrives at a stop, and how it leaves, $`u_+ = -\varepsilon u_-`$ (eq. 9).

use crate::system::{Oscillator, Side, Start};

/// An arrival at a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactState {
    /// Phase of the force, in $`[0, 2\pi)`$.
    pub phase: f64,
    /// Speed of arrival, towards the stop, not negative.
    pub velocity: f64,
    /// Which stop.
    pub side: Side,
}

impl ImpactState {
    /// The start that leaves the stop after this impact.
    #[must_use]
    pub fn rebound(&self, osc: &Oscillator) -> Start {
        let (sign, stop) = (self.side.sign(), osc.stop(self.side));
        let (gap, eps) = stop.map_or((0.0, 0.0), |stop| (stop.gap, stop.restitution));
        Start { x: sign * gap, v: -sign * eps * self.velocity, phase: self.phase }
    }
}
