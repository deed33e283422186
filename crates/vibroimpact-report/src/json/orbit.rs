//! The orbits with a label: admissible ones and inadmissible solutions of the equations.

use super::event::side;
use super::motion::{MotionObject, of_oscillator_cycle};
use crate::Units;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{EarlierContact, Orbit, machine::Cycle};

/// The answer to `vibro orbit`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct OrbitAnswer<'a> {
    pub(crate) orbits: Vec<OrbitObject<'a>>,
}

/// One orbit.
#[derive(JsonSchema, Serialize)]
pub(crate) struct OrbitObject<'a> {
    #[serde(flatten)]
    pub(crate) motion: MotionObject<'a>,
    pub(crate) admissible: bool,
    earlier_contact: Option<ContactObject>,
}

#[derive(JsonSchema, Serialize)]
struct ContactObject {
    /// Number of the impact before the contact, counted from 1; none if the motion has no impacts.
    after_impact: Option<usize>,
    stop: &'static str,
    /// Time from that impact, or from phase 0, to the contact.
    time: f64,
}

impl<'a> OrbitAnswer<'a> {
    pub(crate) fn of_oscillator(found: &[Orbit], osc: &Oscillator, units: &Units) -> Self {
        Self { orbits: found.iter().map(|orbit| OrbitObject::new(orbit, osc, units)).collect() }
    }

    pub(crate) fn of_machine(machine: &'a Machine, found: &'a [Cycle]) -> Self {
        let orbit = |cycle| OrbitObject {
            motion: MotionObject::of_cycle(machine, cycle),
            // others are not found
            admissible: true,
            earlier_contact: None,
        };
        Self { orbits: found.iter().map(orbit).collect() }
    }
}

impl OrbitObject<'_> {
    fn new(orbit: &Orbit, osc: &Oscillator, units: &Units) -> Self {
        let earlier = |contact: EarlierContact| ContactObject {
            after_impact: (!orbit.cycle.points.is_empty()).then_some(contact.flight + 1),
            stop: side(contact.side),
            time: contact.time * units.time(),
        };
        Self {
            admissible: orbit.physical,
            earlier_contact: orbit.earlier.map(earlier),
            motion: of_oscillator_cycle(&orbit.cycle, osc, units),
        }
    }
}
