//! Branches of periodic orbits as JSON and as tables.

use crate::args::Units;
use crate::report::csv::Number;
use crate::report::json::{CyclePoint, Rest, impacts, pairs, rests, side};
use serde::Serialize;
use vibroimpact::Parameter;
use vibroimpact::continuation::{BranchEvent, Point};
use vibroimpact::orbit::Cycle;
use vibroimpact_study::{Branches, Chosen, Followed, Told};

/// The command's part of the object.
#[derive(Serialize)]
pub(crate) struct Answer {
    label: String,
    vary: &'static str,
    from: f64,
    to: f64,
    orbit: ChosenObject,
    points: Vec<PointObject>,
    events: Vec<EventObject>,
    branches: Vec<BranchObject>,
}

/// Which of the orbits it began with.
#[derive(Serialize)]
pub(crate) struct ChosenObject {
    number: u32,
    count: u32,
}

#[derive(Serialize)]
struct PointObject {
    parameter: f64,
    label: String,
    cycle: Vec<CyclePoint>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rests: Vec<Rest>,
    multipliers: [[f64; 2]; 2],
    stable: bool,
    physical: bool,
}

#[derive(Serialize)]
struct EventObject {
    kind: &'static str,
    parameter: f64,
    /// Place among the points.
    point: usize,
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

/// A touch together with that of the event.
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

/// Where it begins.
#[derive(Serialize)]
struct OriginObject {
    kind: &'static str,
    parameter: f64,
    /// Counted from 1, the branch of the orbit being the first.
    branch: usize,
}

impl ChosenObject {
    pub(crate) const fn new(chosen: &Chosen) -> Self {
        Self { number: chosen.number, count: chosen.count }
    }
}

impl Answer {
    pub(crate) fn new(found: &Branches, vary: Parameter, (from, to): (f64, f64), units: &Units) -> Self {
        let unit = units.of(vary);
        let points =
            |branch: &Followed| branch.points.iter().map(|point| PointObject::new(point, unit, units)).collect();
        let mut rest = found.followed.iter();
        let first = rest.next();
        Self {
            label: found.chosen.orbit.cycle.label.to_string(),
            vary: vary.name(),
            from: from * unit,
            to: to * unit,
            orbit: ChosenObject::new(&found.chosen),
            points: first.map_or_else(Vec::new, points),
            events: first.map_or_else(Vec::new, |branch| events(branch, unit)),
            branches: rest
                .filter_map(|branch| {
                    let origin = branch.origin.as_ref()?;
                    let from = OriginObject {
                        kind: origin.point.event.map_or("", |event| event.name()),
                        parameter: origin.point.value * unit,
                        branch: origin.branch + 1,
                    };
                    Some(BranchObject { from, points: points(branch), events: events(branch, unit) })
                })
                .collect(),
        }
    }
}

impl PointObject {
    fn new(point: &Point, unit: f64, units: &Units) -> Self {
        Self {
            parameter: point.value * unit,
            label: point.cycle.label.to_string(),
            cycle: impacts(&point.cycle, units),
            rests: rests(&point.cycle),
            multipliers: pairs(point.cycle.multipliers),
            stable: point.stable(),
            physical: point.physical,
        }
    }
}

fn events(branch: &Followed, unit: f64) -> Vec<EventObject> {
    let all = branch.points.iter().enumerate();
    all.filter_map(|(k, point)| point.event.map(|event| EventObject::new(k, point, &event, unit))).collect()
}

impl EventObject {
    fn new(place: usize, point: &Point, event: &BranchEvent, unit: f64) -> Self {
        let Told { kind, ends, label_before, label_after, change, impact, side: at, phase, turns, also } =
            Told::of(point, event);
        Self {
            kind,
            parameter: point.value * unit,
            point: place,
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

/// The columns of the table.
pub(crate) fn columns(vary: Parameter) -> String {
    format!("branch,{},label,physical,stable,event,re_1,im_1,re_2,im_2,phases,velocities", vary.name())
}

/// One row a point; phases and velocities are lists with blanks between.
pub(crate) fn rows<'a>(found: &'a Branches, vary: Parameter, units: &'a Units) -> impl Iterator<Item = String> + 'a {
    let unit = units.of(vary);
    found.followed.iter().enumerate().flat_map(move |(k, branch)| {
        branch.points.iter().map(move |point| {
            let event = point.event.map_or("", |event| event.name());
            format!(
                "{},{},{},{},{},{event},{}",
                k + 1,
                Number(point.value * unit),
                point.cycle.label,
                point.physical,
                point.stable(),
                cells(&point.cycle, units)
            )
        })
    })
}

/// Multipliers, phases and velocities of a cycle.
pub(crate) fn cells(cycle: &Cycle, units: &Units) -> String {
    let list = |of: &dyn Fn(&vibroimpact::orbit::CyclePoint) -> f64| {
        let cells: Vec<String> = cycle.points.iter().map(|point| Number(of(point)).to_string()).collect();
        cells.join(" ")
    };
    let [[a, b], [c, d]] = pairs(cycle.multipliers);
    format!(
        "{},{},{},{},{},{}",
        Number(a),
        Number(b),
        Number(c),
        Number(d),
        list(&|point| point.state.phase),
        list(&|point| point.state.velocity * units.velocity())
    )
}
