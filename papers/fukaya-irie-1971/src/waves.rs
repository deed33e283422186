//! The impacts of a motion as a list, and its waveform.

use vibroimpact::motion::{EventKind, Motion};
use vibroimpact::{Oscillator, Start};

/// An impact of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Impact {
    /// Time since the start.
    pub(crate) time: f64,
    /// Time since the previous impact, or since the start.
    pub(crate) interval: f64,
    /// Phase of the force.
    pub(crate) phase: f64,
    /// Speed before and after the impact.
    pub(crate) speed: f64,
    pub(crate) rebound: f64,
}

/// The first `count` impacts from `start`, or fewer if the motion has no more.
pub(crate) fn impacts(osc: &Oscillator, start: Start, count: usize) -> Vec<Impact> {
    let mut last = 0.0;
    Motion::new(osc, start)
        .take(20 * count)
        .filter_map(|event| match event.kind {
            EventKind::Impact { velocity_before, velocity_after } => {
                let impact = Impact {
                    time: event.time,
                    interval: event.time - last,
                    phase: event.phase,
                    speed: velocity_before,
                    rebound: -velocity_after,
                };
                last = event.time;
                Some(impact)
            }
            _ => None,
        })
        .take(count)
        .collect()
}

/// Position and velocity in a flight by the equations of the paper, (6) and (8), and (3)' and (4)' at resonance: at a
/// time `z` after `(x, v)` at the phase `phase` of the force.
pub(crate) fn as_printed(beta: f64, (x, v, phase): (f64, f64, f64), z: f64) -> (f64, f64) {
    let turned = beta * z + phase;
    let (sin, cos) = z.sin_cos();
    if (beta - 1.0).abs() < f64::EPSILON {
        let c = v + 0.5 * phase.cos();
        return (
            c * sin + x * cos - 0.5 * z * turned.cos(),
            c * cos - x * sin - 0.5 * (turned.cos() - z * turned.sin()),
        );
    }
    let f = 1.0 / (1.0 - beta * beta);
    let (d, c) = (x - f * phase.sin(), v - beta * f * phase.cos());
    (d * cos + c * sin + f * turned.sin(), -d * sin + c * cos + beta * f * turned.cos())
}
