//! The events of a motion, and the reason why the list ends.

use super::event::{self, EventObject};
use super::motion::HorizonObject;
use crate::Units;
use schemars::JsonSchema;
use serde::ser::Error;
use serde::{Serialize, Serializer};
use vibroimpact::Oscillator;
use vibroimpact::events;
use vibroimpact::machine::Machine;
use vibroimpact::motion::Event;
use vibroimpact_study::{Simulated, events_with_states};

/// The answer to `vibro simulate`.
#[derive(JsonSchema, Serialize)]
pub(super) struct SimulateAnswer<'a> {
    #[serde(serialize_with = "each_event")]
    #[schemars(with = "Vec<EventObject<'a>>")]
    events: Events<'a>,
    end: EndObject,
}

/// Events, which are converted while they are written.
pub enum Events<'a> {
    /// Of an oscillator, in these units.
    Oscillator(&'a Oscillator, &'a [Event], Box<Units>),
    /// So many of the events of a machine from a start, which were followed up to a time.
    Machine((&'a Machine, &'a events::Start), f64, usize),
}

/// The reason why the list of events ends, and the time.
#[derive(JsonSchema, Serialize)]
struct EndObject {
    /// `impact_limit`, `event_limit`, `time_limit`, `no_more_impacts`, `stuck`, `search_limit`, `inconsistent` or
    /// `collapse`.
    reason: &'static str,
    /// The time at which the list ends.
    time: f64,
    /// Why an oscillator has no more impacts, if this is decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    horizon: Option<HorizonObject>,
}

impl<'a> SimulateAnswer<'a> {
    pub(super) fn new<E>(events: Events<'a>, found: &Simulated<E>, units: &Units) -> Self {
        let horizon = found.horizon.as_ref().map(HorizonObject::new);
        Self { events, end: EndObject { reason: found.reason, time: found.time * units.time(), horizon } }
    }
}

fn each_event<S: Serializer>(events: &Events<'_>, serializer: S) -> Result<S::Ok, S::Error> {
    match events {
        Events::Oscillator(osc, events, units) => {
            serializer.collect_seq(events.iter().map(|event| EventObject::of_oscillator(osc, event, units)))
        }
        Events::Machine((machine, start), until, count) => {
            let events = events_with_states(machine, start, *until).map_err(Error::custom)?;
            serializer.collect_seq(events.take(*count).map(|event| event::EventOf(machine, event)))
        }
    }
}
