//! The events of a motion, and the reason why the list ends.

use super::Document;
use super::event::EventObject;
use super::motion::HorizonObject;
use crate::{Asked, Units};
use serde::{Serialize, Serializer};
use vibroimpact::motion::Event;
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{Plan, Simulated};

/// The fields of `vibro simulate`. Events are converted while they are written.
#[derive(Serialize)]
struct Simulation<'a> {
    #[serde(serialize_with = "each_event")]
    events: (&'a Oscillator, &'a [Event], Units),
    end: EndObject,
}

/// The reason why the list of events ends, and the time.
#[derive(Serialize)]
pub(super) struct EndObject {
    pub(super) reason: &'static str,
    pub(super) time: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) horizon: Option<HorizonObject>,
}

/// The object of `vibro simulate`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    (osc, start): (&'a Oscillator, &Start),
    followed: &'a Simulated,
) -> impl Serialize + use<'a> {
    let horizon = followed.horizon.as_ref().map(HorizonObject::new);
    let end = EndObject { reason: followed.reason, time: followed.time * asked.units.time(), horizon };
    let answer = Simulation { events: (osc, &followed.events, asked.units), end };
    Document::new(asked, osc, plan, answer).start(start, &asked.units)
}

fn each_event<S: Serializer>(
    (osc, events, units): &(&Oscillator, &[Event], Units),
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(events.iter().map(|event| EventObject::of_oscillator(osc, event, units)))
}
