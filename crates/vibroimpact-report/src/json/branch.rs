//! Branches of periodic orbits of any system: their points, their events, and the events at which further branches begin.

use super::Pair;
use super::event::{self, EventObject, Stops as _};
use super::motion::{drift, multipliers};
use crate::answer::{AnswerOf, BranchesOf, Told};
use crate::branch_quantity::BranchQuantity;
use crate::scene::strobes;
use crate::{Asked, Units, Varied};
use core::iter::once;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use vibroimpact::Label;
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{BranchEvent, SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Stability, System as _};
use vibroimpact_study::diagram::{Show, ShowText};
use vibroimpact_study::{Chosen, Cut, Dynamics, Followed, OrbitNumber, Origin, PointOf, Solution as _};

/// The mark of the point from which a branch was followed both ways.
pub(crate) const START: &str = "start";

/// The answer to `vibro branch`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct BranchAnswer<'a> {
    /// The label of the orbit at which the first branch begins.
    pub label: String,
    /// The number that varies.
    vary: String,
    /// The value at which the branch begins.
    from: f64,
    /// The other end of its range.
    to: f64,
    /// The number that varies with it along a line, and its values at the ends of the range.
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Pair>,
    /// The number of the orbit at which it begins, and how many there are; absent for the motion from the start of a
    /// machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orbit: Option<ChosenObject>,
    /// The branches; that of the orbit comes first.
    pub branches: Vec<BranchObject<'a>>,
    /// The stability of the orbit; none of a solution that is not admissible.
    #[serde(skip)]
    pub stability: Option<Stability>,
    /// Events at which a further branch was expected but could not be followed.
    #[serde(skip)]
    pub lost: Vec<OriginObject>,
    /// The path of the quantity that stands for each cycle of a machine without stops.
    #[serde(skip)]
    pub(crate) quantity: Option<String>,
}

/// The orbit at which the branch begins.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub(crate) struct ChosenObject {
    /// Its number, counted from 1.
    pub number: u32,
    /// How many orbits with its label there are.
    pub count: u32,
}

impl ChosenObject {
    pub(crate) fn new<C>(chosen: &Chosen<C>) -> Option<Self> {
        chosen.among.map(|OrbitNumber { number, count }| Self { number, count })
    }
}

/// A branch.
#[derive(JsonSchema, Serialize)]
pub(crate) struct BranchObject<'a> {
    /// The event at which it begins; null for that of the orbit that was asked for.
    pub from: Option<OriginObject>,
    /// The index of the point at which it was followed both ways; absent if that is the first point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<usize>,
    /// Its points.
    pub points: Vec<PointObject<'a>>,
    /// Its events, in order of the points. `before`, `after` and `appears` are meant on the way from the start.
    pub events: Vec<BranchEventObject<'a>>,
    /// The event with which it ends at its first point, if it was followed both ways.
    #[serde(skip_serializing_if = "Option::is_none")]
    begin: Option<&'static str>,
    /// The event with which it ends at its last point.
    end: Option<&'static str>,
}

/// The event at which a branch begins.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub(crate) struct OriginObject {
    /// Its kind.
    pub kind: &'static str,
    /// The value of the parameter.
    pub parameter: f64,
    /// Number of the branch of that event, counted from 1; the branch of the chosen orbit is number 1.
    pub branch: usize,
}

/// A point of a branch.
#[derive(Default, JsonSchema, Serialize)]
pub struct PointObject<'a> {
    /// The value of the parameter.
    pub parameter: f64,
    /// Values of both parameters, on a line through two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) values: Option<[f64; 2]>,
    /// The label m/n, or m/T without forcing; at an event of the cycle before it, on the way from the start.
    pub label: String,
    /// The time of one period.
    pub period: f64,
    /// The events of one period.
    pub(crate) cycle: Vec<EventObject<'a>>,
    /// Floquet multipliers, without the 1 of each free translation; null at a grazing impact, where they are infinite.
    pub(crate) multipliers: Vec<[f64; 2]>,
    /// By how much each coordinate moves on in one period, in machines that can be translated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) drift: Option<Map<String, Value>>,
    /// The quantity that the figure shows, of a machine without stops.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) quantities: Option<Map<String, Value>>,
    /// Whether it is stable.
    pub(crate) stable: bool,
    /// `stable`, `neutral` (a multiplier on the unit circle to rounding and none outside) or `unstable`.
    pub stability: &'static str,
    /// Whether it is admissible.
    pub admissible: bool,
    /// Velocity and position of an oscillator at phase 0 of the force in each of its periods, where they are shown.
    #[serde(skip)]
    pub(crate) strobes: Vec<(f64, f64)>,
}

/// An event of a branch.
#[derive(JsonSchema, Serialize)]
pub(crate) struct BranchEventObject<'a> {
    /// Its kind.
    pub kind: &'static str,
    /// The value of the parameter.
    pub parameter: f64,
    /// The values of both numbers, on a line through two.
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<[f64; 2]>,
    /// Index among the points.
    pub point: usize,
    /// What does not depend on the branch.
    #[serde(flatten)]
    pub fields: EventFields<'a>,
    /// The event itself.
    #[serde(skip)]
    pub event: BranchEvent,
    /// What it happens to.
    #[serde(skip)]
    pub of: EventOf<'a>,
}

/// What an event of a branch happens to.
#[derive(Clone, Copy, Debug)]
pub enum EventOf<'a> {
    /// An oscillator, at a point of its branch.
    Oscillator(&'a SolutionPoint),
    /// A machine.
    Machine(&'a Machine),
}

/// The fields of an event that do not depend on the branch.
#[derive(Default, JsonSchema, Serialize)]
pub(crate) struct EventFields<'a> {
    /// Whether the branch ends there.
    pub ends: bool,
    /// The label before it.
    pub before: String,
    /// The label after it; null where the branch ends.
    pub after: Option<String>,
    /// The stop, or joint, of the event.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) stop: Option<&'a str>,
    /// Of a grazing contact, on the way from the start: whether an impact appears beyond it or disappears.
    #[serde(skip_serializing_if = "Option::is_none")]
    appears: Option<bool>,
    /// Whether the parameter turns back.
    #[serde(skip_serializing_if = "Option::is_none")]
    turns: Option<bool>,
    /// The number of the impact of a grazing contact of an oscillator, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    impact: Option<usize>,
    /// The phase of this contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    phase: Option<f64>,
    /// For two equal stops, the contact with the other one that appears or disappears at the same value; of a corner, the stop
    /// or joint of the second event.
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<TouchObject<'a>>,
}

/// A contact that is simultaneous with that of the event.
#[derive(JsonSchema, Serialize)]
struct TouchObject<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    impact: Option<usize>,
    stop: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    phase: Option<f64>,
}

/// The systems of a branch: as they are written, that of the start, and the units of the results.
pub(crate) type Along<'a, D> = (&'a D, &'a <D as Dynamics>::System, &'a Units);

impl<'a> BranchAnswer<'a> {
    /// The branches along a line, with the quantity `show` at each point.
    pub(crate) fn new<D: Told>(
        of: &'a AnswerOf<D>,
        found: &'a BranchesOf<D>,
        cut: &Cut<D::Name>,
        show: Option<&D::Shown>,
    ) -> Self {
        let units = &of.units;
        let along = (&of.written, &of.system, units);
        let branch = |points, start| BranchObject::new::<D>(along, (points, start), cut, show);
        let unit = cut.vary.unit(units);
        let origin = |origin: &'a Origin<PointOf<D>>| {
            let point = branch(core::slice::from_ref(&origin.point), None);
            let (kind, parameter) = point.events.first().map_or(("event", f64::NAN), |at| (at.kind, at.parameter));
            OriginObject { kind, parameter, branch: origin.branch + 1 }
        };
        let whole = |of: &'a Followed<PointOf<D>>| BranchObject {
            from: of.origin.as_ref().map(origin),
            ..branch(&of.points, of.start)
        };
        let path = |show: D::Shown| if let ShowText::Word(path) = show.into() { Some(path) } else { None };
        Self {
            label: D::System::label(&found.chosen.cycle).to_string(),
            vary: cut.vary.field(units).to_owned(),
            from: cut.ends.0 * unit,
            to: cut.ends.1 * unit,
            also: Pair::of(cut, units),
            orbit: ChosenObject::new(&found.chosen),
            branches: found.followed.iter().map(whole).collect(),
            stability: found.chosen.stability,
            lost: found.lost.iter().map(origin).collect(),
            quantity: show.cloned().and_then(path),
        }
    }
}

impl<'a> BranchObject<'a> {
    /// A branch with these points and this start, and with what a diagram shows of each cycle.
    pub(crate) fn new<D: Told>(
        along: Along<'a, D>,
        (solutions, start): (&'a [PointOf<D>], Option<usize>),
        cut: &Cut<D::Name>,
        show: Option<&D::Shown>,
    ) -> Self {
        let objects = solutions.iter().map(|point| D::branch_point(along, point, cut, show));
        let (points, of): (Vec<_>, Vec<_>) = objects.unzip();
        let event = |(k, at): (usize, &'a PointOf<D>)| {
            let event = at.event()?;
            // a point at an event has the cycle before it
            let next = if k < start.unwrap_or(0) { k.checked_sub(1) } else { Some(k + 1) };
            let after = at.label_after(|| Some(solutions.get(next?)?.label()));
            let fields = EventFields::of(event, (at.label(), after), &|place| along.1.name_of_stop(place));
            let PointObject { parameter, values, .. } = points[k];
            Some(BranchEventObject { kind: event.name(), parameter, values, point: k, fields, event, of: of[k] })
        };
        let events: Vec<_> = solutions.iter().enumerate().filter_map(event).collect();
        let begin = events.first().filter(|event| event.point == 0 && start.is_some()).map(|event| event.kind);
        let end = events.last().filter(|event| event.point + 1 == points.len()).map(|event| event.kind);
        Self { from: None, start, points, events, begin, end }
    }

    /// The points of each side on the way from the start, which is the first of both: one side, or two if it was followed both ways.
    pub(crate) fn sides(&self) -> Vec<Vec<usize>> {
        let back = self.start.map(|start| (0..=start).rev().collect());
        back.into_iter().chain([(self.start.unwrap_or(0)..self.points.len()).collect()]).collect()
    }

    /// The event at a point.
    pub(crate) fn event_at(&self, point: usize) -> Option<&BranchEventObject<'a>> {
        let place = self.events.binary_search_by_key(&point, |event| event.point).ok()?;
        Some(&self.events[place])
    }

    /// What a table says of a point: the event and its stop, or that the branch was followed both ways from here.
    pub(crate) fn mark_at(&self, point: usize) -> (&'static str, &str) {
        match self.event_at(point) {
            Some(event) => (event.kind, event.fields.stop.unwrap_or_default()),
            None if self.start == Some(point) => (START, ""),
            None => ("", ""),
        }
    }
}

impl PointObject<'_> {
    /// The quantity of a machine without stops.
    pub(crate) fn quantity(&self) -> f64 {
        self.quantities.iter().flat_map(Map::values).find_map(Value::as_f64).unwrap_or(f64::NAN)
    }

    /// The values of all numbers that vary.
    pub(crate) fn values(&self) -> &[f64] {
        self.values.as_ref().map_or(core::slice::from_ref(&self.parameter), <[f64; 2]>::as_slice)
    }
}

impl PointObject<'static> {
    pub(crate) fn of_oscillator(point: &SolutionPoint, cut: &Cut, asked: &Asked, show: Option<&Show>) -> Self {
        let (cycle, units) = (&point.cycle, &asked.units);
        let there = units.at(cut.vary, point.value);
        let osc = cut.oscillator(&asked.system, point.value).ok();
        let period = osc.map_or(f64::NAN, |osc| f64::from(cycle.label.periods) * osc.period() * there.time());
        Self {
            parameter: point.value * units.of(cut.vary),
            values: both(point.value, cut, units),
            label: cycle.label.to_string(),
            period,
            cycle: osc.map_or_else(Vec::new, |osc| event::of_cycle(&osc, cycle, &there)),
            multipliers: multipliers(&cycle.multipliers),
            stable: point.stable(),
            stability: point.stability().name(),
            admissible: point.physical,
            strobes: if show == Some(&Show::Strobe) { strobes(point, cut, asked) } else { Vec::new() },
            ..Self::default()
        }
    }
}

impl<'a> PointObject<'a> {
    pub(crate) fn of_machine(
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
            ..Self::default()
        }
    }
}

/// The values of both parameters at a point of a line through two.
fn both<V: Varied>(value: f64, cut: &Cut<V>, units: &Units) -> Option<[f64; 2]> {
    let mut values = cut.names().zip(cut.values(value)).map(|(number, value)| value * number.unit(units));
    Some([values.next()?, values.next()?])
}

impl<'a> EventFields<'a> {
    /// Those of an event, from the labels before and after it and the names of stops and joints.
    pub(crate) fn of(
        event: BranchEvent,
        (before, after): (Label, Option<Label>),
        name: &dyn Fn(usize) -> &'a str,
    ) -> Self {
        let (appears, turns) = match event {
            BranchEvent::Grazing { appears, turns, .. } => (Some(appears), Some(turns)),
            _ => (None, None),
        };
        let (number, detail) = (|impact: usize| impact + 1, event.detail());
        let touch = |place: usize| {
            let (impact, phase) = detail.and_then(|detail| detail.also).unzip();
            TouchObject { impact: impact.flatten().map(number), stop: name(place), phase }
        };
        Self {
            ends: event.ends(),
            before: detail.map_or(before, |detail| detail.labels.0).to_string(),
            after: after.map(|after| after.to_string()),
            stop: event.place().map(name),
            appears,
            turns,
            impact: detail.and_then(|detail| detail.impact).map(number),
            phase: detail.map(|detail| detail.phase),
            also: event.also().map(touch),
        }
    }
}
