//! A motion as functions of time: one stretch in closed form after another, between its events.

use super::contact_force::contact_forces;
use super::event::{Limits, Start};
use super::motion::Motion;
use super::sample::Sample;
use super::stretch::Stretch;
use crate::arc::Buffers;
use crate::machine::{Machine, MachineError};
use crate::regime::GuardKind;
use std::collections::VecDeque;

/// The stretches of a motion between its events, each with its state at any time. While a chatter that is summed lasts,
/// the structure is at rest on its stop.
///
/// ```
/// use vibroimpact::events::{Limits, Start, Stretches};
/// use vibroimpact::machine::{Machine, MachineParts};
/// // a ball of mass 1 under gravity 1, dropped from height 1/2 on a floor: the second flight is from time 1 to 2
/// let parts = MachineParts::new(["height"]).with_mass(0, 1.0).with_constant(0, -1.0);
/// let ball = Machine::new(parts.with_rigid_stop("floor", &[-1.0], 0.0, 0.5))?;
/// let start = Start { q: vec![0.5], ..Start::default() };
/// let mut stretches = Stretches::new(&ball, &start, Limits::default())?;
/// assert!(stretches.advance() && stretches.advance());
/// assert_eq!((stretches.begin(), stretches.duration()), (1.0, 1.0));
/// assert_eq!(stretches.at(0.5).unwrap().q, [0.125]);
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Stretches<'a> {
    machine: &'a Machine,
    motion: Motion<'a>,
    /// The present stretch, and those after it that are known.
    trail: VecDeque<Stretch>,
    begun: bool,
    buffers: Buffers,
}

impl<'a> Stretches<'a> {
    /// The motion from a start, before its first stretch.
    ///
    /// # Errors
    /// As [`Motion::new`].
    pub fn new(machine: &'a Machine, start: &Start, limits: Limits) -> Result<Self, MachineError> {
        let motion = Motion::new(machine, start, limits)?.trailed();
        Ok(Self { machine, motion, trail: VecDeque::new(), begun: false, buffers: Buffers::default() })
    }

    /// Goes to the next stretch; `false` at the end of the motion, where the last one is kept.
    pub fn advance(&mut self) -> bool {
        // the next stretch must be known before the present one is left
        while self.trail.len() < 1 + usize::from(self.begun) {
            let more = self.motion.next().is_some();
            let known = self.trail.len();
            self.trail.extend(self.motion.trail());
            if !more && self.trail.len() == known {
                return false;
            }
        }
        if self.begun {
            self.trail.pop_front();
        }
        self.begun = true;
        true
    }

    /// The time at which the present stretch begins.
    #[must_use]
    pub fn begin(&self) -> f64 {
        self.trail.front().map_or(0.0, |stretch| stretch.begin.value())
    }

    /// The time at which it ends.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.trail.front().map_or(0.0, |stretch| {
            // a sum with more digits: the end of a stretch is the beginning of the next one
            let mut end = stretch.begin;
            end += stretch.duration;
            end.value()
        })
    }

    /// How long it lasts.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.trail.front().map_or(0.0, |stretch| stretch.duration)
    }

    /// How long after its beginning a time is, without the rounding of the time of its beginning.
    pub(super) fn since_begin(&self, time: f64) -> f64 {
        self.trail.front().map_or(0.0, |stretch| {
            let mut gone = stretch.begin;
            gone += -time;
            (-gone.value()).clamp(0.0, stretch.duration)
        })
    }

    /// The state a time `s` after the beginning of the present stretch; `None` before the first one.
    pub fn at(&mut self, s: f64) -> Option<Sample> {
        let (machine, normal, buffers) = (self.machine, self.motion.normal(), &mut self.buffers);
        let stretch = self.trail.front()?;
        let Stretch { flight, place, .. } = stretch;
        let mut here = place.clone();
        flight.at(s, &mut buffers.modes);
        if s > 0.0 {
            here.move_along(flight, (&buffers.modes, s), machine.parts().frequency);
        }
        let turns = here.turns(normal);
        let stops = machine.stops().len();
        let mut gaps: Vec<f64> = (0..stops).map(|j| here.gap(normal, &turns, j).0).collect();
        // guards are counted from where they are zero exactly
        for (g, guard) in flight.structure.guards.iter().enumerate() {
            match guard.kind {
                GuardKind::Gap(j) if place.surfaces[j].is_none() => gaps[j] = flight.guard(g, &buffers.modes).0,
                // taken from 0, so that no zero is negative
                GuardKind::Depth(j) => gaps[j] = 0.0 - flight.guard(g, &buffers.modes).0,
                GuardKind::Reaction(j) => gaps[j] = 0.0,
                _ => {}
            }
        }
        let mut forces = Vec::new();
        contact_forces(machine, &place.states, (flight, &buffers.modes), &mut forces);
        Some(Sample {
            time: stretch.begin.value() + s,
            even: false,
            phase: here.phase,
            q: normal.to_machine(&here.x),
            qdot: normal.to_machine(&here.v),
            gaps,
            forces,
            surfaces: here.surfaces.iter().map(|surface| surface.map_or(0.0, |of| of.size - of.offset)).collect(),
            states: here.states,
        })
    }
}
