//! Branches of periodic orbits as tables, text and JSON.

use crate::args::Units;
use crate::report::csv::Number;
use crate::report::json::{CyclePoint, impacts, pairs, side};
use crate::report::text::{precise, short, stop_name, table};
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::continuation::{BranchEvent, Change, Point};
use vibroimpact::orbit::Cycle;
use vibroimpact::{Label, Parameter};
use vibroimpact_study::{Branches, Chosen, Followed};

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
        let label = point.cycle.label.to_string();
        let bare = Self {
            kind: event.name(),
            parameter: point.value * unit,
            point: place,
            ends: event.ends(),
            label_after: (!event.ends()).then(|| label.clone()),
            label_before: label,
            change: None,
            impact: None,
            side: None,
            phase: None,
            turns: None,
        };
        match event {
            BranchEvent::Grazing { change, impact, side: at, phase, before, after, turns } => Self {
                label_before: before.to_string(),
                label_after: Some(after.to_string()),
                change: Some(changes(*change)),
                impact: Some(impact + 1),
                side: Some(side(*at)),
                phase: Some(*phase),
                turns: Some(*turns),
                ..bare
            },
            BranchEvent::LossOfContact { side: at, phase } => {
                Self { side: Some(side(*at)), phase: Some(*phase), ..bare }
            }
            BranchEvent::Stick { impact } => Self { impact: Some(impact + 1), ..bare },
            _ => bare,
        }
    }
}

const fn changes(change: Change) -> &'static str {
    match change {
        Change::Appears => "appears",
        Change::Disappears => "disappears",
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

/// `gap`, `inverse beta`: a parameter in a sentence.
pub(crate) fn named(parameter: Parameter, units: &Units) -> String {
    let name = parameter.name().replace('_', " ");
    if vibroimpact_study::is_length(parameter) { units.named(&name, "m") } else { name }
}

/// Which orbit, if there were several.
pub(crate) fn chosen(chosen: &Chosen) -> String {
    let which = if chosen.count > 1 { format!("orbit {} of {}, ", chosen.number, chosen.count) } else { String::new() };
    let stable = match (chosen.orbit.physical, chosen.orbit.cycle.stable()) {
        (false, _) => "no motion",
        (true, true) => "stable",
        (true, false) => "unstable",
    };
    format!("{which}{stable} there")
}

/// Every branch: its events, and how it ends.
pub(crate) fn text(found: &Branches, vary: Parameter, (from, to): (f64, f64), units: &Units) -> String {
    let (unit, name) = (units.of(vary), named(vary, units));
    let mut text = String::new();
    for (k, branch) in found.followed.iter().enumerate() {
        let origin = branch.origin.as_ref().and_then(|origin| Some((origin, origin.point.event?)));
        let _ = match origin {
            None => writeln!(
                text,
                "branch 1: {} ({}), {name} from {} to {}, {} points",
                found.chosen.orbit.cycle.label,
                chosen(&found.chosen),
                short(from * unit),
                short(to * unit),
                branch.points.len()
            ),
            Some((origin, event)) => writeln!(
                text,
                "\nbranch {}: {} from the {} of branch {} at {name} {}, {} points",
                k + 1,
                branch.points.first().map_or_else(String::new, |point| point.cycle.label.to_string()),
                event.name(),
                origin.branch + 1,
                precise(origin.point.value * unit),
                branch.points.len()
            ),
        };
        text.push_str(&of(branch, unit, &name));
    }
    for origin in &found.lost {
        let kind = origin.point.event.map_or("event", |event| event.name());
        let value = precise(origin.point.value * unit);
        let _ = writeln!(text, "\nno branch was found at the {kind} of branch {} at {name} {value}", origin.branch + 1);
    }
    text
}

fn of(branch: &Followed, unit: f64, name: &str) -> String {
    let heads = ["<event".to_owned(), name.to_owned(), "<before".into(), "<after".into(), "<".into()];
    let points = &branch.points;
    let events = points.iter().enumerate().filter_map(|(k, point)| Some((k, point, point.event?)));
    let rows: Vec<Vec<String>> = events
        .clone()
        .filter(|(.., event)| !event.ends())
        .map(|(k, point, event)| {
            let (before, after) = match event {
                BranchEvent::Grazing { before, after, .. } => (before, after),
                _ => (point.cycle.label, point.cycle.label),
            };
            let before = beside(k.checked_sub(1).and_then(|k| points.get(k)), before);
            let after = beside(points.get(k + 1), after);
            vec![event.name().into(), precise(point.value * unit), before, after, remark(&event)]
        })
        .collect();
    let mut text = if rows.is_empty() { "  no events on the way\n".to_owned() } else { table(&heads, &rows) };
    if let Some((_, point, event)) = events.last().filter(|(.., event)| event.ends()) {
        let value = precise(point.value * unit);
        let before = points.iter().rev().find(|point| point.event.is_none()).map_or_else(String::new, state);
        let why = remark(&event);
        let why = if why.is_empty() { why } else { format!(": {why}") };
        let _ = writeln!(text, "  ends at {name} {value}, {before}: {}{why}", event.name());
    }
    text
}

/// What a branch is beside an event; of a neighbour that is an event itself only the label is known.
fn beside(neighbour: Option<&Point>, label: Label) -> String {
    let plain = neighbour.filter(|point| point.event.is_none() && point.cycle.label == label);
    plain.map_or_else(|| label.to_string(), state)
}

/// `1/1 stable`.
fn state(point: &Point) -> String {
    let stability = match (point.physical, point.stable()) {
        (false, _) => "no motion",
        (true, true) => "stable",
        (true, false) => "unstable",
    };
    format!("{} {stability}", point.cycle.label)
}

fn remark(event: &BranchEvent) -> String {
    match event {
        BranchEvent::Grazing { change, impact, side, phase, turns, .. } => {
            let way = if *turns { "the parameter turns" } else { "the parameter goes on" };
            let (impact, phase) = (impact + 1, short(*phase));
            match change {
                Change::Appears => {
                    format!("an impact on the {} appears after impact {impact}, phase {phase}; {way}", stop_name(*side))
                }
                Change::Disappears => {
                    format!("impact {impact} on the {} disappears, phase {phase}; {way}", stop_name(*side))
                }
            }
        }
        BranchEvent::LossOfContact { side, phase } => {
            format!("the mass no longer reaches the {}, phase {}", stop_name(*side), short(*phase))
        }
        BranchEvent::Stick { impact } => format!("the mass stays on the stop after impact {}", impact + 1),
        BranchEvent::Halving => "it becomes an orbit of half the period".into(),
        BranchEvent::StepLimit => "--points allows more".into(),
        BranchEvent::ImpactLimit => "a complete chatter is near".into(),
        _ => String::new(),
    }
}
