//! An event of a machine in JSON.

use serde::{Serialize, Serializer};
use serde_json::{Map, Value};
use vibroimpact::events::{MachineEvent, MachineStart};
use vibroimpact::machine::Machine;
use vibroimpact_study::machine::contact_word;

/// The JSON object of an event.
#[derive(Serialize)]
pub(super) struct EventObject<'a> {
    kind: &'static str,
    stop: &'a str,
    time: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    phase: Option<f64>,
    speed: f64,
    q: &'a [f64],
    qdot: &'a [f64],
    /// Other stops that take part at the same time.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    with: Vec<&'a str>,
    /// Whether the impacts would lead elsewhere if one of the stops were struck first.
    #[serde(skip_serializing_if = "core::ops::Not::not")]
    tie: bool,
    /// What stops and joints do after it, and the digits that the numbers leave out, where the event has its state: all fields
    /// of a [`StateObject`] are there then.
    #[serde(skip_serializing_if = "Option::is_none")]
    contacts: Option<Map<String, Value>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<Map<String, Value>>,
}

/// A state from which a motion can be started.
#[derive(Serialize)]
pub(super) struct StateObject<'a> {
    q: &'a [f64],
    qdot: &'a [f64],
    phase: f64,
    #[serde(skip_serializing_if = "Map::is_empty")]
    contacts: Map<String, Value>,
    #[serde(skip_serializing_if = "Map::is_empty")]
    exact: Map<String, Value>,
}

impl<'a> StateObject<'a> {
    pub(super) fn of(machine: &Machine, start: &'a MachineStart) -> Self {
        let MachineStart { q, qdot, phase, .. } = start;
        Self { q, qdot, phase: *phase, contacts: contacts(machine, start), exact: exact(start) }
    }
}

fn contacts(machine: &Machine, start: &MachineStart) -> Map<String, Value> {
    let contact = |contact: &vibroimpact::events::ContactStart| {
        let mut object = Map::new();
        object.insert("state".to_owned(), contact_word(contact.state).into());
        if contact.surface > 0.0 {
            object.insert("surface".to_owned(), contact.surface.into());
        }
        (machine.name_of(contact.place).to_owned(), Value::from(object))
    };
    start.contacts.iter().map(contact).collect()
}

fn exact(start: &MachineStart) -> Map<String, Value> {
    start.exact.iter().map(|(name, values)| (name.clone(), values.clone().into())).collect()
}

/// An event that is written while it is computed.
pub(super) struct EventOf<'a>(pub(super) &'a Machine, pub(super) MachineEvent);

impl Serialize for EventOf<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        event_object(self.0, &self.1).serialize(serializer)
    }
}

/// The object of an event.
pub(super) fn event_object<'a>(machine: &'a Machine, event: &'a MachineEvent) -> EventObject<'a> {
    EventObject {
        kind: event.kind.name(),
        stop: machine.name_of(event.place),
        time: event.time,
        phase: machine.parts().frequency.is_some().then_some(event.phase),
        speed: event.speed,
        q: &event.q,
        qdot: &event.qdot,
        with: event.with.iter().map(|place| machine.name_of(*place)).collect(),
        tie: event.tie,
        contacts: event.state.as_ref().map(|state| contacts(machine, state)),
        exact: event.state.as_ref().map(|state| exact(state)),
    }
}
