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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{EventKind, Motion};

    #[test]
    fn f05_gap_zero_and_odd_frequencies_land_without_impact() {
        for (beta, rounds) in [(3.0, 2.0), (5.0, 3.0), (1.0 / 3.0, 1.0), (1.0 / 7.0, 1.0), (101.0, 51.0)] {
            for eps in [0.0, 0.5, 1.0] {
                let one = Oscillator::new(beta, 0.0, eps).unwrap();
                let lower = one.with_second_stop(1e3, 0.5).unwrap();
                for osc in [one, lower] {
                    let mut time = 0.0;
                    for event in Motion::released(&osc, Side::Upper).take(20) {
                        match event.kind {
                            EventKind::Stick { chatter: false, .. } => assert_eq!(event.phase, 0.0, "{beta} {eps}"),
                            EventKind::Release => {
                                let turns = (event.time - time) / osc.period();
                                assert!((turns - rounds).abs() < 1e-12, "{beta} {eps} {turns}");
                                time = event.time;
                            }
                            other => panic!("{beta} {eps}: {other:?}"),
                        }
                    }
                    assert!(time > 0.0);
                }
            }
        }
        // for nearby parameters there are impacts, and a second stop close by is struck first
        for osc in
            [Oscillator::new(3.0, 1e-9, 0.5), Oscillator::new(3.0 + 1e-9, 0.0, 0.5), Oscillator::new(2.0, 0.0, 0.5)]
        {
            let osc = osc.unwrap();
            let mut events = Motion::released(&osc, Side::Upper);
            assert!(matches!(events.next().unwrap().kind, EventKind::Impact { .. }));
        }
        let close = Oscillator::new(3.0, 0.0, 0.5).unwrap().with_second_stop(0.4, 0.5).unwrap();
        let event = Motion::released(&close, Side::Upper).next().unwrap();
        assert_eq!(event.side, Side::Lower);
    }
}
