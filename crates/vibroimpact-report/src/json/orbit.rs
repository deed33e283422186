//! The orbits with a label: admissible ones and inadmissible solutions of the equations.

use super::Document;
use super::event::side;
use super::motion::{MotionObject, of_oscillator_cycle};
use crate::{Asked, Units};
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::orbit::{EarlierContact, Orbit};
use vibroimpact_study::Plan;

/// The fields of `vibro orbit`.
#[derive(Serialize)]
struct OrbitFields<'a> {
    orbits: Vec<OrbitObject<'a>>,
}

/// The object of `vibro orbit`.
#[must_use]
pub fn document<'a>(asked: &Asked, plan: &'a Plan, osc: &Oscillator, orbits: &[Orbit]) -> impl Serialize + use<'a> {
    let orbits = orbits.iter().map(|orbit| OrbitObject::new(orbit, osc, &asked.units)).collect();
    Document::new(asked, osc, plan, OrbitFields { orbits })
}

/// One orbit.
#[derive(Serialize)]
struct OrbitObject<'a> {
    #[serde(flatten)]
    motion: MotionObject<'a>,
    admissible: bool,
    earlier_contact: Option<ContactObject>,
}

#[derive(Serialize)]
struct ContactObject {
    /// Number of the impact before the contact, counted from 1; none if the motion has no impacts.
    after_impact: Option<usize>,
    stop: &'static str,
    /// Time from that impact, or from phase 0, to the contact.
    time: f64,
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
