//! The events of a motion, and the reason why the list ends.

use crate::json::event::{self, EventObject};
use crate::json::motion::HorizonObject;
use crate::number::short;
use crate::text::Teller;
use crate::text::machine::kind_and_speed;
use crate::text::words::aligned;
use crate::{AnswerOf, Units};
use schemars::JsonSchema;
use serde::ser::Error;
use serde::{Serialize, Serializer};
use vibroimpact::Oscillator;
use vibroimpact::events;
use vibroimpact::machine::Machine;
use vibroimpact::motion::{Event, EventKind};
use vibroimpact::verdict::Verdict;
use vibroimpact_study::{SimulatePlan, Simulated, SystemPlan, Task, events_with_states};

/// The answer to `vibro simulate`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct SimulateAnswer<'a> {
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
    pub(crate) fn new<E>(events: Events<'a>, found: &Simulated<E>, units: &Units) -> Self {
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

/// The events, and the reason why the list ends.
pub(crate) fn text(of: &AnswerOf<SystemPlan>, followed: &Simulated) -> String {
    let units = &of.units;
    let heads = [
        units.named("time", "s"),
        "phase".into(),
        "<event".into(),
        units.named("before", "m/s"),
        units.named("after", "m/s"),
    ];
    let both = of.written.second_stop.is_some();
    let rows: Vec<Vec<String>> = followed
        .events
        .iter()
        .map(|event| {
            let mut row = vec![short(event.time * units.time()), short(event.phase)];
            let at = if both && event.side == vibroimpact::Side::Lower { " (second stop)" } else { "" };
            let name = match event.kind {
                EventKind::Impact { .. } => "impact",
                EventKind::Graze { .. } => "graze",
                EventKind::Stick { chatter: true, .. } => "stick after chatter",
                EventKind::Stick { chatter: false, .. } => "stick",
                EventKind::Release => "release",
            };
            row.push(format!("{name}{at}"));
            if let EventKind::Impact { velocity_before, velocity_after } = event.kind {
                row.push(short(velocity_before * units.velocity()));
                row.push(short(velocity_after * units.velocity()));
            }
            row
        })
        .collect();
    let no_impact = followed.horizon.map(|horizon| SystemPlan::meaning(of, &Verdict::NoImpact(horizon)));
    listed(&heads, &rows) + &end(followed.reason, &of.plan.task, &short(followed.time * units.time()), no_impact)
}

/// The same of a machine, with its coordinates and velocities after each event.
pub(crate) fn of_machine(followed: &Simulated<events::Event>, task: &Task, machine: &Machine) -> String {
    let forced = machine.period().is_some();
    let coordinates = &machine.parts().coordinates;
    let heads: Vec<String> = [Some("time"), forced.then_some("phase"), Some("<event"), Some("<stop"), Some("speed")]
        .into_iter()
        .flatten()
        .map(str::to_owned)
        .chain(coordinates.iter().cloned())
        .chain(coordinates.iter().map(|name| format!("{name}'")))
        .collect();
    let row = |event: &events::Event| {
        let begin = core::iter::once(short(event.time)).chain(forced.then(|| short(event.phase)));
        let (kind, speed) = kind_and_speed(event);
        let what = [kind, machine.name_of(event.place).to_owned(), speed];
        begin.chain(what).chain(event.q.iter().chain(&event.qdot).map(|value| short(*value))).collect()
    };
    let rows: Vec<Vec<String>> = followed.events.iter().map(row).collect();
    // without such a limit a motion ends at the longest time between two events
    let endless = followed.reason == "time_limit" && followed.until.is_infinite();
    let reason = if endless { "no further event" } else { followed.reason };
    listed(&heads, &rows) + &end(reason, task, &short(followed.time), None)
}

fn listed(heads: &[String], rows: &[Vec<String>]) -> String {
    if rows.is_empty() { "no events\n".to_owned() } else { aligned(heads, rows) }
}

/// Why the list of events of this task ends, and when; `no_impact` says why there are no more impacts.
fn end(reason: &str, task: &Task, time: &str, no_impact: Option<String>) -> String {
    match reason {
        "no_more_impacts" => {
            let why = no_impact.unwrap_or_else(|| "no more impacts, ever".to_owned());
            format!("end     after time {time}: {why}\n")
        }
        "stuck" => format!("end     after time {time}: it stays on the stop for ever\n"),
        "impact_limit" => format!("end     at time {time}: the number of impacts asked for\n"),
        "event_limit" => format!("end     at time {time}: the number of events asked for\n"),
        "time_limit" => {
            let limit = match task {
                Task::Simulate(SimulatePlan { time: Some(_), periods: None, .. }) => "time",
                Task::Simulate(SimulatePlan { time: Some(_), periods: Some(_), .. }) => "time or number of periods",
                _ => "number of periods",
            };
            format!("end     at time {time}: the {limit} asked for\n")
        }
        "search_limit" => format!("end     after time {time}: the search for the next impact ran out of steps\n"),
        other => format!("end     after time {time}: {}\n", other.replace('_', " ")),
    }
}
