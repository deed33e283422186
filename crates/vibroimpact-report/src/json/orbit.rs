//! Orbits that were looked for: motions, or solutions of the equations that are none.

use super::Document;
use super::motion::{MotionFields, side};
use crate::{Asked, Units};
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::orbit::{EarlierContact, Orbit};
use vibroimpact::verdict::Verdict;
use vibroimpact_study::Plan;

/// What `vibro orbit` says.
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

/// One of them.
#[derive(Serialize)]
struct OrbitObject {
    #[serde(flatten)]
    motion: MotionFields,
    physical: bool,
    earlier_contact: Option<ContactObject>,
}

#[derive(Serialize)]
struct ContactObject {
    /// Counted from 1; none where the motion has no impacts.
    after_impact: Option<usize>,
    side: &'static str,
    /// Since that impact, or since phase 0.
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
