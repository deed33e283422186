//! Branches of periodic orbits as text: their events, and how they end.

use crate::report::diagram::range;
use crate::report::words::{stop_name, table};
use std::fmt::Write;
use vibroimpact::continuation::{BranchEvent, Change, SolutionPoint, Touch, machine};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::Stability;
use vibroimpact_report::Varied;
use vibroimpact_report::number::{precise, short};
use vibroimpact_report::solutions::{BranchesView, Event, OriginView, PointView};
use vibroimpact_study::{OrbitNumber, counted};

/// The number of the orbit, if there are several, and its stability.
pub(crate) fn chosen(number: Option<OrbitNumber>, stability: Option<Stability>) -> String {
    let which = number.filter(|among| among.count > 1);
    let which = which.map_or_else(String::new, |among| format!("orbit {} of {}, ", among.number, among.count));
    format!("{which}{} there", stability.map_or("inadmissible", |stability| stability.name()))
}

/// What the columns of a table of events say of a point.
struct Columns {
    names: Vec<String>,
    /// Whether there is no forcing: with it the label says the period.
    period: bool,
}

/// The text of all branches, each with its events and its end.
pub(crate) fn text<V: Varied>(view: &BranchesView<'_, V>) -> String {
    let names = view.cut.names().map(|name| name.words(&view.units)).collect();
    let period = view.machine.is_some_and(|machine| machine.period().is_none());
    let columns = Columns { names, period };
    let place = |OriginView { kind, branch, value }: OriginView| {
        format!("{kind} of branch {branch} at {} {}", columns.names[0], precise(value))
    };
    let mut text = String::new();
    for (k, branch) in view.branches.iter().enumerate() {
        let points = &branch.points;
        let count = counted(points.len() as u64, "point");
        text.push_str(&match branch.origin {
            None => {
                let orbit = chosen(view.number, view.stability);
                format!("branch 1: {} ({orbit}), {}, {count}\n", view.label, range(&view.cut, &view.units))
            }
            Some(origin) => {
                let label = points.first().map_or_else(String::new, |point| point.cycle.label().to_string());
                format!("\nbranch {}: {label} from the {}, {count}\n", k + 1, place(origin))
            }
        });
        text.push_str(&events(points, &columns));
    }
    for origin in &view.lost {
        let _ = writeln!(text, "\nno branch was found at the {}", place(*origin));
    }
    text
}

/// One row for each event, and how the branch ends.
fn events(points: &[PointView<'_>], columns: &Columns) -> String {
    let period = columns.period.then(|| "period".to_owned());
    let heads: Vec<String> = core::iter::once("<event".to_owned())
        .chain(columns.names.iter().cloned())
        .chain(period)
        .chain(["<before", "<after", "<"].map(str::to_owned))
        .collect();
    let all = points.iter().enumerate().filter_map(|(k, point)| Some((k, point, point.event.as_ref()?)));
    let row = |(k, point, event): (usize, &PointView<'_>, &Event<'_>)| {
        let (label_before, label_after) = event.labels();
        let before = beside(k.checked_sub(1).and_then(|k| points.get(k)), &label_before);
        let after = beside(points.get(k + 1), &label_after);
        core::iter::once(event.name().to_owned())
            .chain(point.values.iter().copied().chain(columns.period.then(|| point.cycle.period())).map(precise))
            .chain([before, after, remark(event)])
            .collect()
    };
    let rows: Vec<Vec<String>> = all.filter(|(.., event)| !event.ends()).map(row).collect();
    let mut text = if rows.is_empty() { "  no events on the way\n".to_owned() } else { table(&heads, &rows) };
    let end = points.last().and_then(|point| Some((point, point.event.as_ref().filter(|event| event.ends())?)));
    if let Some((point, event)) = end {
        // without forcing the label does not say the period
        let period = columns.period.then(|| format!(", period {}", precise(point.cycle.period())));
        let value = precise(point.values[0]) + &period.unwrap_or_default();
        let before = points.iter().rev().find(|point| point.event.is_none()).map_or_else(String::new, state);
        let _ = writeln!(text, "  ends at {} {value}, {before}: {}{}", columns.names[0], event.name(), because(event));
    }
    text
}

/// The stability of a branch next to an event. Unknown if there is no point between two events, because rounding hides
/// the multipliers there, or if the branch ends at the event.
fn beside(neighbour: Option<&PointView<'_>>, label: &str) -> String {
    let Some(point) = neighbour else { return label.to_owned() };
    match &point.event {
        None if point.cycle.label().to_string() == label => state(point),
        Some(event) if event.is_end_of_range() && point.cycle.label().to_string() == label => state(point),
        Some(event) if event.ends() => format!("{label} not followed"),
        _ => format!("{label} unresolved"),
    }
}

/// The state at a point, such as `1/1 stable`.
fn state(point: &PointView<'_>) -> String {
    let stability = if point.admissible { point.cycle.stability().name() } else { "inadmissible" };
    format!("{} {stability}", point.cycle.label())
}

/// What an event means, without its name.
pub(crate) fn remark(event: &Event<'_>) -> String {
    match event {
        Event::Oscillator { point, event } => of_oscillator(point, event),
        Event::Machine { event, machine, .. } => of_machine(event, machine),
    }
}

/// The same after a colon; empty if there is nothing to say.
pub(crate) fn because(event: &Event<'_>) -> String {
    let why = remark(event);
    if why.is_empty() { why } else { format!(": {why}") }
}

fn of_machine(event: &machine::BranchEvent, machine: &Machine) -> String {
    let name = |place: usize| machine.name_of(place);
    match *event {
        machine::BranchEvent::Grazing { stop, appears, turns } => format!(
            "an impact on {} {}; the parameter {}",
            name(stop),
            if appears { "appears" } else { "disappears" },
            if turns { "turns" } else { "goes on" }
        ),
        machine::BranchEvent::LossOfContact { stop } => format!("{} is no longer reached", name(stop)),
        machine::BranchEvent::Corner { first, second } if first == second => {
            format!("two limits of {} at once", name(first))
        }
        machine::BranchEvent::Corner { first, second } => {
            format!("{} and {} at once", name(first), name(second))
        }
        machine::BranchEvent::Sticking { stop: place, .. }
        | machine::BranchEvent::Holding { joint: place, .. }
        | machine::BranchEvent::Change { place: Some(place) } => format!("at {}", name(place)),
        machine::BranchEvent::Halving => HALF.into(),
        machine::BranchEvent::StepLimit => LIMIT.into(),
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

fn of_oscillator(point: &SolutionPoint, event: &BranchEvent) -> String {
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
