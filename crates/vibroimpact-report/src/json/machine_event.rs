//! An event of a machine in JSON.

use serde::Serialize;
use vibroimpact::events::MachineEvent;
use vibroimpact::machine::Machine;

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
    }
}
