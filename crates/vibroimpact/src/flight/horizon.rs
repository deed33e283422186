//! What is known of a flight before it is searched: that it never reaches a stop, or how far the search must go.
//!
//! A flight is the sum of a free part, which decays like $`\rho e^{-\kappa s}`$ or keeps its amplitude $`\rho`$, and
//! the steady motion of amplitude $`|f|`$. Three cases are decided without a time limit:
//!
//! 1. $`\rho e^{-\kappa s} + |f| < \delta`$ from some time on: no contact after it (at once if this holds at
//!    $`s = 0`$).
//! 2. Undamped with $`\beta = p/q`$: the flight repeats after $`2\pi q`$, so one common period without contact means no
//!    contact for ever. [`Oscillator::fraction`] decides which numbers count as fractions. At resonance, 1/1, the
//!    flight grows instead of repeating, and the rule does not apply.
//! 3. Otherwise there will be a contact at some time ($`\rho + |f| \ge \delta`$, phases incommensurate or
//!    $`|f| > \delta`$). A search that reaches its limit returns that there is none until then.

use super::Flight;
use crate::math::{atan2, hypot, ln, sin_cos};
use crate::system::Oscillator;
use core::f64::consts::{E, PI, TAU};

/// Why a flight never reaches a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Horizon {
    /// The amplitudes of its free and steady parts together do not reach the stops.
    Amplitude,
    /// $`\beta = p/q`$, and one common period of force and oscillator, `2 pi q`, passed without contact.
    CommonPeriod {
        /// Forcing periods in the common period.
        p: u32,
        /// Natural periods in the common period.
        q: u32,
    },
}

/// The limits of the search for the next contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchLimits {
    /// The time searched, in periods of the force or of the oscillator, whichever is slower.
    pub periods: f64,
    /// The number of steps of one search: evaluations of the flight, and strides over times in which it cannot reach
    /// the stops. An ordinary flight takes about ten.
    pub steps: u32,
}

impl Default for SearchLimits {
    /// A thousand periods, and a hundred thousand steps (a few milliseconds).
    fn default() -> Self {
        Self { periods: 1000.0, steps: 100_000 }
    }
}

impl SearchLimits {
    /// The time that is searched, unless the steps are used up before.
    #[must_use]
    pub fn horizon(&self, osc: &Oscillator) -> f64 {
        self.periods * osc.period().max(TAU)
    }
}

/// The free and the steady part of a flight, as amplitudes and angles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Envelope {
    /// Amplitude of the steady part.
    pub(super) steady: f64,
    /// Angle of the steady part at the beginning: it is `steady * sin(angle + beta s)`.
    pub(super) steady_angle: f64,
    /// A bound of the free part at the beginning,
    pub(super) rho: f64,
    /// and its rate of decay.
    pub(super) kappa: f64,
    /// Without damping the free part is `rho * sin(free_angle + s)`.
    pub(super) free_angle: f64,
    pub(super) beta: f64,
}

impl Envelope {
    /// The parts of a flight; `None` at undamped resonance, where there is no steady part.
    pub(super) fn new(flight: &Flight) -> Option<Self> {
        let (beta, zeta) = (flight.response().beta(), flight.response().damping());
        let (zr, zi) = ((1.0 - beta) * (1.0 + beta), 2.0 * zeta * beta);
        let steady = 1.0 / if zeta == 0.0 { zr.abs() } else { hypot(zr, zi) };
        if !steady.is_finite() {
            return None;
        }
        // without damping the steady part is in phase with the force, or opposite to it
        let (steady_angle, (sin, cos)) = if zeta > 0.0 {
            let angle = flight.phase - atan2(zi, zr);
            (angle, sin_cos(angle))
        } else if zr < 0.0 {
            (flight.phase - PI, (-flight.sin, -flight.cos))
        } else {
            (flight.phase, (flight.sin, flight.cos))
        };
        let (xf, vf) = (flight.x - steady * sin, flight.v - beta * steady * cos);
        let (rho, kappa) = if zeta == 0.0 {
            (hypot(xf, vf), 0.0)
        } else if zeta < 0.9 {
            let w = ((1.0 - zeta) * (1.0 + zeta)).sqrt();
            (hypot(xf, (vf + zeta * xf) / w), zeta)
        } else if zeta < 1.1 {
            // |free| <= (|xf| + |vf + zeta xf| s) e^{-slow s}, and s e^{-slow s} <= 2/(e slow) e^{-slow s/2}
            let slow = if zeta < 1.0 { zeta } else { slow_root(zeta) };
            (xf.abs() + (vf + zeta * xf).abs() * 2.0 / (E * slow), 0.5 * slow)
        } else {
            // two real exponents: |free| <= (|c1| + |c2|) e^{-slow s}
            let slow = slow_root(zeta);
            let fast = 1.0 / slow;
            (((vf + fast * xf).abs() + (vf + slow * xf).abs()) / (fast - slow), slow)
        };
        Some(Self { steady, steady_angle, rho, kappa, free_angle: atan2(xf, vf), beta })
    }

    /// The time from which on the flight does not reach a stop at distance `gap` from the rest position; `None` if it
    /// is not known.
    pub(super) fn clear_from(&self, gap: f64) -> Option<f64> {
        // the slack covers the rounding errors of the amplitudes; if |f| = gap exactly, nothing is claimed
        let slack = gap - self.steady - 1e-14 * (self.rho + self.steady + gap.abs());
        if slack > self.rho {
            Some(0.0)
        } else if slack > 0.0 && self.kappa > 0.0 {
            Some(ln(self.rho / slack) / self.kappa)
        } else {
            None
        }
    }
}

/// The slower of the two real exponents of an overdamped oscillator; their product is 1.
fn slow_root(zeta: f64) -> f64 {
    1.0 / (zeta + ((zeta - 1.0) * (zeta + 1.0)).sqrt())
}

/// What is known in advance of the whole flight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outlook {
    /// The search ends at this time,
    pub(super) until: f64,
    /// and if there was no contact before, this is why there will be none; `None`: nothing more is known.
    pub(super) never: Option<Horizon>,
    pub(super) envelope: Option<Envelope>,
}

impl Outlook {
    /// Decides how far a flight must be searched: by its amplitudes, by a common period, or up to the limits.
    pub(super) fn new(osc: &Oscillator, flight: &Flight, limits: SearchLimits) -> Self {
        let envelope = Envelope::new(flight);
        let mut outlook = Self { until: limits.horizon(osc), never: None, envelope };
        let clear = envelope.and_then(|e| {
            osc.stops().map(|(_, stop)| e.clear_from(stop.gap)).try_fold(0.0_f64, |latest, one| Some(latest.max(one?)))
        });
        if let Some(clear) = clear {
            (outlook.until, outlook.never) = (clear, Some(Horizon::Amplitude));
        } else if let Some((p, q)) = osc.common_period()
            && TAU * f64::from(q) <= outlook.until
        {
            (outlook.until, outlook.never) = (TAU * f64::from(q), Some(Horizon::CommonPeriod { p, q }));
        }
        outlook
    }
}
