//! The stroboscopic map: from a state to the state one forcing period later, including all events between.

use super::{EventKind, Motion};
use crate::system::{Oscillator, Start};

/// A state one forcing period later, at the same phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strobe {
    /// The state.
    pub state: Start,
    /// The number of impacts between; of a complete chatter, only those before it was summed.
    pub impacts: u32,
    /// Whether the mass stuck on a stop in this period.
    pub stuck: bool,
}

/// The image of `start` under the stroboscopic map of `osc`; `None` if there are more than `cap` events in the period
/// (restitution 1, or nearly, under preload).
#[must_use]
pub fn stroboscopic_map(osc: &Oscillator, start: Start, cap: u32) -> Option<Strobe> {
    let period = osc.period();
    let mut motion = Motion::new(osc, start);
    let mut strobe = Strobe { state: start, impacts: 0, stuck: false };
    for _ in 0..cap {
        let event = motion.next();
        let leg = motion.leg().copied()?;
        let left = period - leg.begin;
        if event.is_none() || leg.duration > left {
            strobe.stuck |= matches!(leg.path, super::Path::Rest(_));
            // after one period the phase is the same, exactly
            strobe.state = Start { phase: start.phase, ..leg.start(osc, left) };
            return Some(strobe);
        }
        match event.map(|event| event.kind) {
            Some(EventKind::Impact { .. }) => strobe.impacts += 1,
            Some(EventKind::Stick { .. }) => strobe.stuck = true,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::Flight;

    #[test]
    fn without_impacts_it_is_the_flight() {
        let osc = Oscillator::new(1.0 / 0.7, 2.5, 0.5).unwrap();
        let start = Start { x: 0.1, v: 0.2, phase: 1.0 };
        let strobe = stroboscopic_map(&osc, start, 100).unwrap();
        let (x, v) = Flight::new(&osc, start).state(osc.period());
        assert_eq!((strobe.state.x, strobe.state.v, strobe.impacts), (x, v, 0));
    }

    #[test]
    fn a_one_over_one_motion_is_a_fixed_point() {
        let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap();
        let start = Start { x: 0.75, v: -0.5 * 2.797_349_151_953_767_4, phase: 1.190_509_613_787_888_5 };
        // from just after an impact to just after the next one: the start is moved a little past the impact
        let later = Flight::new(&osc, start).state(0.1);
        let from = Start { x: later.0, v: later.1, phase: start.phase + 0.1 * osc.beta() };
        let strobe = stroboscopic_map(&osc, from, 100).unwrap();
        assert_eq!(strobe.impacts, 1);
        assert!((strobe.state.x - from.x).abs() < 1e-13 && (strobe.state.v - from.v).abs() < 1e-13);
    }
}
