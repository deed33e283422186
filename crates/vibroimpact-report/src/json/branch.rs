//! Branches of periodic orbits: their points, their events, and the events at which further branches begin.

use super::motion::{CyclePoint, Rest, impacts, pairs, rests, side};
use super::{Document, Pair};
use crate::{Asked, Units};
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::continuation::{BranchEvent, SolutionPoint};
use vibroimpact_study::{Branches, Chosen, Cut, EventRecord, Followed, Plan};

/// The fields of `vibro branch`.
#[derive(Serialize)]
struct BranchFields {
    label: String,
    vary: &'static str,
    from: f64,
    to: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Pair>,
    orbit: ChosenObject,
    points: Vec<PointObject>,
    events: Vec<EventObject>,
    branches: Vec<BranchObject>,
}

/// The orbit at which the branch begins.
#[derive(Serialize)]
pub(super) struct ChosenObject {
    number: u32,
    count: u32,
}

#[derive(Serialize)]
struct PointObject {
    parameter: f64,
    /// Values of both parameters, on a line through two.
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<[f64; 2]>,
    label: String,
    cycle: Vec<CyclePoint>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rests: Vec<Rest>,
    multipliers: [[f64; 2]; 2],
    stable: bool,
    stability: &'static str,
    physical: bool,
}

#[derive(Serialize)]
struct EventObject {
    kind: &'static str,
    parameter: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<[f64; 2]>,
    /// Index among the points.
    point: usize,
    #[serde(flatten)]
    fields: EventFields,
}

/// The fields of an event that do not depend on the branch.
#[derive(Serialize)]
pub(super) struct EventFields {
    ends: bool,
    label_before: String,
    label_after: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    change: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    impact: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    phase: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turns: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<TouchObject>,
}

/// A contact that is simultaneous with that of the event.
#[derive(Serialize)]
struct TouchObject {
    #[serde(skip_serializing_if = "Option::is_none")]
    impact: Option<usize>,
    side: &'static str,
    phase: f64,
}

/// A further branch.
#[derive(Serialize)]
struct BranchObject {
    from: OriginObject,
    points: Vec<PointObject>,
    events: Vec<EventObject>,
}

/// The event at which it begins.
#[derive(Serialize)]
struct OriginObject {
    kind: &'static str,
    parameter: f64,
    /// Number of the branch of that event, counted from 1; the branch of the chosen orbit is number 1.
    branch: usize,
}

/// The object of `vibro branch`, for branches along this line.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &Oscillator,
    found: &Branches,
    cut: &Cut,
) -> impl Serialize + use<'a> {
    Document::new(asked, osc, plan, BranchFields::new(found, cut, &asked.units))
}

impl ChosenObject {
    pub(super) const fn new(chosen: &Chosen) -> Self {
        Self { number: chosen.number, count: chosen.count }
    }

    /// That of a machine, from its number and how many there are.
    pub(super) fn of_machine(among: Option<(u32, u32)>) -> Option<Self> {
        among.map(|(number, count)| Self { number, count })
    }
}

impl BranchFields {
    fn new(found: &Branches, cut: &Cut, units: &Units) -> Self {
        let unit = units.of(cut.vary);
        let points =
            |branch: &Followed| branch.points.iter().map(|point| PointObject::new(point, cut, units)).collect();
        let mut rest = found.followed.iter();
        let first = rest.next();
        Self {
            label: found.chosen.orbit.cycle.label.to_string(),
            vary: units.name_of(cut.vary),
            from: cut.ends.0 * unit,
            to: cut.ends.1 * unit,
            also: Pair::of(cut, units),
            orbit: ChosenObject::new(&found.chosen),
            points: first.map_or_else(Vec::new, points),
            events: first.map_or_else(Vec::new, |branch| events(branch, cut, units)),
            branches: rest
                .filter_map(|branch| {
                    let origin = branch.origin.as_ref()?;
                    let from = OriginObject {
                        kind: origin.point.event.map_or("", |event| event.name()),
                        parameter: origin.point.value * unit,
                        branch: origin.branch + 1,
                    };
                    Some(BranchObject { from, points: points(branch), events: events(branch, cut, units) })
                })
                .collect(),
        }
    }
}

impl PointObject {
    fn new(point: &SolutionPoint, cut: &Cut, units: &Units) -> Self {
        Self {
            parameter: point.value * units.of(cut.vary),
            values: both(point, cut, units),
            label: point.cycle.label.to_string(),
            cycle: impacts(&point.cycle, &units.at(cut.vary, point.value)),
            rests: rests(&point.cycle),
            multipliers: pairs(point.cycle.multipliers),
            stable: point.stable(),
            stability: point.stability().name(),
            physical: point.physical,
        }
    }
}

/// The values of both parameters at a point of a line through two.
fn both(point: &SolutionPoint, cut: &Cut, units: &Units) -> Option<[f64; 2]> {
    let mut values = cut.values(point.value).map(|(parameter, value)| value * units.of(parameter));
    Some([values.next()?, values.next()?])
}

fn events(branch: &Followed, cut: &Cut, units: &Units) -> Vec<EventObject> {
    let all = branch.points.iter().enumerate();
    all.filter_map(|(k, point)| point.event.map(|event| EventObject::new(k, point, &event, (cut, units)))).collect()
}

impl EventObject {
    fn new(place: usize, point: &SolutionPoint, event: &BranchEvent, (cut, units): (&Cut, &Units)) -> Self {
        let record = EventRecord::of(point, event);
        Self {
            kind: record.kind,
            parameter: point.value * units.of(cut.vary),
            values: both(point, cut, units),
            point: place,
            fields: EventFields::new(record),
        }
    }
}

impl EventFields {
    pub(super) fn new(record: EventRecord) -> Self {
        let EventRecord { kind: _, ends, label_before, label_after, change, impact, side: at, phase, turns, also } =
            record;
        Self {
            ends,
            label_after,
            label_before,
            change,
            impact,
            side: at.map(side),
            phase,
            turns,
            also: also.map(|(impact, at, phase)| TouchObject { impact, side: side(at), phase }),
        }
    }
}
