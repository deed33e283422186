//! Landing without impact: a flight that returns to the stop without speed, decided by exact algebra.
//!
//! With gap 0 and no damping a flight begins with the release at $`\theta = \pi`$, and
//!
//! $$`x(s) = f\,(\beta\sin s - \sin\beta s), \qquad f = \frac{1}{1-\beta^2}.`$$
//!
//! It returns to the stop without speed only where $`\sin s = \sin\beta s = 0`$ and $`\cos s = \cos\beta s`$, that is
//! for $`\beta = p/q`$ with odd $`p`$ and $`q`$, at $`s = q\pi`$. If both are above 1, there is an impact before. For
//! an odd $`\beta`$ or an odd $`1/\beta`$ it is the first contact; for example $`x = -\tfrac12\sin^3 s`$ for
//! $`\beta = 3`$. The acceleration vanishes too, so $`x \sim t^3`$ there. The force is zero at this moment and
//! increases, so it holds the mass until the next release at $`\theta = \pi`$: a steady motion that sticks and has no
//! impacts. By rounding, the computed motion would have an impact with a speed of $`10^{-16}`$ and a chatter. A release
//! leads to such a landing only for gap 0 and an odd $`\beta`$ or $`1/\beta`$ in the sense of [`Oscillator::fraction`],
//! so these parameters decide it.

use super::mirrored;
use crate::system::{Oscillator, Side, phase};
use core::f64::consts::PI;

/// A landing without impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// Time since the release.
    pub duration: f64,
    /// Phase of the force.
    pub phase: f64,
}

impl Landing {
    /// Whether a contact computed at this time is the landing. Its time is a triple root, which is accurate only to a
    /// third of the digits.
    pub(crate) fn is_at(&self, osc: &Oscillator, time: f64) -> bool {
        (time - self.duration).abs() <= NEAR / osc.beta().max(1.0)
    }
}

/// The tolerance as the larger of the phases of the force and of the free oscillation, far above the cube root of
/// rounding.
const NEAR: f64 = 0.1;

/// The landing of the motion released from the stop on `side`, unless it strikes the other stop before; `None` if it
/// does not land without speed.
#[must_use]
pub fn landing(osc: &Oscillator, side: Side) -> Option<Landing> {
    if osc.stop(side)?.gap != 0.0 {
        return None;
    }
    let (p, q) = osc.common_period()?;
    let odd = |n: u32| n % 2 == 1;
    // p = q is resonance, for which there is no common period
    (odd(p) && odd(q) && (p == 1 || q == 1))
        .then(|| Landing { duration: PI * f64::from(q), phase: phase::wrap(mirrored(side, 0.0)) })
}
