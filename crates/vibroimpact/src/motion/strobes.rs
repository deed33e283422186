//! The states of a motion at one phase of the force, once in every forcing period.

use super::{End, Leg, Motion};
use crate::flight::SearchLimits;
use crate::system::{Oscillator, Start, phase};

/// Events within one period before it counts as endless (restitution 1, or nearly, under preload).
const MOST_EVENTS: u32 = 1_000_000;

/// The states of a motion at a phase, in order; one motion throughout, so a long flight is searched once.
///
/// It goes on for ever, through flights and rests without end too, unless the search for the next impact gave up: where
/// nothing is known no state is returned.
///
/// ```
/// use vibroimpact::{Start, motion::Strobes, scenario};
/// let osc = scenario::T.oscillator();                     // settles into 1/2: two points in turn
/// let states: Vec<Start> = Strobes::new(&osc, Start::at_rest(&osc), 0.0).skip(2000).take(4).collect();
/// assert!((states[0].x - states[2].x).abs() < 1e-12 && (states[0].x - states[1].x).abs() > 0.1);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Strobes<'a> {
    osc: &'a Oscillator,
    motion: Motion<'a>,
    phase: f64,
    /// Time of the first state, and how many there were.
    first: f64,
    count: u64,
    leg: Option<Leg>,
    /// How much of the leg is known.
    known: f64,
}

impl<'a> Strobes<'a> {
    /// The states of the motion of `osc` from `start` at this phase of the force, the start included if it has it.
    #[must_use]
    pub fn new(osc: &'a Oscillator, start: Start, phase: f64) -> Self {
        let phase = phase::wrap(phase);
        let first = phase::wrap(phase - start.phase) / osc.beta();
        let motion = Motion::with_limits(osc, start, SearchLimits::default());
        Self { osc, motion, phase, first, count: 0, leg: None, known: 0.0 }
    }

    /// Search steps taken so far, a measure of the work done.
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.motion.steps()
    }
}

impl Iterator for Strobes<'_> {
    type Item = Start;

    #[allow(clippy::cast_precision_loss)] // exact far beyond any count that is reached
    fn next(&mut self) -> Option<Start> {
        let time = self.first + self.count as f64 * self.osc.period();
        let mut events = 0;
        let leg = loop {
            match self.leg {
                Some(leg) if time <= leg.begin + self.known => break leg,
                _ if self.motion.end().is_some() || events >= MOST_EVENTS => return None,
                _ => {}
            }
            events += 1;
            self.motion.next();
            self.leg = self.motion.leg().copied();
            self.known = match self.motion.end() {
                Some(End::NoneFor(time)) => time,
                _ => self.leg?.duration,
            };
        };
        self.count += 1;
        Some(leg.at_phase(self.osc, time - leg.begin, self.phase, self.known))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{motion::stroboscopic_map, scenario};

    /// Period by period with the map: another way to the same states.
    #[test]
    fn as_the_stroboscopic_map() {
        let osc = scenario::U.oscillator();
        let mut state = Start { x: 0.1, v: 0.2, phase: 1.5 };
        for strobe in Strobes::new(&osc, state, 1.5).take(20) {
            assert!((strobe.x - state.x).abs() < 1e-9 && (strobe.v - state.v).abs() < 1e-9, "{strobe:?} {state:?}");
            state = stroboscopic_map(&osc, state, 1000).unwrap().state;
        }
    }

    #[test]
    fn motions_without_events_have_states_too() {
        let osc = Oscillator::new(0.5, 2.0, 0.5).unwrap().with_damping(0.2).unwrap();
        let free = Start::free_motion(&osc).unwrap();
        let strobe = Strobes::new(&osc, Start { x: 1.0, v: 0.0, phase: 3.0 }, 0.0).nth(100).unwrap();
        assert!((strobe.x - free.x).abs() < 1e-13 && (strobe.v - free.v).abs() < 1e-13, "{strobe:?}");
    }
}
