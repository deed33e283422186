//! The object of a machine: its start, the events of its motion, and the reason why the list ends.

use crate::{MachineAnswer, PROGRAM};
use serde::{Serialize, Serializer};
use vibroimpact::events::{MachineEvent, MachineStart};
use vibroimpact::machine::Machine;
use vibroimpact_study::{MachinePlan, MachineResults, MachineSimulated};

/// The object that a command prints: the machine, the start, the fields of the command, and the plan.
#[derive(Serialize)]
struct Document<'a, T> {
    machine: &'a str,
    coordinates: &'a [String],
    start: StartObject<'a>,
    #[serde(flatten)]
    result: T,
    plan: &'a MachinePlan,
    program: &'static str,
}

#[derive(Serialize)]
struct StartObject<'a> {
    q: &'a [f64],
    qdot: &'a [f64],
    phase: f64,
}

/// The fields of `vibro simulate --machine`. Events are converted while they are written.
#[derive(Serialize)]
struct Simulation<'a> {
    #[serde(serialize_with = "each_event")]
    events: (&'a [MachineEvent], &'a Machine),
    end: EndObject,
}

#[derive(Serialize)]
struct EndObject {
    reason: &'static str,
    time: f64,
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

impl Serialize for MachineAnswer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { name, plan, machine, start, results } = self;
        let MachineStart { q, qdot, phase } = start;
        let start = StartObject { q, qdot, phase: *phase };
        match results {
            MachineResults::Simulate(MachineSimulated { events, reason, time, .. }) => Document {
                machine: name,
                coordinates: &machine.parts().coordinates,
                start,
                result: Simulation { events: (events, machine), end: EndObject { reason, time: *time } },
                plan,
                program: PROGRAM,
            }
            .serialize(to),
        }
    }
}

fn each_event<S: Serializer>(
    (events, machine): &(&[MachineEvent], &Machine),
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let forced = machine.parts().frequency.is_some();
    serializer.collect_seq(events.iter().map(|event| EventObject {
        kind: event.kind.name(),
        stop: machine.name_of(event.place),
        time: event.time,
        phase: forced.then_some(event.phase),
        speed: event.speed,
        q: &event.q,
        qdot: &event.qdot,
        with: event.with.iter().map(|place| machine.name_of(*place)).collect(),
    }))
}
