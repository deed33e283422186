//! The orbits with a label: admissible ones and inadmissible solutions of the equations.

use super::Document;
use super::motion::{MotionFields, side};
use crate::{Asked, Units};
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::orbit::{EarlierContact, Orbit};
use vibroimpact::verdict::Verdict;
use vibroimpact_study::Plan;

/// The fields of `vibro orbit`.
#[derive(Serialize)]
struct OrbitFields {
    orbits: Vec<OrbitObject>,
}

/// The object of `vibro orbit`.
#[must_use]
pub fn document<'a>(asked: &Asked, plan: &'a Plan, osc: &Oscillator, orbits: &[Orbit]) -> impl Serialize + use<'a> {
    let orbits = orbits.iter().map(|orbit| OrbitObject::new(orbit, osc, &asked.units)).collect();
    Document::new(asked, osc, plan, OrbitFields { orbits })
}

/// One orbit.
#[derive(Serialize)]
struct OrbitObject {
    #[serde(flatten)]
    motion: MotionFields,
    physical: bool,
    earlier_contact: Option<ContactObject>,
}

#[derive(Serialize)]
struct ContactObject {
    /// Number of the impact before the contact, counted from 1; none if the motion has no impacts.
    after_impact: Option<usize>,
    side: &'static str,
    /// Time from that impact, or from phase 0, to the contact.
    time: f64,
}

impl OrbitObject {
    fn new(orbit: &Orbit, osc: &Oscillator, units: &Units) -> Self {
        let earlier = |contact: EarlierContact| ContactObject {
            after_impact: (!orbit.cycle.points.is_empty()).then_some(contact.flight + 1),
            side: side(contact.side),
            time: contact.time * units.time(),
        };
        Self {
            physical: orbit.physical,
            earlier_contact: orbit.earlier.map(earlier),
            motion: MotionFields::new(&Verdict::Periodic(orbit.cycle.clone()), osc, units),
        }
    }
}
