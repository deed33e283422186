//! The states of a motion at one phase of the force, once in every forcing period.

use super::{End, Leg, Motion};
use crate::flight::SearchLimits;
use crate::system::{Oscillator, Start, phase};

/// The largest number of events within one period; more occur for restitution near 1 under preload.
const MOST_EVENTS: u32 = 1_000_000;

/// The states of a motion at one phase of the force, in order. The motion is followed only once, so a long flight is
/// searched once.
///
/// The sequence does not end, also during flights and sticking without end, unless the search for the next impact
/// reached its limits. Then nothing is known and it ends.
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
    /// Time of the first state, and the number of states so far.
    first: f64,
    count: u64,
    leg: Option<Leg>,
    /// The time since the beginning of the leg up to which it is known.
    known: f64,
}

impl<'a> Strobes<'a> {
    /// The states of the motion of `osc` from `start` at this phase of the force, including the start if it has this
    /// phase.
    #[must_use]
    pub fn new(osc: &'a Oscillator, start: Start, phase: f64) -> Self {
        let phase = phase::wrap(phase);
        let first = phase::wrap(phase - start.phase) / osc.beta();
        let motion = Motion::with_limits(osc, start, SearchLimits::default());
        Self { osc, motion, phase, first, count: 0, leg: None, known: 0.0 }
    }

    /// The number of search steps so far, a measure of the computing time.
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.motion.steps()
    }
}

impl Iterator for Strobes<'_> {
    type Item = Start;

    #[allow(clippy::cast_precision_loss)] // exact far beyond any count that is reached
    fn next(&mut self) -> Option<Start> {
        // a product, so that no rounding errors add up over many periods
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
