//! Branches of periodic orbits of any system: their points, their events, and the events at which further branches begin.

use super::Pair;
use super::event::{EventObject, side};
use super::motion::multipliers;
use crate::Varied;
use crate::solutions::{BranchRows, BranchesView, Event, OriginView, PointView};
use core::iter::once;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use vibroimpact::continuation::machine;
use vibroimpact_study::{EventRecord, OrbitNumber};

/// The answer to `vibro branch`.
#[derive(JsonSchema, Serialize)]
pub(super) struct BranchAnswer<'a> {
    /// The label of the orbit at which the first branch begins.
    label: String,
    vary: String,
    from: f64,
    to: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Pair>,
    /// Absent for the motion from the start of a machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    orbit: Option<ChosenObject>,
    branches: Vec<BranchObject<'a>>,
}

/// The orbit at which the branch begins.
#[derive(JsonSchema, Serialize)]
pub(super) struct ChosenObject {
    number: u32,
    count: u32,
}

impl From<OrbitNumber> for ChosenObject {
    fn from(OrbitNumber { number, count }: OrbitNumber) -> Self {
        Self { number, count }
    }
}

/// A branch.
#[derive(JsonSchema, Serialize)]
struct BranchObject<'a> {
    /// The event at which it begins; null for that of the orbit that was asked for.
    from: Option<OriginObject>,
    points: Vec<PointObject<'a>>,
    events: Vec<BranchEventObject<'a>>,
    /// The event with which it ends.
    end: Option<&'static str>,
}

#[derive(JsonSchema, Serialize)]
struct OriginObject {
    kind: &'static str,
    parameter: f64,
    /// Number of the branch of that event, counted from 1; the branch of the chosen orbit is number 1.
    branch: usize,
}

#[derive(JsonSchema, Serialize)]
struct PointObject<'a> {
    parameter: f64,
    /// Values of both parameters, on a line through two.
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<[f64; 2]>,
    label: String,
    /// The time of one period.
    period: f64,
    cycle: Vec<EventObject<'a>>,
    multipliers: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drift: Option<Map<String, Value>>,
    /// The quantity that the figure shows, of a machine without stops.
    #[serde(skip_serializing_if = "Option::is_none")]
    quantities: Option<Map<String, Value>>,
    stable: bool,
    stability: &'static str,
    admissible: bool,
}

#[derive(JsonSchema, Serialize)]
struct BranchEventObject<'a> {
    kind: &'static str,
    parameter: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<[f64; 2]>,
    /// Index among the points.
    point: usize,
    #[serde(flatten)]
    fields: EventFields<'a>,
}

/// The fields of an event that do not depend on the branch.
#[derive(Default, JsonSchema, Serialize)]
pub(crate) struct EventFields<'a> {
    ends: bool,
    /// The labels on both sides; null where the branch ends.
    pub(crate) before: String,
    pub(crate) after: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'a str>,
    /// Of a grazing contact, whether an impact appears beyond it or disappears.
    #[serde(skip_serializing_if = "Option::is_none")]
    appears: Option<bool>,
    /// Whether the parameter turns back.
    #[serde(skip_serializing_if = "Option::is_none")]
    turns: Option<bool>,
    /// Number of the impact of an oscillator, counted from 1, and the phase of the contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    impact: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    phase: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<TouchObject>,
}

/// A contact that is simultaneous with that of the event.
#[derive(JsonSchema, Serialize)]
struct TouchObject {
    #[serde(skip_serializing_if = "Option::is_none")]
    impact: Option<usize>,
    stop: &'static str,
    phase: f64,
}

impl<'a> BranchAnswer<'a> {
    pub(super) fn new<V: Varied>(view: &BranchesView<'a, V>) -> Self {
        let (cut, units) = (&view.cut, &view.units);
        let unit = cut.vary.unit(units);
        Self {
            label: view.label.to_string(),
            vary: cut.vary.field(units).to_owned(),
            from: cut.ends.0 * unit,
            to: cut.ends.1 * unit,
            also: Pair::of(cut, units),
            orbit: view.number.map(Into::into),
            branches: view.branches.iter().map(|branch| BranchObject::new(branch, view)).collect(),
        }
    }
}

impl<'a> BranchObject<'a> {
    fn new<V: Varied>(branch: &BranchRows<'a>, view: &BranchesView<'a, V>) -> Self {
        let points = &branch.points;
        let event = |(k, point): (usize, &PointView<'a>)| Some(BranchEventObject::new(k, point, point.event.as_ref()?));
        Self {
            from: branch.origin.map(|OriginView { branch, kind, value }| OriginObject {
                kind,
                parameter: value,
                branch,
            }),
            points: points.iter().map(|point| PointObject::new(point, view)).collect(),
            events: points.iter().enumerate().filter_map(event).collect(),
            end: points.last().and_then(|point| point.event.as_ref()).map(Event::name),
        }
    }
}

impl<'a> PointObject<'a> {
    fn new<V: Varied>(point: &PointView<'a>, view: &BranchesView<'a, V>) -> Self {
        let cycle = &point.cycle;
        Self {
            parameter: point.values[0],
            values: both(point),
            label: cycle.label().to_string(),
            period: cycle.period(),
            cycle: cycle.events(),
            multipliers: multipliers(cycle.multipliers()),
            drift: cycle.drift_by_name(|cycle| cycle.drift.clone()),
            quantities: view.quantity.as_ref().map(|of| once((of.path.clone(), of.at(point).into())).collect()),
            stable: point.stable(),
            stability: cycle.stability().name(),
            admissible: point.admissible,
        }
    }
}

/// The values of both parameters at a point of a line through two.
fn both(point: &PointView<'_>) -> Option<[f64; 2]> {
    point.values.as_slice().try_into().ok()
}

impl<'a> BranchEventObject<'a> {
    fn new(place: usize, point: &PointView<'a>, event: &Event<'a>) -> Self {
        Self {
            kind: event.name(),
            parameter: point.values[0],
            values: both(point),
            point: place,
            fields: EventFields::new(event),
        }
    }
}

impl<'a> EventFields<'a> {
    /// Those of an event of any system.
    pub(crate) fn new(event: &Event<'a>) -> Self {
        let ends = event.ends();
        match event {
            Event::Oscillator { point, event } => EventFields::of_record(EventRecord::of(point, event)),
            Event::Machine { event: kind, labels: (before, after), .. } => Self {
                ends,
                before: before.to_string(),
                after: after.clone().filter(|_| !ends),
                stop: event.stop(),
                ..Self::of_grazing(*kind)
            },
        }
    }

    /// What only a grazing contact has.
    fn of_grazing(event: machine::BranchEvent) -> Self {
        let machine::BranchEvent::Grazing { appears, turns, .. } = event else { return Self::default() };
        Self { appears: Some(appears), turns: Some(turns), ..Self::default() }
    }
}

impl EventFields<'static> {
    fn of_record(record: EventRecord) -> Self {
        let EventRecord { ends, label_before, label_after, change, impact, side: at, phase, turns, also, .. } = record;
        Self {
            ends,
            before: label_before,
            after: label_after,
            stop: at.map(side),
            appears: change.map(|change| change == "appears"),
            turns,
            impact,
            phase,
            also: also.map(|(impact, at, phase)| TouchObject { impact, stop: side(at), phase }),
        }
    }
}
