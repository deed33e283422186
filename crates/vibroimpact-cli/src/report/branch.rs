//! Branches of periodic orbits as text: their events, and how they end.

use crate::report::diagram::range;
use crate::report::words::{stop_name, table};
use std::fmt::Write;
use vibroimpact::Label;
use vibroimpact::continuation;
use vibroimpact::continuation::{BranchEvent, Change, SolutionPoint, Touch};
use vibroimpact::machine::Machine;
use vibroimpact::orbit;
use vibroimpact::orbit::Cycle;
use vibroimpact_report::number::{precise, short};
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{Branches, Chosen, Cut, Origin, counted};

/// The number of the orbit, if there are several, and its stability.
pub(crate) fn chosen<C>(chosen: &Chosen<C>) -> String {
    let which = chosen.among.filter(|among| among.count > 1);
    let which = which.map_or_else(String::new, |among| format!("orbit {} of {}, ", among.number, among.count));
    format!("{which}{} there", chosen.stability.map_or("inadmissible", |stability| stability.name()))
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
    /// Whether a branch goes on here, beyond values at which it has no solution.
    jump: bool,
    /// The labels on both sides of it.
    sides: (Label, Label),
    remark: String,
}

/// The text of all branches, each with its events and its end.
pub(crate) fn text(found: &Branches, cut: &Cut, units: &Units) -> String {
    let names: Vec<String> = cut.names().map(|parameter| parameter.words(units)).collect();
    let told = |points: &[SolutionPoint]| points.iter().map(|point| Told::of_oscillator(point, cut, units)).collect();
    let event = |point: &SolutionPoint| (point.event.map_or("event", |event| event.name()), point.value);
    branches_text(found, found.chosen.cycle.label, (cut, units, &names), told, event)
}

/// The same of a machine.
pub(crate) fn of_machine(
    found: &Branches<orbit::machine::Cycle, continuation::machine::SolutionPoint>,
    cut: &Cut<String>,
    machine: &Machine,
) -> String {
    // with forcing the label says the period
    let period = machine.period().is_none().then(|| PERIOD.to_owned());
    let names: Vec<String> = cut.names().cloned().chain(period).collect();
    let told = |points: &[continuation::machine::SolutionPoint]| {
        (0..points.len()).map(|k| Told::of_machine(points, k, cut, machine)).collect()
    };
    let event =
        |point: &continuation::machine::SolutionPoint| (point.event.map_or("event", |event| event.name()), point.value);
    branches_text(found, found.chosen.cycle.label, (cut, &Units::default(), &names), told, event)
}

/// The branches of an orbit with this label. `told` says what is at the points of a branch, and `event` which event is at a point.
fn branches_text<C, P, V: Varied>(
    found: &Branches<C, P>,
    label: Label,
    (cut, units, names): (&Cut<V>, &Units, &[String]),
    told: impl Fn(&[P]) -> Vec<Told>,
    event: impl Fn(&P) -> (&'static str, f64),
) -> String {
    let place = |origin: &Origin<P>| {
        let (kind, value) = event(&origin.point);
        let value = precise(value * cut.vary.unit(units));
        format!("{kind} of branch {} at {} {value}", origin.branch + 1, names[0])
    };
    let mut text = String::new();
    for (k, branch) in found.followed.iter().enumerate() {
        let points = told(&branch.points);
        let count = counted(points.len() as u64, "point");
        text.push_str(&match &branch.origin {
            None => format!("branch 1: {label} ({}), {}, {count}\n", chosen(&found.chosen), range(cut, units)),
            Some(origin) => {
                let label = points.first().map_or_else(String::new, |point| point.label.to_string());
                format!("\nbranch {}: {label} from the {}, {count}\n", k + 1, place(origin))
            }
        });
        text.push_str(&events(&points, names));
    }
    for origin in &found.lost {
        let _ = writeln!(text, "\nno branch was found at the {}", place(origin));
    }
    text
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
            let jumps = |k: usize| points.get(k).and_then(|point| point.event.as_ref()).is_some_and(|event| event.jump);
            let side = |jump: bool, neighbour, label| if jump { "-".to_owned() } else { beside(neighbour, label) };
            let before = side(jumps(k), k.checked_sub(1).and_then(|k| points.get(k)), event.sides.0);
            let after = side(jumps(k + 1), points.get(k + 1), event.sides.1);
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
            jump: false,
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
    fn of_machine(
        points: &[continuation::machine::SolutionPoint],
        k: usize,
        cut: &Cut<String>,
        machine: &Machine,
    ) -> Self {
        let continuation::machine::SolutionPoint { value, cycle, event, .. } = &points[k];
        // a point at an event has the cycle before it
        let after = points.get(k + 1).map_or(cycle.label, |next| next.cycle.label);
        let event = event.map(|event| ToldEvent {
            name: event.name(),
            ends: event.ends(),
            end_of_range: event == continuation::machine::BranchEvent::EndOfRange,
            jump: event == continuation::machine::BranchEvent::Jump,
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
pub(crate) fn remark_of_machine(event: &continuation::machine::BranchEvent, machine: &Machine) -> String {
    let name = |place: usize| machine.name_of(place);
    match *event {
        continuation::machine::BranchEvent::Grazing { stop, appears, turns } => format!(
            "an impact on {} {}; the parameter {}",
            name(stop),
            if appears { "appears" } else { "disappears" },
            if turns { "turns" } else { "goes on" }
        ),
        continuation::machine::BranchEvent::LossOfContact { stop } => format!("{} is no longer reached", name(stop)),
        continuation::machine::BranchEvent::RestForEver { stop } => {
            format!("no force pulls it off {} any more", name(stop))
        }
        continuation::machine::BranchEvent::Corner { first, second } if first == second => {
            format!("two limits of {} at once", name(first))
        }
        continuation::machine::BranchEvent::Corner { first, second } => {
            format!("{} and {} at once", name(first), name(second))
        }
        continuation::machine::BranchEvent::Sticking { stop: place, .. }
        | continuation::machine::BranchEvent::Holding { joint: place, .. }
        | continuation::machine::BranchEvent::Change { place: Some(place) } => format!("at {}", name(place)),
        continuation::machine::BranchEvent::Halving => HALF.into(),
        continuation::machine::BranchEvent::StepLimit => LIMIT.into(),
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
