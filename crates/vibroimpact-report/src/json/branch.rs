//! Branches of periodic orbits of any system: their points, their events, and the events at which further branches begin.

use super::event::{self, EventObject, side};
use super::motion::{drift, multipliers};
use super::{Document, Pair};
use crate::branch_quantity::BranchQuantity;
use crate::{Asked, Units, Varied};
use core::iter::once;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use vibroimpact::Label;
use vibroimpact::Oscillator;
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{BranchEvent, SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{Branches, Chosen, Cut, EventRecord, Followed, OrbitNumber, Plan, Solution, SystemPlan};

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

impl ChosenObject {
    pub(super) fn new<C>(chosen: &Chosen<C>) -> Option<Self> {
        chosen.among.map(|OrbitNumber { number, count }| Self { number, count })
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

/// The object of `vibro branch`, for branches along this line.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &'a Oscillator,
    found: &'a Branches,
    cut: &Cut,
) -> impl Serialize + use<'a> {
    Document::new(asked, osc, plan, BranchAnswer::of_oscillator(found, cut, asked))
}

impl<'a> BranchAnswer<'a> {
    /// The branches of an orbit with this label along a line. `object` returns the branch with these points, and `event` what is at
    /// the event at a point.
    fn new<C, P, V: Varied>(
        (found, label): (&'a Branches<C, P>, Label),
        (cut, units): (&Cut<V>, &Units),
        object: impl Fn(&'a [P]) -> BranchObject<'a>,
        event: impl Fn(&P) -> (&'static str, f64),
    ) -> Self {
        let unit = cut.vary.unit(units);
        let branch = |branch: &'a Followed<P>| {
            let from = branch.origin.as_ref().map(|origin| {
                let (kind, value) = event(&origin.point);
                OriginObject { kind, parameter: value * unit, branch: origin.branch + 1 }
            });
            BranchObject { from, ..object(&branch.points) }
        };
        Self {
            label: label.to_string(),
            vary: cut.vary.field(units).to_owned(),
            from: cut.ends.0 * unit,
            to: cut.ends.1 * unit,
            also: Pair::of(cut, units),
            orbit: ChosenObject::new(&found.chosen),
            branches: found.followed.iter().map(branch).collect(),
        }
    }

    fn of_oscillator(found: &'a Branches, cut: &Cut, Asked { system, units }: &Asked) -> Self {
        let name = |point: &SolutionPoint| point.event.map_or("", |event| event.name());
        let object = |points: &'a [SolutionPoint]| BranchObject {
            from: None,
            points: points.iter().map(|point| PointObject::of_oscillator(point, cut, system, units)).collect(),
            events: (points.iter().enumerate())
                .filter_map(|(k, point)| Some(BranchEventObject::of_oscillator(k, point, &point.event?, (cut, units))))
                .collect(),
            end: points.last().and_then(|point| point.event).map(|event| event.name()),
        };
        let label = found.chosen.cycle.label;
        Self::new((found, label), (cut, units), object, |point| (name(point), point.value))
    }

    /// Those of a machine, for branches along this line.
    pub(super) fn of_machine(
        (machine, source): (&'a Machine, &MachineSource),
        cut: &Cut<String>,
        found: &'a Branches<Cycle, machine::SolutionPoint>,
    ) -> Self {
        let quantity = BranchQuantity::of(machine, source, cut, found);
        let name = |point: &machine::SolutionPoint| point.event.map_or("", |event| event.name());
        let object = |points: &'a [machine::SolutionPoint]| BranchObject {
            from: None,
            points: (points.iter())
                .map(|point| PointObject::of_machine(point, machine, cut, quantity.as_ref()))
                .collect(),
            events: (0..points.len())
                .filter_map(|k| Some(BranchEventObject::of_machine(k, points, points[k].event?, (machine, cut))))
                .collect(),
            end: points.last().and_then(|point| point.event).map(|event| event.name()),
        };
        let (label, units) = (found.chosen.cycle.label, Units::default());
        Self::new((found, label), (cut, &units), object, |point| (name(point), point.value))
    }
}

impl PointObject<'static> {
    fn of_oscillator(point: &SolutionPoint, cut: &Cut, system: &SystemPlan, units: &Units) -> Self {
        let (cycle, there) = (&point.cycle, units.at(cut.vary, point.value));
        let osc = cut.oscillator(system, point.value).ok();
        let period = osc.map_or(f64::NAN, |osc| f64::from(cycle.label.periods) * osc.period() * there.time());
        Self {
            parameter: point.value * units.of(cut.vary),
            values: both(point.value, cut, units),
            label: cycle.label.to_string(),
            period,
            cycle: osc.map_or_else(Vec::new, |osc| event::of_cycle(&osc, cycle, &there)),
            multipliers: multipliers(&cycle.multipliers),
            drift: None,
            quantities: None,
            stable: point.stable(),
            stability: point.stability().name(),
            admissible: point.physical,
        }
    }
}

impl<'a> PointObject<'a> {
    fn of_machine(
        point: &'a machine::SolutionPoint,
        machine: &'a Machine,
        cut: &Cut<String>,
        quantity: Option<&BranchQuantity<'_>>,
    ) -> Self {
        let machine::SolutionPoint { value, cycle, .. } = point;
        Self {
            parameter: *value,
            values: both(*value, cut, &Units::default()),
            label: cycle.label.to_string(),
            period: cycle.period,
            cycle: cycle.events.iter().map(|event| event::of_machine(machine, event)).collect(),
            multipliers: multipliers(&cycle.multipliers),
            drift: drift(machine, cycle),
            quantities: quantity.map(|quantity| once((quantity.path.clone(), quantity.at(point).into())).collect()),
            stable: cycle.stable(),
            stability: cycle.stability().name(),
            // a branch of a machine ends where its orbit ceases to be admissible
            admissible: true,
        }
    }
}

/// The values of both parameters at a point of a line through two.
fn both<V: Varied>(value: f64, cut: &Cut<V>, units: &Units) -> Option<[f64; 2]> {
    let mut values = cut.names().zip(cut.values(value)).map(|(number, value)| value * number.unit(units));
    Some([values.next()?, values.next()?])
}

impl BranchEventObject<'static> {
    fn of_oscillator(place: usize, point: &SolutionPoint, event: &BranchEvent, (cut, units): (&Cut, &Units)) -> Self {
        let record = EventRecord::of(point, event);
        Self {
            kind: record.kind,
            parameter: point.value * units.of(cut.vary),
            values: both(point.value, cut, units),
            point: place,
            fields: EventFields::of_oscillator(record),
        }
    }
}

impl<'a> BranchEventObject<'a> {
    fn of_machine(
        k: usize,
        points: &[machine::SolutionPoint],
        event: machine::BranchEvent,
        (machine, cut): (&'a Machine, &Cut<String>),
    ) -> Self {
        Self {
            kind: event.name(),
            parameter: points[k].value,
            values: both(points[k].value, cut, &Units::default()),
            point: k,
            // a point at an event has the cycle before it
            fields: EventFields::of_machine(
                event,
                (points[k].cycle.label, points.get(k + 1).map(|next| next.cycle.label.to_string())),
                machine,
            ),
        }
    }
}

/// A point of a branch, whose event is told.
pub(crate) trait EventPoint: Solution {
    /// What is told of the event besides its name; `after` is the label beyond it.
    fn fields<'a>(&self, after: Option<String>, system: &'a Self::System) -> EventFields<'a>;
}

impl EventPoint for SolutionPoint {
    fn fields<'a>(&self, _: Option<String>, _: &'a Oscillator) -> EventFields<'a> {
        self.event.map(|event| EventFields::of_oscillator(EventRecord::of(self, &event))).unwrap_or_default()
    }
}

impl EventPoint for machine::SolutionPoint {
    fn fields<'a>(&self, after: Option<String>, machine: &'a Machine) -> EventFields<'a> {
        let of = |event| EventFields::of_machine(event, (self.cycle.label, after), machine);
        self.event.map(of).unwrap_or_default()
    }
}

impl<'a> EventFields<'a> {
    /// Those of an event of a machine, from the labels before and after it.
    pub(super) fn of_machine(
        event: machine::BranchEvent,
        (before, after): (Label, Option<String>),
        machine: &'a Machine,
    ) -> Self {
        let (appears, turns) = match event {
            machine::BranchEvent::Grazing { appears, turns, .. } => (Some(appears), Some(turns)),
            _ => (None, None),
        };
        Self {
            ends: event.ends(),
            before: before.to_string(),
            after: after.filter(|_| !event.ends()),
            stop: event.place().map(|place| machine.name_of(place)),
            appears,
            turns,
            ..Self::default()
        }
    }
}

impl EventFields<'static> {
    pub(super) fn of_oscillator(record: EventRecord) -> Self {
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
