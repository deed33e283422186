//! The events of a machine, and the reason why the list ends.

use serde::Serialize;
use vibroimpact::events::{MachineEnd, MachineEvent, MachineStart};
use vibroimpact::machine::Machine;

/// The object of `vibro simulate --machine`.
#[derive(Serialize)]
pub struct MachineEvents<'a> {
    machine: &'a str,
    coordinates: &'a [String],
    start: StartObject,
    events: Vec<EventObject<'a>>,
    end: EndObject,
}

#[derive(Serialize)]
struct StartObject {
    q: Vec<f64>,
    qdot: Vec<f64>,
    phase: f64,
}

#[derive(Serialize)]
struct EventObject<'a> {
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
}

#[derive(Serialize)]
struct EndObject {
    reason: &'static str,
    time: f64,
}

/// The name of an end; `None` is the limit of events.
#[must_use]
pub const fn end_name(end: Option<MachineEnd>) -> &'static str {
    match end {
        None => "event_limit",
        Some(MachineEnd::Never) => "no_more_impacts",
        Some(MachineEnd::Stuck) => "stuck",
        Some(MachineEnd::NoEventWithin) => "time_limit",
        Some(MachineEnd::SearchLimit) => "search_limit",
        Some(MachineEnd::Inconsistent) => "inconsistent",
        Some(MachineEnd::Collapse) => "collapse",
    }
}

impl<'a> MachineEvents<'a> {
    /// The events of `machine`, with the name under which it was asked for, and where the list ends.
    #[must_use]
    pub fn new(
        (name, machine): (&'a str, &'a Machine),
        start: &MachineStart,
        events: &'a [MachineEvent],
        (end, time): (Option<MachineEnd>, f64),
    ) -> Self {
        let or_zero = |values: &[f64]| if values.is_empty() { vec![0.0; machine.n()] } else { values.to_vec() };
        let forced = machine.parts().frequency.is_some();
        let objects = events.iter().map(|event| EventObject {
            kind: event.kind.name(),
            stop: machine.name_of(event.place),
            time: event.time,
            phase: forced.then_some(event.phase),
            speed: event.speed,
            q: &event.q,
            qdot: &event.qdot,
            with: event.with.iter().map(|place| machine.name_of(*place)).collect(),
        });
        Self {
            machine: name,
            coordinates: &machine.parts().coordinates,
            start: StartObject { q: or_zero(&start.q), qdot: or_zero(&start.qdot), phase: start.phase },
            events: objects.collect(),
            end: EndObject { reason: end_name(end), time },
        }
    }
}
