//! Branches of periodic orbits as text: their events, and how they end.

use crate::report::diagram::range;
use crate::report::words::{stop_name, table};
use std::fmt::Write;
use vibroimpact::Label;
use vibroimpact::continuation::{BranchEvent, Change, MachineBranchEvent, MachinePoint, SolutionPoint, Touch};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{Cycle, MachineCycle};
use vibroimpact_report::number::{precise, short};
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{Branches, Chosen, Cut, MachineBranched, counted};

/// The number of the orbit, if there are several.
pub(crate) fn chosen(chosen: &Chosen) -> String {
    let which = if chosen.count > 1 { format!("orbit {} of {}, ", chosen.number, chosen.count) } else { String::new() };
    let stability = if chosen.orbit.physical { chosen.orbit.cycle.stability().name() } else { "inadmissible" };
    format!("{which}{stability} there")
}

/// The name of the column of the period.
const PERIOD: &str = "period";

/// A point of a branch of any system, as it is told.
struct Told {
    /// The values of the parameters, in the units of the results.
    values: Vec<f64>,
    label: Label,
    stability: &'static str,
    /// The event at the point.
    event: Option<ToldEvent>,
}

struct ToldEvent {
    name: &'static str,
    ends: bool,
    end_of_range: bool,
    /// The labels on both sides of it.
    sides: (Label, Label),
    remark: String,
}

/// The number of the orbit at which a branch of a machine begins, if there are several, and its stability.
fn chosen_among(among: Option<(u32, u32)>, cycle: Option<&MachineCycle>) -> String {
    let which = among.filter(|(_, count)| *count > 1);
    let which = which.map_or_else(String::new, |(number, count)| format!("orbit {number} of {count}, "));
    format!("{which}{} there", cycle.map_or("none", |cycle| cycle.stability().name()))
}

/// The text of all branches, each with its events and its end.
pub(crate) fn text(found: &Branches, cut: &Cut, units: &Units) -> String {
    let (unit, name) = (units.of(cut.vary), cut.vary.words(units));
    let names: Vec<String> = cut.names().map(|parameter| parameter.words(units)).collect();
    let mut text = String::new();
    for (k, branch) in found.followed.iter().enumerate() {
        let origin = branch.origin.as_ref().and_then(|origin| {
            let place = format!(" of branch {} at {name} {}", origin.branch + 1, precise(origin.point.value * unit));
            Some((origin.point.event?.name(), place))
        });
        let points: Vec<Told> = branch.points.iter().map(|point| Told::of_oscillator(point, cut, units)).collect();
        text.push_str(&match origin {
            None => {
                let begin = format!("{} ({})", found.chosen.orbit.cycle.label, chosen(&found.chosen));
                first(&begin, &range(cut, units), &points)
            }
            Some(origin) => further(k + 1, origin, &points),
        });
        text.push_str(&events(&points, &names));
    }
    for origin in &found.lost {
        let kind = origin.point.event.map_or("event", |event| event.name());
        let value = precise(origin.point.value * unit);
        let _ = writeln!(text, "\nno branch was found at the {kind} of branch {} at {name} {value}", origin.branch + 1);
    }
    text
}

/// The same of a machine.
pub(crate) fn of_machine(found: &MachineBranched, cut: &Cut<String>, machine: &Machine) -> String {
    let mut names: Vec<String> = cut.names().cloned().collect();
    // with forcing the label says the period
    if machine.period().is_none() {
        names.push(PERIOD.to_owned());
    }
    let told = |points: &[MachinePoint]| -> Vec<Told> {
        (0..points.len()).map(|k| Told::of_machine(points, k, cut, machine)).collect()
    };
    let points = told(&found.points);
    let begin = found.points.first().map(|point| &point.cycle);
    let label = begin.map_or_else(String::new, |cycle| cycle.label.to_string());
    let begin = format!("{label} ({})", chosen_among(found.among, begin));
    let mut text = first(&begin, &range(cut, &Units::default()), &points);
    text.push_str(&events(&points, &names));
    for (k, followed) in found.followed.iter().enumerate() {
        let points = told(&followed.points);
        let place = format!(" at {} {}", cut.vary, precise(followed.at));
        text.push_str(&further(k + 2, (followed.event.name(), place), &points));
        text.push_str(&events(&points, &names));
    }
    text
}

/// The line over the branch of the orbit that was asked for.
fn first(begin: &str, over: &str, points: &[Told]) -> String {
    format!("branch 1: {begin}, {over}, {}\n", counted(points.len() as u64, "point"))
}

/// The line over a branch that begins at an event, of a kind and at a place.
fn further(number: usize, (kind, place): (&str, String), points: &[Told]) -> String {
    let label = points.first().map_or_else(String::new, |point| point.label.to_string());
    format!("\nbranch {number}: {label} from the {kind}{place}, {}\n", counted(points.len() as u64, "point"))
}

/// One row for each event, and how the branch ends.
fn events(points: &[Told], names: &[String]) -> String {
    let heads: Vec<String> = core::iter::once("<event".to_owned())
        .chain(names.iter().cloned())
        .chain(["<before", "<after", "<"].map(str::to_owned))
        .collect();
    let all = points.iter().enumerate().filter_map(|(k, point)| Some((k, point, point.event.as_ref()?)));
    let rows: Vec<Vec<String>> = all
        .filter(|(.., event)| !event.ends)
        .map(|(k, point, event)| {
            let before = beside(k.checked_sub(1).and_then(|k| points.get(k)), event.sides.0);
            let after = beside(points.get(k + 1), event.sides.1);
            core::iter::once(event.name.to_owned())
                .chain(point.values.iter().map(|value| precise(*value)))
                .chain([before, after, event.remark.clone()])
                .collect()
        })
        .collect();
    let mut text = if rows.is_empty() { "  no events on the way\n".to_owned() } else { table(&heads, &rows) };
    let end = points.last().and_then(|point| Some((point, point.event.as_ref().filter(|event| event.ends)?)));
    if let Some((point, event)) = end {
        // without forcing the label does not say the period
        let period =
            names.iter().position(|name| name == PERIOD).map(|k| format!(", period {}", precise(point.values[k])));
        let value = precise(point.values[0]) + &period.unwrap_or_default();
        let before = points.iter().rev().find(|point| point.event.is_none()).map_or_else(String::new, Told::state);
        let why = if event.remark.is_empty() { String::new() } else { format!(": {}", event.remark) };
        let _ = writeln!(text, "  ends at {} {value}, {before}: {}{why}", names[0], event.name);
    }
    text
}

/// The stability of a branch next to an event. Unknown if there is no point between two events, because rounding hides
/// the multipliers there, or if the branch ends at the event.
fn beside(neighbour: Option<&Told>, label: Label) -> String {
    match neighbour {
        Some(point) if point.plain() && point.label == label => point.state(),
        Some(point) if point.event.as_ref().is_some_and(|event| event.ends) => format!("{label} not followed"),
        Some(_) => format!("{label} unresolved"),
        None => label.to_string(),
    }
}

impl Told {
    fn of_oscillator(point: &SolutionPoint, cut: &Cut, units: &Units) -> Self {
        let label = point.cycle.label;
        let event = point.event.map(|event| ToldEvent {
            name: event.name(),
            ends: event.ends(),
            end_of_range: event == BranchEvent::EndOfRange,
            sides: match event {
                BranchEvent::Grazing { before, after, .. } | BranchEvent::SoftLanding { before, after, .. } => {
                    (before, after)
                }
                _ => (label, label),
            },
            remark: remark(point, &event),
        });
        Self {
            values: cut.names().zip(cut.values(point.value)).map(|(of, value)| value * units.of(*of)).collect(),
            label,
            stability: if point.physical { point.stability().name() } else { "inadmissible" },
            event,
        }
    }

    /// Point number `k` of a branch of a machine.
    fn of_machine(points: &[MachinePoint], k: usize, cut: &Cut<String>, machine: &Machine) -> Self {
        let MachinePoint { value, cycle, event, .. } = &points[k];
        // a point at an event has the cycle before it
        let after = points.get(k + 1).map_or(cycle.label, |next| next.cycle.label);
        let event = event.map(|event| ToldEvent {
            name: event.name(),
            ends: event.ends(),
            end_of_range: event == MachineBranchEvent::EndOfRange,
            sides: (cycle.label, after),
            remark: remark_of_machine(&event, machine),
        });
        let period = machine.period().is_none().then_some(cycle.period);
        let values = cut.values(*value).chain(period).collect();
        Self { values, label: cycle.label, stability: cycle.stability().name(), event }
    }

    /// Whether the point has no event other than the end of the range.
    fn plain(&self) -> bool {
        self.event.as_ref().is_none_or(|event| event.end_of_range)
    }

    /// The state at the point, such as `1/1 stable`.
    fn state(&self) -> String {
        format!("{} {}", self.label, self.stability)
    }
}

/// What an event of a machine means, without its name.
pub(crate) fn remark_of_machine(event: &MachineBranchEvent, machine: &Machine) -> String {
    let name = |place: usize| machine.name_of(place);
    match *event {
        MachineBranchEvent::Grazing { stop, appears, turns } => format!(
            "an impact on {} {}; the parameter {}",
            name(stop),
            if appears { "appears" } else { "disappears" },
            if turns { "turns" } else { "goes on" }
        ),
        MachineBranchEvent::LossOfContact { stop } => format!("{} is no longer reached", name(stop)),
        MachineBranchEvent::Corner { first, second } if first == second => {
            format!("two limits of {} at once", name(first))
        }
        MachineBranchEvent::Corner { first, second } => format!("{} and {} at once", name(first), name(second)),
        MachineBranchEvent::Sticking { stop: place, .. }
        | MachineBranchEvent::Holding { joint: place, .. }
        | MachineBranchEvent::Change { place: Some(place) } => format!("at {}", name(place)),
        MachineBranchEvent::Halving => HALF.into(),
        MachineBranchEvent::StepLimit => LIMIT.into(),
        _ => String::new(),
    }
}

const HALF: &str = "it becomes an orbit of half the period";
const LIMIT: &str = "--points allows more";

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
        BranchEvent::Halving => HALF.into(),
        BranchEvent::StepLimit => LIMIT.into(),
        BranchEvent::ImpactLimit => "more impacts than are followed".into(),
        _ => String::new(),
    }
}
