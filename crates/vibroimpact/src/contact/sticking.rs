//! Sticking: the mass is at rest on a stop while the force presses it, and is released when the force changes sign.
//!
//! At rest on the upper stop the contact force is $`\sin\theta - \delta`$. It holds the mass while
//! $`\sin\theta \ge \delta`$, that is, for $`\theta`$ between $`\arcsin\delta`$ and
//!
//! $$`\theta_r = \pi - \arcsin\delta,`$$
//!
//! where the mass leaves with zero velocity and zero acceleration. So for $`|\delta| < 1`$ the motion after a
//! release is always the same, and a cycle that sticks is superstable. For $`\delta \le -1`$ the force never changes
//! sign (it is zero at most for a moment) and the mass sticks for ever. For $`\delta > 1`$ it never sticks.

use super::mirrored;
use crate::math::asin;
use crate::system::{Oscillator, Side, phase};
use core::f64::consts::PI;

/// How long a mass that is at rest on a stop stays there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rest {
    /// Until a release.
    Until {
        /// Time from now to the release.
        time: f64,
        /// Phase of the release, $`\pi - \arcsin\delta`$ for the upper stop.
        phase: f64,
    },
    /// For ever.
    Forever,
}

/// The phase at which the stop on `side` releases the mass, or `None` if it never holds or never releases it.
#[must_use]
pub fn release_phase(osc: &Oscillator, side: Side) -> Option<f64> {
    let gap = osc.stop(side)?.gap;
    (gap.abs() < 1.0).then(|| phase::wrap(mirrored(side, PI - asin(gap))))
}

/// The acceleration into the stop of a mass at rest on that stop at that phase, without the contact force. If it is
/// positive, the mass is pressed against the stop.
#[must_use]
pub fn pressure(osc: &Oscillator, side: Side, phase: f64) -> f64 {
    let gap = osc.stop(side).map_or(f64::INFINITY, |stop| stop.gap);
    crate::math::sin_cos(mirrored(side, phase)).0 - gap
}

/// How long a mass stays that is at rest on the stop at `side` at the phase `phase`.
#[must_use]
pub fn rest(osc: &Oscillator, side: Side, phase: f64) -> Rest {
    let Some(release) = release_phase(osc, side) else {
        let held = osc.stop(side).is_some_and(|stop| stop.gap <= -1.0);
        return if held { Rest::Forever } else { Rest::Until { time: 0.0, phase } };
    };
    let gap = osc.stop(side).map_or(0.0, |stop| stop.gap);
    let ahead = phase::wrap(release - phase);
    // it is held from asin(gap) to pi - asin(gap); a phase outside by rounding counts as the nearer end
    let held = PI - 2.0 * asin(gap);
    if ahead <= held {
        Rest::Until { time: ahead / osc.beta(), phase: release }
    } else if ahead - held < 0.5 * (core::f64::consts::TAU - held) {
        Rest::Until { time: held / osc.beta(), phase: release }
    } else {
        Rest::Until { time: 0.0, phase: release }
    }
}
