//! A point of a curve in two parameters, and the options of a curve.

use super::event::CurveEvent;
use crate::orbit::Cycle;

/// A point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Values of the two parameters.
    pub values: (f64, f64),
    /// The cycle; on a grazing curve it includes the impact of speed zero.
    pub cycle: Cycle,
    /// Whether the cycle is admissible (on a grazing curve, apart from that impact; at an event, as a limit of
    /// admissible cycles).
    pub physical: bool,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<CurveEvent>,
}

/// Step length and limit of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveOptions {
    /// The longest step: phases in radians, speeds, and parameters in quarters of their ranges.
    pub longest: f64,
    /// The largest number of points.
    pub points: u32,
}

impl Default for CurveOptions {
    /// Steps up to 0.05, 20 000 points.
    fn default() -> Self {
        Self { longest: 0.05, points: 20_000 }
    }
}
