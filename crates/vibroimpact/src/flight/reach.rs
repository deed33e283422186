//! When a flight can reach a stop at all: what lets a search cross long flights in strides.
//!
//! A flight is a steady part $`|f|\sin\theta_s`$ and a free part, without damping $`\rho\sin\theta_f`$. It can be beyond a stop at
//! $`\delta`$ only while
//!
//! - the steady part reaches what the free part at its largest leaves: $`|f|\sin\theta_s \ge \delta - \rho`$;
//! - the free part, what the steady one leaves: $`\rho\sin\theta_f \ge \delta - |f|`$;
//! - both are in step: their amplitude together is $`\sqrt{\rho^2 + |f|^2 + 2\rho|f|\cos(\theta_f - \theta_s)} \ge \delta`$.
//!
//! Each is a sine that grows steadily beyond a level, so that the time until it does is a difference of angles. Between two
//! beats, or where the force is slow, nothing has to be evaluated. With damping only the first is used.

use super::horizon::Envelope;
use crate::math::{asin, exp};
use core::f64::consts::{FRAC_PI_2, PI, TAU};

/// Relative slack of the amplitudes, far above the rounding of their few operations.
const MARGIN: f64 = 1e-12;
/// Strides in a row without a look at the flight itself.
const ROW: u32 = 64;

/// The times at which `sin(angle + rate s)` is beyond `sin(opens)`.
#[derive(Clone, Copy, Debug)]
struct Window {
    angle: f64,
    rate: f64,
    opens: f64,
}

impl Window {
    /// Where `amplitude * sin(angle + rate s)` is beyond `level`; `None` if that is always or never so, of which nothing is claimed.
    fn new(level: f64, amplitude: f64, angle: f64, rate: f64) -> Option<Self> {
        // the sine of a falling angle is that of a rising one, half a turn on
        let (angle, rate) = if rate < 0.0 { (PI - angle, -rate) } else { (angle, rate) };
        (rate > 0.0 && level.abs() < amplitude).then(|| Self { angle, rate, opens: asin(level / amplitude) })
    }

    /// How long from `s` on until it is open.
    fn wait(&self, s: f64) -> f64 {
        let ahead = self.opens - (self.angle + self.rate * s);
        let ahead = ahead - TAU * floor(ahead * (1.0 / TAU));
        // open from `opens` to half a turn less `opens`
        if ahead > 2.0 * self.opens + PI { 0.0 } else { ahead / self.rate }
    }
}

/// The whole number at or below, of a number up to some 1e15: without a call where the processor has no instruction for it.
fn floor(x: f64) -> f64 {
    const WHOLE: f64 = 3.0 * (1_u64 << 51) as f64;
    let nearest = (x + WHOLE) - WHOLE;
    if nearest > x { nearest - 1.0 } else { nearest }
}

/// When a flight can reach one stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    envelope: Envelope,
    gap: f64,
    /// What turns the stop into an upper one.
    turned: f64,
    /// Without damping.
    windows: [Option<Window>; 3],
}

impl Reach {
    /// For a stop at a distance `gap` from the position of rest; `sign` is +1 for the upper one.
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

    /// For the steady part, with the free one at most `rho` from now on.
    fn steady(&self, rho: f64) -> Option<Window> {
        let Envelope { steady, steady_angle, beta, .. } = self.envelope;
        let margin = MARGIN * (rho + steady + self.gap.abs());
        Window::new(self.gap - rho - margin, steady, steady_angle + self.turned, beta)
    }

    /// A time not before `s`, nor far beyond `until`, before which the stop cannot be reached; and the strides made.
    pub(super) fn next(&self, mut s: f64, until: f64) -> (f64, u32) {
        let Envelope { rho, kappa, .. } = self.envelope;
        if kappa > 0.0 {
            return (s + self.steady(rho * exp(-kappa * s)).map_or(0.0, |window| window.wait(s)), 1);
        }
        for strides in 0..ROW {
            let open = self.windows.iter().flatten().fold(s, |s, window| s + window.wait(s));
            // the angles are as good as the time
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
        // falling: sin(1 - s) is beyond 1/2 again after 1 + pi + asin(1/2)
        let falling = Window::new(0.5, 1.0, 1.0, -1.0).unwrap();
        assert_eq!(falling.wait(0.0), 0.0);
        assert!((falling.wait(1.0) - (PI + asin(0.5))).abs() < 1e-14);
    }

    proptest! {
        /// Nothing that a stride leaves out is beyond the stop.
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
