//! One step of a motion: a flight in one regime, and what ended it.

use super::place::{Place, Structures};
use crate::machine::Machine;
use crate::regime::{ContactState, Normal, Structure};
use std::sync::Arc;

/// What a rigid stop does at an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Blow {
    /// The stop.
    pub(crate) stop: usize,
    /// Speed of closing before it, 0 for a stop on which the structure rested.
    pub(crate) speed: f64,
    /// Its impulse, against the direction of the stop; positive.
    pub(crate) impulse: f64,
    /// The energy that it takes.
    pub(crate) loss: f64,
}

/// One step of a motion.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    /// The structure of the flight.
    pub(crate) structure: Arc<Structure>,
    /// Its duration.
    pub(crate) duration: f64,
    /// The guards of the structure that were zero at its end; none if only a surface has come back to its holder.
    pub(crate) guards: Vec<usize>,
    /// The state at its end, before the event.
    pub(crate) before: Option<Place>,
    /// The rigid stops that pushed, with their restitution.
    pub(crate) pushed: Vec<(usize, f64)>,
    /// The number of these in each round of impacts in turn; empty if all push together.
    pub(crate) rounds: Vec<usize>,
    /// Whether the last round is the sum of impacts without end.
    pub(crate) ends_still: bool,
    /// The impulses of rigid stops, without those of a chatter that was summed.
    pub(crate) blows: Vec<Blow>,
    /// The state after the event.
    pub(crate) after: Option<Place>,
    /// A chatter was summed after the event: the structure at rest, and the time for which it moved on in it.
    pub(crate) rest: Option<(Arc<Structure>, f64)>,
}

impl Passage {
    pub(super) const fn new(structure: Arc<Structure>, duration: f64) -> Self {
        Self {
            structure,
            duration,
            guards: Vec::new(),
            before: None,
            pushed: Vec::new(),
            rounds: Vec::new(),
            ends_still: false,
            blows: Vec::new(),
            after: None,
            rest: None,
        }
    }

    /// The stops that the forces opened at the end of impacts that were summed.
    pub(super) fn opened(&self) -> Vec<usize> {
        let (Some(after), Some(_)) = (&self.after, &self.rest) else { return Vec::new() };
        self.pushed.iter().map(|(j, _)| *j).filter(|j| after.states[*j] == ContactState::Open).collect()
    }

    /// The time from the beginning of the step to its end.
    pub(crate) fn time(&self) -> f64 {
        self.duration + self.rest.as_ref().map_or(0.0, |(_, time)| *time)
    }

    /// The structure that begins beyond the event, which leaves this state; `None` if there is no such structure.
    pub(super) fn beyond(
        &self,
        after: &Place,
        machine: &Machine,
        normal: &Normal,
        structures: &mut Structures,
    ) -> Option<Arc<Structure>> {
        match &self.rest {
            Some((rest, _)) => Some(rest.clone()),
            None => structures.get(machine, normal, &after.states),
        }
    }
}
