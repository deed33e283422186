//! The times at which a flight can reach a stop, so that a search can skip the times between them.
//!
//! A flight is the sum of a steady part $`|f|\cos\beta t`$ and a free part, without damping $`\rho\cos(t + d)`$, where
//! $`t`$ is the time from a maximum of the steady part, and $`d`$ that from the nearest maximum of the free part to it.
//! Together they exceed the gap $`\delta`$ by at most $`E = \rho + |f| - \delta`$, if both maxima coincide. The steady
//! part alone needs $`\rho + |f|\cos\beta t \ge \delta`$, so $`\beta|t| \le h_s`$ with
//! $`|f|(1 - \cos h_s) = E`$, and the free part $`|t + d| \le h_f`$ with $`\rho(1 - \cos h_f) = E`$. As
//! $`(1 - \cos h)/h^2`$ decreases up to $`h = \pi`$, the sum can reach the stop only while
//!
//! $$`\Bigl(\frac{\beta t}{h_s}\Bigr)^2 + \Bigl(\frac{t + d}{h_f}\Bigr)^2 \le 1,`$$
//!
//! which is possible only if $`d^2 \le (h_s/\beta)^2 + h_f^2`$. From one maximum of the faster part to the next, $`d`$
//! increases by a constant on the circle of the period of the slower part. So the next maximum at which it is small
//! enough is found by the algorithm of Euclid ([`first_hit`]), however many periods pass before it.
//!
//! With damping only the condition for the steady part is used, with the amplitude to which the free part has decayed.

use super::first_hit::first_hit;
use super::horizon::Envelope;
use crate::math::{asin, exp};
use core::f64::consts::{FRAC_PI_2, PI, TAU};

/// Relative slack of the amplitudes, far above the rounding errors of their few operations.
const MARGIN: f64 = 1e-12;
/// The largest number of successive meetings that are examined before the flight is evaluated again.
const ROW: u32 = 64;
/// The number of parts of the circle, and the largest number of periods over which a meeting is searched for.
const CIRCLE: u64 = 1 << 44;
const MOST: u64 = 1 << 19;

/// The largest whole number at or below `x`, for numbers up to about 1e15. It needs no call of a function on processors
/// without an instruction for it.
fn floor(x: f64) -> f64 {
    const WHOLE: f64 = 3.0 * (1_u64 << 51) as f64;
    // the sum has no digits below 1, so the difference is the nearest whole number
    let nearest = (x + WHOLE) - WHOLE;
    if nearest > x { nearest - 1.0 } else { nearest }
}

/// The maxima of one of the two parts of a flight.
#[derive(Clone, Copy, Debug)]
struct Maxima {
    /// The time of one of them.
    at: f64,
    period: f64,
    /// The time around each at which the flight can be beyond the stop.
    half: f64,
}

impl Maxima {
    /// Of `amplitude * sin(angle + rate s)`, which must be above `level` beyond the stop; `None` if it always is.
    fn new(level: f64, amplitude: f64, angle: f64, rate: f64) -> Option<Self> {
        (level.abs() < amplitude).then(|| Self {
            at: (FRAC_PI_2 - angle) / rate,
            period: TAU / rate,
            half: (FRAC_PI_2 - asin(level / amplitude)) / rate,
        })
    }
}

/// The times at which the maxima of the two parts meet, without damping.
#[derive(Clone, Copy, Debug)]
struct Meetings {
    faster: Maxima,
    slower: Maxima,
    /// The largest distance of two maxima that meet.
    apart: f64,
    /// The period of the faster part on the circle of the slower one.
    turn: u64,
    /// The largest number of periods, and the parts of the circle by which it can be wrong after so many.
    most: u64,
}

impl Meetings {
    /// `None` if they may meet at any time.
    fn new(parts: [Maxima; 2], until: f64) -> Option<Self> {
        let [a, b] = parts;
        let (faster, slower) = if a.period < b.period { (a, b) } else { (b, a) };
        // at more than half a period of the slower part the maxima meet at any time
        let apart = (faster.half * faster.half + slower.half * slower.half).sqrt();
        let periods = until / faster.period + 2.0;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
        // both are small
        (apart < 0.499 * slower.period && periods < MOST as f64).then(|| Self {
            faster,
            slower,
            apart,
            turn: (faster.period / slower.period * CIRCLE as f64) as u64,
            most: periods as u64,
        })
    }

    /// The number of periods from a maximum of the faster part, `d` after the nearest one of the slower part, to the next
    /// that meets one of the slower part; `None` if there is none before the end of the search.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)] // parts of the circle
    fn periods(&self, d: f64) -> Option<u64> {
        let unit = CIRCLE as f64 / self.slower.period;
        // how far the next maximum of the slower part is ahead, less half the width in which they meet
        let low = if d > 0.0 { self.slower.period - d - self.apart } else { -d - self.apart };
        let slack = self.most + 16;
        let (low, high) = (low * unit, (low + 2.0 * self.apart) * unit);
        let (low, high) = ((low as u64).saturating_sub(slack).max(1), (high as u64 + slack).min(CIRCLE - 1));
        first_hit(self.turn, CIRCLE, low, high, self.most)
    }

    /// A time not before `s` and at most about `until` before which the stop cannot be reached, and the number of
    /// maxima that were examined.
    fn next(&self, s: f64, until: f64) -> (f64, u32) {
        let Self { faster, slower, apart, .. } = self;
        // the last maximum that is over at s, so that none is left out
        let mut number = floor((s - faster.half - faster.at) / faster.period);
        for examined in 1..=ROW {
            let time = faster.at + number * faster.period;
            if time - faster.half >= until {
                return (until, examined);
            }
            let d = time - slower.at;
            let d = d - slower.period * floor(d / slower.period + 0.5);
            if d.abs() > *apart {
                #[allow(clippy::cast_precision_loss)] // at most 2^19
                match self.periods(d) {
                    Some(periods) => number += periods as f64,
                    None => return (until, examined),
                }
                continue;
            }
            // the chord of the ellipse
            let (a, b) = (faster.half * faster.half, slower.half * slower.half);
            let middle = time - d * (a / (a + b));
            let half = (a * b / (a + b) * (1.0 - d * d / (a + b))).max(0.0).sqrt();
            if middle + half >= s {
                return (s.max(middle - half), examined);
            }
            number += 1.0;
        }
        (s, ROW)
    }
}

/// The times at which a flight can reach one stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    envelope: Envelope,
    gap: f64,
    /// The angle that mirrors the lower stop: pi, or 0 for the upper one.
    turned: f64,
    meetings: Option<Meetings>,
}

impl Reach {
    /// For a stop at the distance `gap` from the rest position; `sign` is +1 for the upper stop. No time after `until` is
    /// of interest.
    pub(super) fn new(envelope: Envelope, sign: f64, gap: f64, until: f64) -> Self {
        let turned = if sign > 0.0 { 0.0 } else { PI };
        let Envelope { steady, steady_angle, rho, kappa, free_angle, beta } = envelope;
        let meetings = (kappa == 0.0).then(|| {
            // the rounding errors of times, too
            let margin = MARGIN + 64.0 * f64::EPSILON * until * beta.max(1.0);
            let gap = gap - margin * (rho + steady + gap.abs());
            let free = Maxima::new(gap - steady, rho, free_angle + turned, 1.0)?;
            let steady = Maxima::new(gap - rho, steady, steady_angle + turned, beta)?;
            Meetings::new([free, steady], until)
        });
        Self { envelope, gap, turned, meetings: meetings.flatten() }
    }

    /// A time not before `s`, and not far beyond `until`, before which the stop cannot be reached; and the number of
    /// maxima that were examined for it.
    pub(super) fn next(&self, s: f64, until: f64) -> (f64, u32) {
        if self.envelope.kappa > 0.0 {
            return (s + self.wait(s), 1);
        }
        self.meetings.map_or((s, 0), |meetings| meetings.next(s, until))
    }

    /// With damping, the time from `s` until the steady part is large enough.
    fn wait(&self, s: f64) -> f64 {
        let Envelope { steady, steady_angle, rho, kappa, beta, .. } = self.envelope;
        let rho = rho * exp(-kappa * s);
        let level = self.gap - rho - MARGIN * (rho + steady + self.gap.abs());
        if level.abs() >= steady {
            return 0.0;
        }
        let opens = asin(level / steady);
        let ahead = opens - (steady_angle + self.turned + beta * s);
        // within one turn from now
        let ahead = ahead - TAU * floor(ahead * (1.0 / TAU));
        // it is large enough from `opens` to pi - `opens`
        if ahead > 2.0 * opens + PI { 0.0 } else { ahead / beta }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::Flight;
    use crate::system::{Oscillator, Start};
    use proptest::prelude::*;

    proptest! {
        /// At no time within a stride is the flight beyond the stop.
        #[test]
        fn no_stride_passes_a_stop(
            beta in prop_oneof![0.05..4.0, 0.99..1.01_f64],
            gap in -2.0..6.0_f64,
            damping in prop_oneof![Just(0.0), 0.0..0.1_f64],
            x in -6.0..0.0_f64, v in -4.0..4.0_f64, phase in 0.0..6.2_f64, from in 0.0..300.0_f64,
        ) {
            let osc = Oscillator::new(beta, gap, 0.5).unwrap().with_damping(damping).unwrap();
            let flight = Flight::new(&osc, Start { x: gap + x, v, phase });
            let Some(envelope) = Envelope::new(&flight) else { return Ok(()) };
            for (sign, stop) in [(1.0, gap), (-1.0, 1.5)] {
                let next = Reach::new(envelope, sign, stop, 1e4).next(from, 1e4).0;
                prop_assert!(next >= from);
                // on the stop or beyond: no stride
                if next == from {
                    continue;
                }
                let far = (next - from).min(200.0);
                for k in 0..400 {
                    let x = flight.state(from + far * f64::from(k) / 400.0).0;
                    prop_assert!(sign * x < stop, "{x} at {k}/400 of {far}");
                }
            }
        }
    }

    #[test]
    fn a_beat_is_crossed_at_once() {
        // both parts together reach 2.001 once in a beat of 2 pi / 0.05, for a short time
        let osc = Oscillator::new(0.95, 19.0, 0.5).unwrap();
        let steady = 1.0 / (1.0 - 0.95 * 0.95);
        let flight = Flight::new(&osc, Start { x: 0.0, v: -9.0, phase: 0.0 });
        let envelope = Envelope::new(&flight).unwrap();
        assert!((envelope.steady - steady).abs() < 1e-12);
        let next = Reach::new(envelope, 1.0, envelope.steady + envelope.rho - 1e-3, 1e6).next(0.0, 1e6).0;
        assert!(next > 20.0, "{next}");
    }
}
