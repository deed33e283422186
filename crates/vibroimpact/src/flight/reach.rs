//! The times at which a flight can reach a stop, so that a search can skip the times between them.
//!
//! A flight is the sum of a steady part $`|f|\sin\theta_s`$ and a free part, without damping $`\rho\sin\theta_f`$. It
//! can be beyond a stop at $`\delta`$ only while
//!
//! - the steady part is above the gap less the amplitude of the free part: $`|f|\sin\theta_s \ge \delta - \rho`$;
//! - the free part is above the gap less the amplitude of the steady part: $`\rho\sin\theta_f \ge \delta - |f|`$;
//! - the amplitude of both together is above the gap:
//!   $`\sqrt{\rho^2 + |f|^2 + 2\rho|f|\cos(\theta_f - \theta_s)} \ge \delta`$.
//!
//! Each condition is a sine of a steadily increasing angle above a level, so the time until it holds is a difference of
//! angles, and the flight need not be evaluated before. With damping only the first condition is used.

use super::horizon::Envelope;
use crate::math::{asin, exp};
use core::f64::consts::{FRAC_PI_2, PI, TAU};

/// Relative slack of the amplitudes, far above the rounding errors of their few operations.
const MARGIN: f64 = 1e-12;
/// The largest number of successive strides before the flight is evaluated again.
const ROW: u32 = 64;

/// The times at which `sin(angle + rate s)` is above `sin(opens)`.
#[derive(Clone, Copy, Debug)]
struct Window {
    angle: f64,
    rate: f64,
    opens: f64,
}

impl Window {
    /// The times at which `amplitude * sin(angle + rate s)` is above `level`; `None` if that holds always or never, and
    /// then no time is excluded.
    fn new(level: f64, amplitude: f64, angle: f64, rate: f64) -> Option<Self> {
        // sin of a decreasing angle = sin of an increasing one
        let (angle, rate) = if rate < 0.0 { (PI - angle, -rate) } else { (angle, rate) };
        (rate > 0.0 && level.abs() < amplitude).then(|| Self { angle, rate, opens: asin(level / amplitude) })
    }

    /// The time from `s` until the window is open.
    fn wait(&self, s: f64) -> f64 {
        let ahead = self.opens - (self.angle + self.rate * s);
        let ahead = ahead - TAU * floor(ahead * (1.0 / TAU));
        // it is open from `opens` to pi - `opens`
        if ahead > 2.0 * self.opens + PI {
            0.0
        } else if self.rate == 1.0 {
            // a division by 1 would take a third of the time of a stride
            ahead
        } else {
            ahead / self.rate
        }
    }
}

/// The largest whole number at or below `x`, for numbers up to about 1e15. It needs no call of a function on processors
/// without an instruction for it.
fn floor(x: f64) -> f64 {
    const WHOLE: f64 = 3.0 * (1_u64 << 51) as f64;
    let nearest = (x + WHOLE) - WHOLE;
    if nearest > x { nearest - 1.0 } else { nearest }
}

/// The times at which a flight can reach one stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    envelope: Envelope,
    gap: f64,
    /// The angle that mirrors the lower stop: pi, or 0 for the upper one.
    turned: f64,
    /// The three conditions without damping.
    windows: [Option<Window>; 3],
}

impl Reach {
    /// For a stop at the distance `gap` from the rest position; `sign` is +1 for the upper stop.
    pub(super) fn new(envelope: Envelope, sign: f64, gap: f64) -> Self {
        let turned = if sign > 0.0 { 0.0 } else { PI };
        let mut reach = Self { envelope, gap, turned, windows: [None; 3] };
        let Envelope { steady, steady_angle, rho, kappa, free_angle, beta } = envelope;
        if kappa == 0.0 {
            let size = rho + steady + gap.abs();
            let free = Window::new(gap - steady - MARGIN * size, rho, free_angle + turned, 1.0);
            let level = gap * gap - rho * rho - steady * steady - MARGIN * size * size;
            let apart = free_angle - steady_angle;
            let beat = Window::new(level, 2.0 * rho * steady, apart + FRAC_PI_2, 1.0 - beta).filter(|_| gap > 0.0);
            reach.windows = [beat, reach.steady(rho), free];
        }
        reach
    }

    /// The condition for the steady part if the amplitude of the free part is at most `rho` from now on.
    fn steady(&self, rho: f64) -> Option<Window> {
        let Envelope { steady, steady_angle, beta, .. } = self.envelope;
        let margin = MARGIN * (rho + steady + self.gap.abs());
        Window::new(self.gap - rho - margin, steady, steady_angle + self.turned, beta)
    }

    /// A time not before `s`, and not far beyond `until`, before which the stop cannot be reached; and the number of
    /// strides.
    pub(super) fn next(&self, mut s: f64, until: f64) -> (f64, u32) {
        let Envelope { rho, kappa, .. } = self.envelope;
        if kappa > 0.0 {
            return (s + self.steady(rho * exp(-kappa * s)).map_or(0.0, |window| window.wait(s)), 1);
        }
        for strides in 0..ROW {
            let open = self.windows.iter().flatten().fold(s, |s, window| s + window.wait(s));
            // the rounding error of the angles is that of the time
            let next = open - 8.0 * f64::EPSILON * open;
            if next <= s || s >= until {
                return (s, strides);
            }
            s = next;
        }
        (s, ROW)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::Flight;
    use crate::system::{Oscillator, Start};
    use proptest::prelude::*;

    #[test]
    fn waiting_for_a_level() {
        let wait = |level, angle| Window::new(level, 1.0, angle, 1.0).map_or(0.0, |window| window.wait(0.0));
        assert!((wait(0.5, 0.0) - asin(0.5)).abs() < 1e-15);
        assert_eq!(wait(0.5, 1.0), 0.0, "already above");
        assert!((wait(0.5, 3.0) - (asin(0.5) + 2.0 * PI - 3.0)).abs() < 1e-14);
        assert!((wait(-0.5, 4.5) - (2.0 * PI - asin(0.5) - 4.5)).abs() < 1e-14);
        assert_eq!(wait(-0.5, 0.0), 0.0);
        assert_eq!(wait(2.0, 0.0), 0.0);
        // decreasing angle: sin(1 - s) is above 1/2 again after 1 + pi + asin(1/2)
        let falling = Window::new(0.5, 1.0, 1.0, -1.0).unwrap();
        assert_eq!(falling.wait(0.0), 0.0);
        assert!((falling.wait(1.0) - (PI + asin(0.5))).abs() < 1e-14);
    }

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
                let next = Reach::new(envelope, sign, stop).next(from, 1e4).0;
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
        let next = Reach::new(envelope, 1.0, envelope.steady + envelope.rho - 1e-3).next(0.0, 1e6).0;
        assert!(next > 20.0, "{next}");
    }
}
