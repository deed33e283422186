//! A motion between its events: states, gaps and contact forces at equal steps of time. The events do not depend on
//! them.

use super::event::{Limits, Start};
use super::sample::Sample;
use super::stretches::Stretches;
use crate::machine::{Machine, MachineError};

/// The states of a machine from its start until a time: at `0, step, 2 step, ...`, on both sides of each event, and at
/// the end. At an event the equal step is the state after it. While a chatter that is summed lasts, the structure is at
/// rest on its stop.
///
/// ```
/// use vibroimpact::events::{Limits, Samples, Start};
/// use vibroimpact::machine::{Machine, MachineParts};
/// // a ball of mass 1 under gravity 1, dropped from height 1/2 on a floor; it comes to rest at time 3
/// let parts = MachineParts::new(["height"]).with_mass(0, 1.0).with_constant(0, -1.0);
/// let ball = Machine::new(parts.with_rigid_stop("floor", &[-1.0], 0.0, 0.5))?;
/// let start = Start { q: vec![0.5], ..Start::default() };
/// let wave: Vec<_> =
///     Samples::new(&ball, &start, Limits::default(), (4.0, 0.5))?.filter(|sample| sample.even).collect();
/// assert_eq!(wave.len(), 9);
/// assert_eq!((wave[1].q[0], wave[1].gaps[0]), (0.375, 0.375));
/// assert_eq!((wave[8].gaps[0], wave[8].forces[0]), (0.0, 1.0)); // at rest the floor carries the weight
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Samples<'a> {
    stretches: Stretches<'a>,
    until: f64,
    step: f64,
    /// The number of the next equal step.
    count: f64,
    /// Whether the first point of the present stretch has been told.
    entered: bool,
    done: bool,
}

impl<'a> Samples<'a> {
    /// The motion from a start until a time, at steps of a positive length.
    ///
    /// # Errors
    /// As [`Motion::new`](super::Motion::new).
    pub fn new(
        machine: &'a Machine,
        start: &Start,
        limits: Limits,
        (until, step): (f64, f64),
    ) -> Result<Self, MachineError> {
        let mut stretches = Stretches::new(machine, start, limits)?;
        let done = !(until >= 0.0 && step > 0.0 && stretches.advance());
        Ok(Self { stretches, until, step, count: 0.0, entered: false, done })
    }

    /// The time of the next equal step; the end exactly, where it is one within rounding.
    fn due(&self) -> f64 {
        let time = self.count * self.step;
        if (time - self.until).abs() < 4.0 * f64::EPSILON * self.until { self.until } else { time }
    }
}

impl Iterator for Samples<'_> {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        if self.done {
            return None;
        }
        let begin = self.stretches.begin();
        let end = self.stretches.end();
        let last = end >= self.until;
        let end = end.min(self.until);
        let due = self.due();
        // an equal step at an event belongs to what follows it
        let even = due < end || last && due <= end;
        if !self.entered {
            self.entered = true;
            let first = due <= begin && even;
            self.count += f64::from(u8::from(first));
            self.done = last && end <= begin;
            return self.stretches.at(0.0).map(|sample| Sample { even: first, ..sample });
        }
        self.count += f64::from(u8::from(even));
        self.entered = even;
        let time = if even { due } else { end };
        self.done = last && time >= end;
        let s = if !even && !last { self.stretches.duration() } else { self.stretches.since_begin(time) };
        let sample = Sample { time, even, ..self.stretches.at(s)? };
        if !even && !self.done {
            self.done = !self.stretches.advance();
        }
        Some(sample)
    }
}
