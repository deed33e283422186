//! Branches of periodic orbits as text: their events, and how they end.

use crate::report::words::{stop_name, table};
use std::fmt::Write;
use vibroimpact::continuation::{BranchEvent, Change, SolutionPoint, Touch};
use vibroimpact::orbit::Cycle;
use vibroimpact::{Label, Parameter};
use vibroimpact_report::Units;
use vibroimpact_report::number::{precise, short};
use vibroimpact_study::{Branches, Chosen, Cut, Followed, counted};

/// The name of a parameter in a sentence, such as `gap` or `inverse beta`.
pub(crate) fn named(parameter: Parameter, units: &Units) -> String {
    if let Parameter::Physical(parameter) = parameter {
        let (name, unit) = (parameter.description(), parameter.unit());
        return if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") };
    }
    let name = parameter.name().replace('_', " ");
    match units.unit_of(parameter) {
        "" => name,
        "Hz" => "frequency (Hz)".to_owned(),
        unit => units.named(&name, unit),
    }
}

/// The number of the orbit, if there are several.
pub(crate) fn chosen(chosen: &Chosen) -> String {
    let which = if chosen.count > 1 { format!("orbit {} of {}, ", chosen.number, chosen.count) } else { String::new() };
    let stability = if chosen.orbit.physical { chosen.orbit.cycle.stability().name() } else { "inadmissible" };
    format!("{which}{stability} there")
}

/// The text of all branches, each with its events and its end.
pub(crate) fn text(found: &Branches, cut: &Cut, units: &Units) -> String {
    let (unit, name, (from, to)) = (units.of(cut.vary), named(cut.vary, units), cut.ends);
    let also = cut.also.map_or_else(String::new, |also| {
        let unit = units.of(also.parameter);
        format!(", {} from {} to {}", named(also.parameter, units), short(also.from * unit), short(also.to * unit))
    });
    let mut text = String::new();
    for (k, branch) in found.followed.iter().enumerate() {
        let origin = branch.origin.as_ref().and_then(|origin| Some((origin, origin.point.event?)));
        let _ = match origin {
            None => writeln!(
                text,
                "branch 1: {} ({}), {name} from {} to {}{also}, {}",
                found.chosen.orbit.cycle.label,
                chosen(&found.chosen),
                short(from * unit),
                short(to * unit),
                counted(branch.points.len() as u64, "point")
            ),
            Some((origin, event)) => writeln!(
                text,
                "\nbranch {}: {} from the {} of branch {} at {name} {}, {}",
                k + 1,
                branch.points.first().map_or_else(String::new, |point| point.cycle.label.to_string()),
                event.name(),
                origin.branch + 1,
                precise(origin.point.value * unit),
                counted(branch.points.len() as u64, "point")
            ),
        };
        text.push_str(&of(branch, cut, units));
    }
    for origin in &found.lost {
        let kind = origin.point.event.map_or("event", |event| event.name());
        let value = precise(origin.point.value * unit);
        let _ = writeln!(text, "\nno branch was found at the {kind} of branch {} at {name} {value}", origin.branch + 1);
    }
    text
}

fn of(branch: &Followed, cut: &Cut, units: &Units) -> String {
    let (unit, name) = (units.of(cut.vary), named(cut.vary, units));
    let varied = cut.parameters().map(|parameter| named(parameter, units));
    let heads: Vec<String> = core::iter::once("<event".to_owned())
        .chain(varied)
        .chain(["<before", "<after", "<"].map(str::to_owned))
        .collect();
    let points = &branch.points;
    let events = points.iter().enumerate().filter_map(|(k, point)| Some((k, point, point.event?)));
    let rows: Vec<Vec<String>> = events
        .filter(|(.., event)| !event.ends())
        .map(|(k, point, event)| {
            let (before, after) = match event {
                BranchEvent::Grazing { before, after, .. } | BranchEvent::SoftLanding { before, after, .. } => {
                    (before, after)
                }
                _ => (point.cycle.label, point.cycle.label),
            };
            let before = beside(k.checked_sub(1).and_then(|k| points.get(k)), before);
            let after = beside(points.get(k + 1), after);
            let values = cut.values(point.value).map(|(parameter, value)| precise(value * units.of(parameter)));
            core::iter::once(event.name().to_owned())
                .chain(values)
                .chain([before, after, remark(point, &event)])
                .collect()
        })
        .collect();
    let mut text = if rows.is_empty() { "  no events on the way\n".to_owned() } else { table(&heads, &rows) };
    let end = points.last().and_then(|point| Some((point, point.event.filter(BranchEvent::ends)?)));
    if let Some((point, event)) = end {
        let value = precise(point.value * unit);
        let before = points.iter().rev().find(|point| point.event.is_none()).map_or_else(String::new, state);
        let why = remark(point, &event);
        let why = if why.is_empty() { why } else { format!(": {why}") };
        let _ = writeln!(text, "  ends at {name} {value}, {before}: {}{why}", event.name());
    }
    text
}

/// The stability of a branch next to an event. Unknown if there is no point between two events, because rounding hides
/// the multipliers there, or if the branch ends at the event.
fn beside(neighbour: Option<&SolutionPoint>, label: Label) -> String {
    match neighbour {
        Some(point) if plain(point) && point.cycle.label == label => state(point),
        Some(point) if point.event.is_some_and(|event| event.ends()) => format!("{label} not followed"),
        Some(_) => format!("{label} unresolved"),
        None => label.to_string(),
    }
}

/// Whether a point has no event other than the end of the range.
const fn plain(point: &SolutionPoint) -> bool {
    matches!(point.event, None | Some(BranchEvent::EndOfRange))
}

/// The state at a point, such as `1/1 stable`.
fn state(point: &SolutionPoint) -> String {
    let stability = if point.physical { point.stability().name() } else { "inadmissible" };
    format!("{} {stability}", point.cycle.label)
}

/// The change of an impact at a grazing event.
fn touch(cycle: &Cycle, change: Change, touch: &Touch) -> String {
    let (impact, stop, phase) = (touch.impact + 1, stop_name(touch.side), short(touch.phase));
    match change {
        Change::Appears if cycle.points.is_empty() => format!("an impact on the {stop} appears, phase {phase}"),
        // the list of a cycle with sticking begins at a release
        Change::Appears if !cycle.rests.is_empty() && impact == cycle.points.len() => {
            format!("an impact on the {stop} appears after the release, phase {phase}")
        }
        Change::Appears => format!("an impact on the {stop} appears after impact {impact}, phase {phase}"),
        Change::Disappears => format!("impact {impact} on the {stop} disappears, phase {phase}"),
    }
}

/// What an event means, without its name.
pub(crate) fn remark(point: &SolutionPoint, event: &BranchEvent) -> String {
    match event {
        BranchEvent::Grazing { change, impact, side, phase, turns, also, .. } => {
            let way = match (point.cycle.rests.is_empty(), turns) {
                (true, true) => "; the parameter turns",
                (true, false) => "; the parameter goes on",
                (false, _) => "",
            };
            let touches = [Some(Touch { impact: *impact, side: *side, phase: *phase }), *also];
            let said: Vec<String> = touches.iter().flatten().map(|one| touch(&point.cycle, *change, one)).collect();
            format!("{}{way}", said.join(", and "))
        }
        BranchEvent::SoftLanding { side, phase, .. } => {
            format!("it lands on the {} without speed, phase {}", stop_name(*side), short(*phase))
        }
        BranchEvent::EndOfRest { side, phase } => {
            format!("the rest on the {} is over as it begins, phase {}", stop_name(*side), short(*phase))
        }
        BranchEvent::RestForEver { side } => format!("the force no longer pulls the mass off the {}", stop_name(*side)),
        BranchEvent::Chatter { side, phase, .. } => format!(
            "impacts are added without end, towards a rest on the {} at phase {}; beyond, {}",
            stop_name(*side),
            short(*phase),
            point.cycle.label
        ),
        BranchEvent::LossOfContact { side, phase } => {
            format!("the mass no longer reaches the {}, phase {}", stop_name(*side), short(*phase))
        }
        BranchEvent::Stick { impact } => format!("the mass stays on the stop after impact {}", impact + 1),
        BranchEvent::Halving => "it becomes an orbit of half the period".into(),
        BranchEvent::StepLimit => "--points allows more".into(),
        BranchEvent::ImpactLimit => "more impacts than are followed".into(),
        _ => String::new(),
    }
}
