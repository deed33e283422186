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
