//! The events of a motion, and the reason why the list ends.

use super::Document;
use super::motion::{HorizonObject, side};
use crate::{Asked, Units};
use serde::{Serialize, Serializer};
use vibroimpact::motion::{Event, EventKind};
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{Plan, Simulated};

/// The fields of `vibro simulate`. Events are converted while they are written.
#[derive(Serialize)]
struct Simulation<'a> {
    #[serde(serialize_with = "each_event")]
    events: (&'a [Event], Units),
    end: EndPoint,
}

#[derive(Serialize)]
struct EndPoint {
    reason: &'static str,
    time: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    horizon: Option<HorizonObject>,
}

/// The object of `vibro simulate`.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    (osc, start): (&Oscillator, &Start),
    followed: &'a Simulated,
) -> impl Serialize + use<'a> {
    let horizon = followed.horizon.as_ref().map(HorizonObject::new);
    let end = EndPoint { reason: followed.reason, time: followed.time * asked.units.time(), horizon };
    let answer = Simulation { events: (&followed.events, asked.units), end };
    Document::new(asked, osc, plan, answer).start(start, &asked.units)
}

fn each_event<S: Serializer>((events, units): &(&[Event], Units), serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(events.iter().map(|event| EventObject::new(event, units)))
}

/// An event of a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EventObject {
    kind: &'static str,
    time: f64,
    phase: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity_before: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity_after: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    depth: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    chatter: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<f64>,
    side: &'static str,
}

impl EventObject {
    /// `impact`, `graze`, `stick` or `release`.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        self.kind
    }

    /// An event in these units.
    #[must_use]
    pub(crate) fn new(event: &Event, units: &Units) -> Self {
        let bare = Self {
            kind: "release",
            time: event.time * units.time(),
            phase: event.phase,
            velocity_before: None,
            velocity_after: None,
            depth: None,
            chatter: None,
            error: None,
            side: side(event.side),
        };
        match event.kind {
            EventKind::Impact { velocity_before, velocity_after } => Self {
                kind: "impact",
                velocity_before: Some(velocity_before * units.velocity()),
                velocity_after: Some(velocity_after * units.velocity()),
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
