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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{MachineParts, Opening, StopLaw};
    use crate::regime::ContactState;

    fn wave(machine: &Machine, start: &Start, span: (f64, f64)) -> Vec<Sample> {
        Samples::new(machine, start, Limits::default(), span).unwrap().collect()
    }

    /// A mass of 100 kg on a spring of 10 kN/m strikes a spring of 1 MN/m at its place of rest with 1 m/s.
    #[test]
    fn the_force_of_a_spring_is_its_closed_form() {
        let law = StopLaw::Compliant { stiffness: 1e6, damping: 0.0, preload: 0.0, opening: Opening::Force };
        let parts = MachineParts::new(["mass"]).with_mass(0, 100.0).with_link(&[1.0], 1e4, 0.0);
        let machine = Machine::new(parts.with_stop("stop", &[1.0], 0.0, law)).unwrap();
        let start = Start { qdot: vec![1.0], ..Start::default() };
        let wave = wave(&machine, &start, (0.6, 1e-3));
        let rate = 1.01e4_f64.sqrt();
        let contact = core::f64::consts::PI / rate;
        let mut pressed = 0;
        for sample in &wave {
            let t = sample.time;
            if t <= contact {
                let want = 1e6 * (rate * t).sin() / rate;
                assert!((sample.forces[0] - want).abs() < 1e-9, "{sample:?}: {want}");
                assert!((sample.gaps[0] + want / 1e6).abs() < 1e-15);
                pressed += 1;
            } else if t < contact + core::f64::consts::PI / 10.0 {
                let slow = (10.0 * (t - contact)).sin();
                assert!((sample.q[0] + 0.1 * slow).abs() < 1e-14 && sample.forces[0] == 0.0, "{sample:?}");
            }
        }
        // 0, 1, ..., 31 ms; the two sides of the opening are at the end of the contact within rounding
        assert!((32..=34).contains(&pressed), "{pressed}");
        let even: Vec<f64> = wave.iter().filter(|sample| sample.even).map(|sample| sample.time).collect();
        assert_eq!(even.len(), 601);
        assert!(even.iter().zip(0_u32..).all(|(time, k)| *time == f64::from(k) * 1e-3 || *time == 0.6));
    }

    /// A mass on a table that shakes with an acceleration of 0.9 of gravity.
    #[test]
    fn a_table_carries_what_rests_on_it() {
        let mut parts = MachineParts::new(["mass"]).with_mass(0, 2.0).with_constant(0, -2.0).with_frequency(3.0);
        parts = parts.with_rigid_stop("table", &[-1.0], 0.0, 0.5);
        parts.stops[0].motion = vec![crate::machine::HarmonicMotion { order: 1, cos: 0.0, sin: 0.1 }];
        let machine = Machine::new(parts).unwrap();
        let start = Start { qdot: vec![0.3], ..Start::default() };
        for sample in wave(&machine, &start, (5.0, 0.01)) {
            // the surface is at 0.1 sin 3t
            let (up, push) = (0.1 * (3.0 * sample.time).sin(), 2.0 * (1.0 - 0.9 * (3.0 * sample.time).sin()));
            assert!((sample.q[0] - up).abs() < 1e-15 && sample.gaps[0] == 0.0, "{sample:?}");
            assert!((sample.forces[0] - push).abs() < 1e-14, "{sample:?}: {push}");
            assert_eq!(sample.states, [ContactState::Resting]);
        }
    }

    /// A block on a belt sticks to it until the spring pulls with the largest force.
    #[test]
    fn friction_holds_and_slides() {
        let parts = MachineParts::new(["block"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.0);
        let machine = Machine::new(parts.with_joint("belt", &[1.0], 0.5, 0.8, 0.1)).unwrap();
        let start = Start { qdot: vec![0.1], ..Start::default() };
        let wave = wave(&machine, &start, (9.0, 0.1));
        let held: Vec<_> = wave.iter().filter(|sample| sample.states[0] == ContactState::Holding).collect();
        assert!(held.len() > 70 && held.iter().all(|sample| (sample.forces[0] + sample.q[0]).abs() < 1e-15));
        let slides: Vec<_> = wave.iter().filter(|sample| sample.states[0] == ContactState::Backward).collect();
        assert!(slides.len() > 4 && slides.iter().all(|sample| sample.forces[0] == -0.5));
    }

    #[test]
    fn ends_and_single_points() {
        let parts = MachineParts::new(["x"]).with_mass(0, 1.0);
        let machine = Machine::new(parts.with_rigid_stop("wall", &[1.0], 1.0, 0.0)).unwrap();
        let start = Start { qdot: vec![1.0], ..Start::default() };
        let times =
            |span| wave(&machine, &start, span).iter().map(|sample| (sample.time, sample.even)).collect::<Vec<_>>();
        assert_eq!(times((0.0, 0.5)), [(0.0, true)]);
        assert_eq!(times((0.75, 0.5)), [(0.0, true), (0.5, true), (0.75, false)]);
        // the impact at 1 is also an equal step
        assert_eq!(times((1.5, 0.5)), [(0.0, true), (0.5, true), (1.0, false), (1.0, true), (1.5, true)]);
        assert_eq!(times((1.0, 0.5)), [(0.0, true), (0.5, true), (1.0, true)]);
        assert!(times((-1.0, 0.5)).is_empty() && times((1.0, 0.0)).is_empty() && times((f64::NAN, 0.5)).is_empty());
    }
}
