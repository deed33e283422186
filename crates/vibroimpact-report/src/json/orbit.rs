//! The orbits with a label: admissible ones and inadmissible solutions of the equations.

use super::event::side;
use super::motion::MotionObject;
use crate::Units;
use crate::solutions::OrbitView;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::orbit::EarlierContact;

/// The answer to `vibro orbit`.
#[derive(JsonSchema, Serialize)]
pub(super) struct OrbitAnswer<'a> {
    orbits: Vec<OrbitObject<'a>>,
}

/// One orbit.
#[derive(JsonSchema, Serialize)]
struct OrbitObject<'a> {
    #[serde(flatten)]
    motion: MotionObject<'a>,
    admissible: bool,
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
    /// Of any system, in these units.
    pub(super) fn new(orbits: &[OrbitView<'a>], units: &Units) -> Self {
        Self { orbits: orbits.iter().map(|orbit| OrbitObject::new(orbit, units)).collect() }
    }
}

impl<'a> OrbitObject<'a> {
    fn new(orbit: &OrbitView<'a>, units: &Units) -> Self {
        let earlier = |contact: EarlierContact| ContactObject {
            after_impact: orbit.has_impacts().then_some(contact.flight + 1),
            stop: side(contact.side),
            time: contact.time * units.time(),
        };
        Self {
            motion: MotionObject::of_cycle(&orbit.cycle),
            admissible: orbit.admissible,
            earlier_contact: orbit.earlier.map(earlier),
        }
    }
}
