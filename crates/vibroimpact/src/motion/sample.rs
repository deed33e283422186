//! Points of the waveform, for display. The events of a motion do not depend on them.

use super::{Leg, Motion};
use crate::system::{Oscillator, Start, phase};

/// A point of the waveform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time since the start.
    pub time: f64,
    /// Position.
    pub x: f64,
    /// Velocity.
    pub v: f64,
    /// Phase of the force, in $`[0, 2\pi)`$.
    pub phase: f64,
}

/// The motion from `start` up to the time `until`, at times no further apart than `step`, with a point on each side of
/// every event; at most `cap` points.
///
/// ```
/// use vibroimpact::{Oscillator, Start, motion::sample};
/// let osc = Oscillator::new(1.0 / 1.8, 0.25, 0.5)?;
/// let wave = sample(&osc, Start::at_rest(&osc), 50.0, 0.05, 100_000);
/// assert!(wave.iter().all(|p| p.x <= 0.25 + 1e-14) && wave.last().unwrap().time == 50.0);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn sample(osc: &Oscillator, start: Start, until: f64, step: f64, cap: usize) -> Vec<Sample> {
    let mut points = Vec::new();
    let mut motion = Motion::new(osc, start);
    while points.len() < cap {
        let more = motion.next().is_some();
        let Some(leg) = motion.leg().copied() else {
            break;
        };
        draw(osc, &leg, until, step, cap, &mut points);
        if !more || leg.begin + leg.duration >= until {
            break;
        }
    }
    points
}

/// Adds the points of one leg.
fn draw(osc: &Oscillator, leg: &Leg, until: f64, step: f64, cap: usize, points: &mut Vec<Sample>) {
    let length = leg.duration.min(until - leg.begin).max(0.0);
    let pieces = (length / step).ceil().clamp(1.0, 1e7);
    let mut k = 0.0;
    while k <= pieces && points.len() < cap {
        let s = length * (k / pieces);
        let (x, v) = leg.state(osc, s);
        // the last point is at the requested time exactly
        let time = if k == pieces && length < leg.duration { until } else { leg.begin + s };
        points.push(Sample { time, x, v, phase: phase::advance(leg.phase, osc.beta(), s) });
        k += 1.0;
    }
}
