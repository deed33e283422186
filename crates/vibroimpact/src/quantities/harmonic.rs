//! The spectrum of a cycle: amplitudes and phases of the harmonics of its waveform.

use super::{Segment, cycle_segments};
use crate::flight::integrate;
use crate::math::{atan2, hypot, sin_cos};
use crate::orbit::Cycle;
use crate::system::Oscillator;
use core::f64::consts::TAU;

/// A harmonic of a motion with the period of n forcing periods, in
/// $`x = \bar x + \sum_k A_k\sin(k\theta/n + \psi_k)`$.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// k, from 1. Its frequency is k/n times that of the force.
    pub order: u32,
    /// Amplitude $`A_k`$, not negative.
    pub amplitude: f64,
    /// Phase $`\psi_k`$ in $`(-\pi, \pi]`$, where $`\theta`$ is the phase of the force at the first impact (at the release
    /// for a cycle that sticks) and increases from there without a jump.
    pub phase: f64,
}

/// The harmonics of a cycle up to the order `highest`; `None` as for [`of_cycle`](super::of_cycle).
///
/// $`A_k e^{i\psi_k} = \frac{2i}{T}\int x\,e^{-ik\theta/n}\,d\tau`$, integrated over the flights by quadrature of their closed
/// form, and in closed form while the mass sticks.
///
/// ```
/// use vibroimpact::{Oscillator, orbit, quantities::harmonics};
/// // the steady motion without impacts at resonance, amplitude 1/(2 zeta), a quarter of a period late
/// let osc = Oscillator::new(1.0, 12.0, 0.8)?.with_damping(0.05)?;
/// let cycle = orbit::without_impacts(&osc).unwrap();
/// let spectrum = harmonics(&osc, &cycle, 2).unwrap();
/// assert!((spectrum[0].amplitude - 10.0).abs() < 1e-13 && (spectrum[0].phase + 0.5 * std::f64::consts::PI).abs() < 1e-14);
/// assert!(spectrum[1].amplitude < 1e-13);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn harmonics(osc: &Oscillator, cycle: &Cycle, highest: u32) -> Option<Vec<Harmonic>> {
    let segments = cycle_segments(osc, cycle)?;
    let first = segments.iter().find_map(|segment| match segment {
        Segment::Flight { flight, .. } => Some(flight.phase),
        _ => None,
    })?;
    let periods = f64::from(cycle.label.periods);
    let total = periods * TAU / osc.beta();
    let of_order = |order: u32| {
        let rate = f64::from(order) / periods * osc.beta();
        let (mut re, mut im, mut time) = (0.0, 0.0, 0.0);
        for segment in &segments {
            // the angle of the harmonic at the beginning of the part
            let begin = rate * (time + first / osc.beta());
            match segment {
                Segment::Flight { flight, duration } => integrate(flight, *duration, rate, |s, weight, point| {
                    let (sin, cos) = sin_cos(begin + rate * s);
                    re += weight * point.x * cos;
                    im -= weight * point.x * sin;
                }),
                Segment::Chatter { side, duration, .. } | Segment::Rest { side, duration, .. } => {
                    let x = side.sign() * osc.stop(*side).map_or(0.0, |stop| stop.gap);
                    // the integral of a constant position, by the angle in the middle
                    let half = 0.5 * rate * duration;
                    let (sin, cos) = sin_cos(begin + half);
                    let length = 2.0 * sin_cos(half).0 / rate;
                    re += x * length * cos;
                    im -= x * length * sin;
                }
                Segment::Impact { .. } => {}
            }
            time += segment.duration();
        }
        // 2i/T times the integral
        let (re, im) = (-2.0 * im / total, 2.0 * re / total);
        Harmonic { order, amplitude: hypot(re, im), phase: atan2(im, re) }
    };
    Some((1..=highest).map(of_order).collect())
}
