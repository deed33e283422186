//! A point of a curve of a machine.

use crate::continuation::curves::CurveEvent;
use crate::orbit::machine::Cycle;

/// A point of a curve.
#[derive(Clone, Debug)]
pub struct CurvePoint {
    /// Values of the two numbers.
    pub values: (f64, f64),
    /// The cycle there. On a curve of grazing it is the one without the contact, which is also the limit of the one with
    /// it. Its multipliers on a curve of corners are those of one order of the two events, and on a curve of sticking or
    /// holding those of the cycle without the rest that takes no time.
    pub cycle: Cycle,
    /// By how much the condition fails: the distance of a multiplier from +1 or -1, or of its modulus from 1; the speed at
    /// the touch divided by the largest velocity; the difference of both phases at a corner; of
    /// sticking or holding what is missing to the limit, divided by the size of its terms, or the rate of what is touched, or of a
    /// chatter that is complete at its release by how much the ratio of speed and acceleration of its last impacts fails.
    pub residual: f64,
    /// The phase of the touch on a curve of grazing of a machine with forcing.
    pub touch: Option<f64>,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<CurveEvent>,
}
