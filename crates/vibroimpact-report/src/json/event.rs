//! The events of a motion, and states from which a motion can be started, of every system.

use crate::Units;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value};
use std::borrow::Cow;
use vibroimpact::events;
use vibroimpact::machine::Machine;
use vibroimpact::motion::{Event, EventKind};
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::{Segment, cycle_segments};
use vibroimpact::{Oscillator, Side, Start};
use vibroimpact_study::machine::contact_word;

/// The name of a stop of an oscillator.
pub(crate) const fn side(side: Side) -> &'static str {
    match side {
        Side::Upper => "upper",
        Side::Lower => "lower",
    }
}

/// A system whose stops have names.
pub trait Stops {
    /// The name of stop number `stop`.
    fn name_of_stop(&self, stop: usize) -> &str;
}

impl Stops for Oscillator {
    fn name_of_stop(&self, stop: usize) -> &str {
        side(Side::at(stop))
    }
}

impl Stops for Machine {
    fn name_of_stop(&self, stop: usize) -> &str {
        self.name_of(stop)
    }
}

/// An event of a motion.
#[derive(Clone, Debug, Default, JsonSchema, PartialEq, Serialize)]
pub struct EventObject<'a> {
    /// Its kind: `impact`, `close`, `open`, `stick`, `release`, `slip`, `hold`, `graze` or `collapse`.
    pub kind: &'static str,
    /// The stop, or the friction joint.
    pub stop: &'a str,
    /// Time since the start.
    pub time: f64,
    /// Phase of the force; absent without forcing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase: Option<f64>,
    /// Speed of closing, or of separation at an opening; never negative.
    pub speed: f64,
    /// Where a joint begins to slip: forwards (1) or backwards (-1).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<f64>,
    /// Coordinates.
    pub q: Cow<'a, [f64]>,
    /// Velocities after the event.
    pub qdot: Cow<'a, [f64]>,
    /// Other stops that take part at the same time.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub with: Vec<&'a str>,
    /// Whether the impacts would lead elsewhere if one of the stops were struck first.
    #[serde(skip_serializing_if = "core::ops::Not::not")]
    pub tie: bool,
    /// The distance from the stop at a grazing contact of an oscillator, zero to within rounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth: Option<f64>,
    /// Whether a complete chatter ends where an oscillator begins to stick.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chatter: Option<bool>,
    /// A bound on the error of that time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// What the stops and joints of a machine do after it, where the event has its state: all fields of a state are there then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contacts: Option<Map<String, Value>>,
    /// The digits that the numbers leave out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<Map<String, Value>>,
}

impl EventObject<'static> {
    /// An event of an oscillator, in these units.
    #[must_use]
    pub fn of_oscillator(osc: &Oscillator, event: &Event, units: &Units) -> Self {
        let stop = osc.stop(event.side).map_or(f64::NAN, |stop| event.side.sign() * stop.gap * units.length());
        let bare = Self {
            kind: "release",
            stop: side(event.side),
            time: event.time * units.time(),
            phase: Some(event.phase),
            q: vec![stop].into(),
            qdot: vec![0.0].into(),
            ..Self::default()
        };
        match event.kind {
            EventKind::Impact { velocity_before, velocity_after } => Self {
                kind: "impact",
                speed: velocity_before * units.velocity(),
                // without a rebound 0, not -0
                qdot: vec![event.side.sign() * velocity_after * units.velocity() + 0.0].into(),
                ..bare
            },
            EventKind::Graze { depth } => Self { kind: "graze", depth: Some(depth * units.length()), ..bare },
            EventKind::Stick { chatter, error } => {
                Self { kind: "stick", chatter: Some(chatter), error: Some(error * units.time()), ..bare }
            }
            EventKind::Release => bare,
        }
    }
}

/// The closings of stops among events.
pub(crate) fn closings<'e, 'a>(events: &'e [EventObject<'a>]) -> impl Iterator<Item = &'e EventObject<'a>> + Clone {
    events.iter().filter(|event| matches!(event.kind, "impact" | "close"))
}

/// The speed of the fastest closing among events.
pub(crate) fn fastest(events: &[EventObject<'_>]) -> f64 {
    closings(events).map(|event| event.speed).fold(0.0, f64::max)
}

/// The events of a cycle of an oscillator over one period, beginning with its fastest impact, from which times are counted. Of a
/// complete chatter the first impacts are listed; those that are summed are not.
pub(crate) fn of_cycle(osc: &Oscillator, cycle: &Cycle, units: &Units) -> Vec<EventObject<'static>> {
    // a release that does not return to itself makes no cycle
    let segments = cycle_segments(osc, cycle).unwrap_or_default();
    let mut events: Vec<Event> = Vec::new();
    let mut time = 0.0;
    let phase = |segment: &Segment| match *segment {
        Segment::Flight { flight, .. } => Some(flight.phase_at(0.0)),
        Segment::Chatter { phase, .. } | Segment::Rest { phase, .. } => Some(phase),
        Segment::Impact { .. } => None,
    };
    for (k, segment) in segments.iter().enumerate() {
        // the phase at which the next part begins; a cycle that sticks ends with its release
        let next = || segments.iter().cycle().skip(k + 1).find_map(phase).unwrap_or_default();
        match *segment {
            Segment::Flight { .. } => {}
            Segment::Impact { side, speed } => {
                let restitution = osc.stop(side).map_or(0.0, |stop| stop.restitution);
                let kind = EventKind::Impact { velocity_before: speed, velocity_after: -restitution * speed };
                events.push(Event { time, phase: next(), side, kind });
            }
            Segment::Chatter { side, duration, .. } => {
                let kind = EventKind::Stick { chatter: true, error: 0.0 };
                events.push(Event { time: time + duration, phase: next(), side, kind });
            }
            Segment::Rest { side, phase, duration } => {
                if !events.last().is_some_and(|event| matches!(event.kind, EventKind::Stick { .. })) {
                    let kind = EventKind::Stick { chatter: false, error: 0.0 };
                    events.push(Event { time, phase, side, kind });
                }
                events.push(Event { time: time + duration, phase: next(), side, kind: EventKind::Release });
            }
        }
        time += segment.duration();
    }
    let speed = |event: &Event| match event.kind {
        EventKind::Impact { velocity_before, .. } => velocity_before,
        _ => -1.0,
    };
    // of equally fast ones the first
    let fastest = (0..events.len()).rev().max_by(|a, b| speed(&events[*a]).total_cmp(&speed(&events[*b])));
    if let Some(first) = fastest {
        let begin = events[first].time;
        events[..first].iter_mut().for_each(|event| event.time += time);
        events.rotate_left(first);
        events.iter_mut().for_each(|event| event.time -= begin);
    }
    let object = |event: &Event| EventObject { error: None, ..EventObject::of_oscillator(osc, event, units) };
    events.iter().map(object).collect()
}

/// A state from which a motion can be started.
#[derive(JsonSchema, Serialize)]
pub struct StateObject<'a> {
    q: Cow<'a, [f64]>,
    qdot: Cow<'a, [f64]>,
    phase: f64,
    #[serde(skip_serializing_if = "Map::is_empty")]
    contacts: Map<String, Value>,
    #[serde(skip_serializing_if = "Map::is_empty")]
    exact: Map<String, Value>,
}

impl<'a> StateObject<'a> {
    pub(crate) fn of(machine: &Machine, start: &'a events::Start) -> Self {
        let events::Start { q, qdot, phase, .. } = start;
        let (contacts, exact) = (contacts(machine, start), exact(start));
        Self { q: q.into(), qdot: qdot.into(), phase: *phase, contacts, exact }
    }

    /// A state of an oscillator, in these units.
    pub(crate) fn of_oscillator(start: &Start, units: &Units) -> StateObject<'static> {
        let (q, qdot) = (vec![start.x * units.length()], vec![start.v * units.velocity()]);
        StateObject { q: q.into(), qdot: qdot.into(), phase: start.phase, contacts: Map::new(), exact: Map::new() }
    }

    /// The state in the middle of the longest flight of a cycle of an oscillator.
    pub(crate) fn within(osc: &Oscillator, cycle: &Cycle, units: &Units) -> Option<StateObject<'static>> {
        let flights = cycle_segments(osc, cycle)?.into_iter().filter_map(|segment| match segment {
            Segment::Flight { flight, duration } => Some((flight, duration)),
            _ => None,
        });
        let (flight, duration) = flights.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let ((x, v), phase) = (flight.state(0.5 * duration), flight.phase_at(0.5 * duration));
        Some(Self::of_oscillator(&Start { x, v, phase }, units))
    }
}

fn contacts(machine: &Machine, start: &events::Start) -> Map<String, Value> {
    let contact = |contact: &events::ContactStart| {
        let mut object = Map::new();
        object.insert("state".to_owned(), contact_word(contact.state).into());
        if contact.surface > 0.0 {
            object.insert("surface".to_owned(), contact.surface.into());
        }
        (machine.name_of(contact.place).to_owned(), Value::from(object))
    };
    start.contacts.iter().map(contact).collect()
}

/// The digits that the other numbers of a state leave out, by name.
pub(crate) fn exact(start: &events::Start) -> Map<String, Value> {
    start.exact.iter().map(|(name, values)| (name.clone(), values.clone().into())).collect()
}

/// An event that is written while it is computed.
pub(crate) struct EventOf<'a>(pub(crate) &'a Machine, pub(crate) events::Event);

impl Serialize for EventOf<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        of_machine(self.0, &self.1).serialize(serializer)
    }
}

/// An event of a machine.
#[must_use]
pub fn of_machine<'a>(machine: &'a Machine, event: &'a events::Event) -> EventObject<'a> {
    // an event of a joint has no speed, but a direction
    let slips = event.kind == events::EventKind::Slip;
    EventObject {
        kind: event.kind.name(),
        stop: machine.name_of(event.place),
        time: event.time,
        phase: machine.parts().frequency.is_some().then_some(event.phase),
        speed: if slips { 0.0 } else { event.speed },
        direction: slips.then_some(event.speed),
        q: (&event.q).into(),
        qdot: (&event.qdot).into(),
        with: event.with.iter().map(|place| machine.name_of(*place)).collect(),
        tie: event.tie,
        contacts: event.state.as_ref().map(|state| contacts(machine, state)),
        exact: event.state.as_ref().map(|state| exact(state)),
        ..EventObject::default()
    }
}
