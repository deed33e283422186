//! The state of a machine at one time, as it is seen between events.

use super::event::{ContactStart, Start};
use crate::regime::ContactState;

/// A machine at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time since the start.
    pub time: f64,
    /// Whether it is one of the equal steps. Others are the two sides of each event, and the end.
    pub even: bool,
    /// Phase of the forcing, in $`[0, 2\pi)`$.
    pub phase: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Velocities.
    pub qdot: Vec<f64>,
    /// The gap $`d - w\cdot q - r(t)`$ of each stop: exactly 0 at rest on it, negative where a compliant stop is pushed in.
    pub gaps: Vec<f64>,
    /// The force of each stop, against its direction: the contact force of a compliant one, the reaction of one at rest.
    /// 0 when it is open. Forces of impacts are infinite and are not told. After the stops, the friction force of each
    /// joint: positive against positive relative velocity.
    pub forces: Vec<f64>,
    /// What each stop and, after them, each joint does.
    pub states: Vec<ContactState>,
    /// How far the surface of each stop stands back: see [`ContactStart`].
    pub surfaces: Vec<f64>,
}

impl Sample {
    /// The state as a start. A motion goes on from it up to rounding: a flight that begins between two events is not rounded
    /// as one that began at an event.
    #[must_use]
    pub fn start(&self) -> Start {
        let contact = |(place, state): (usize, &ContactState)| ContactStart {
            place,
            state: *state,
            surface: self.surfaces.get(place).copied().unwrap_or_default(),
        };
        Start {
            q: self.q.clone(),
            qdot: self.qdot.clone(),
            phase: self.phase,
            contacts: self.states.iter().enumerate().map(contact).collect(),
            exact: Vec::new(),
        }
    }
}
