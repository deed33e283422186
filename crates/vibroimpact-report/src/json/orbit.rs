//! The orbits with a label: admissible ones and inadmissible solutions of the equations.

use super::event::side;
use super::motion::MotionObject;
use crate::Units;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{EarlierContact, machine::Cycle};
use vibroimpact::verdict::Verdict;
use vibroimpact_study::Orbit;

/// The answer to `vibro orbit`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct OrbitAnswer<'a> {
    /// The orbits.
    pub(crate) orbits: Vec<OrbitObject<'a>>,
}

/// One orbit.
#[derive(JsonSchema, Serialize)]
pub struct OrbitObject<'a> {
    #[serde(flatten)]
    pub(crate) motion: MotionObject<'a>,
    /// False for a solution of the equations of an oscillator that passes through a stop.
    pub(crate) admissible: bool,
    /// The first contact of such a solution with a stop before its next impact.
    earlier_contact: Option<ContactObject>,
}

#[derive(JsonSchema, Serialize)]
struct ContactObject {
    /// Number of the impact before the contact, counted from 1; none if the motion has no impacts.
    after_impact: Option<usize>,
    /// `upper` or `lower`.
    stop: &'static str,
    /// Time from that impact, or from phase 0, to the contact.
    time: f64,
}

impl<'a> OrbitObject<'a> {
    pub(crate) fn of_oscillator(orbit: &Orbit, osc: &Oscillator, units: &Units) -> Self {
        let earlier = |contact: EarlierContact| ContactObject {
            after_impact: (!orbit.cycle.points.is_empty()).then_some(contact.flight + 1),
            stop: side(contact.side),
            time: contact.time * units.time(),
        };
        Self {
            admissible: orbit.admissible,
            earlier_contact: orbit.earlier.map(earlier),
            motion: MotionObject::of_oscillator(&Verdict::Periodic(orbit.cycle.clone()), osc, units),
        }
    }

    /// An orbit of a machine, of which only admissible ones are found.
    pub(crate) fn of_machine(machine: &'a Machine, cycle: &'a Cycle) -> Self {
        Self { motion: MotionObject::of_cycle(machine, cycle), admissible: true, earlier_contact: None }
    }
}
