//! An impact: the arrival of the mass at a stop, and its rebound, $`u_+ = -\varepsilon u_-`$ (eq. 9).

use crate::system::{Oscillator, Side, Start};

/// An arrival at a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactState {
    /// Phase of the force, in $`[0, 2\pi)`$.
    pub phase: f64,
    /// Speed of arrival, towards the stop, not negative.
    pub velocity: f64,
    /// The stop.
    pub side: Side,
}

impl ImpactState {
    /// The state that leaves the stop after this impact.
    #[must_use]
    pub fn rebound(&self, osc: &Oscillator) -> Start {
        let (sign, stop) = (self.side.sign(), osc.stop(self.side));
        let (gap, speed) = stop.map_or((0.0, 0.0), |stop| (stop.gap, stop.rebound(self.velocity)));
        Start { x: sign * gap, v: -sign * speed, phase: self.phase }
    }
}
