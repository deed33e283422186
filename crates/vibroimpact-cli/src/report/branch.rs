//! Branches of periodic orbits as text: their events, and how they end.

use crate::report::diagram::range;
use crate::report::words::{stop_name, table};
use std::fmt::Write;
use vibroimpact::continuation::{BranchEvent, Change, SolutionPoint, Touch, machine};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::Stability;
use vibroimpact_report::json::branch::{
    BranchAnswer, BranchEventObject, BranchObject, ChosenObject, Event, OriginObject, PointObject,
};
use vibroimpact_report::number::{precise, short};
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{Cut, counted};

/// The number of the orbit, if there are several, and its stability.
pub(crate) fn chosen(orbit: Option<ChosenObject>, stability: Option<Stability>) -> String {
    let which = orbit.filter(|orbit| orbit.count > 1);
    let which = which.map_or_else(String::new, |orbit| format!("orbit {} of {}, ", orbit.number, orbit.count));
    format!("{which}{} there", stability.map_or("inadmissible", |stability| stability.name()))
}

/// What the columns of a table of events say of a point.
struct Columns {
    names: Vec<String>,
    /// Whether there is no forcing: with it the label says the period.
    period: bool,
}

/// The text of all branches, each with its events and its end.
pub(crate) fn text<V: Varied>(
    answer: &BranchAnswer<'_>,
    machine: Option<&Machine>,
    (cut, units): (&Cut<V>, &Units),
) -> String {
    let names = cut.names().map(|name| name.words(units)).collect();
    let columns = Columns { names, period: machine.is_some_and(|machine| machine.period().is_none()) };
    let place = |OriginObject { kind, branch, parameter }: OriginObject| {
        format!("{kind} of branch {branch} at {} {}", columns.names[0], precise(parameter))
    };
    let mut text = String::new();
    for (k, branch) in answer.branches.iter().enumerate() {
        let count = counted(branch.points.len() as u64, "point");
        text.push_str(&match branch.from {
            None => {
                let orbit = chosen(answer.orbit, answer.stability);
                let start =
                    branch.start.map(|start| format!(", both ways from {}", short(branch.points[start].parameter)));
                let along = range(cut, units) + &start.unwrap_or_default();
                format!("branch 1: {} ({orbit}), {along}, {count}\n", answer.label)
            }
            Some(origin) => {
                let label = branch.points.first().map_or("", |point| &point.label);
                format!("\nbranch {}: {label} from the {}, {count}\n", k + 1, place(origin))
            }
        });
        let sides = branch.sides();
        for side in &sides {
            if let [_, _] = sides.as_slice() {
                let last = side.last().map_or(f64::NAN, |last| branch.points[*last].parameter);
                let _ = writeln!(text, "  to {} {}:", columns.names[0], short(last));
            }
            text.push_str(&events(&Side { branch, points: side }, &columns));
        }
    }
    for origin in &answer.lost {
        let _ = writeln!(text, "\nno branch was found at the {}", place(*origin));
    }
    text
}

/// One side of a branch: its points on the way from the start.
struct Side<'a, 'b> {
    branch: &'a BranchObject<'b>,
    points: &'a [usize],
}

impl<'b> Side<'_, 'b> {
    fn point(&self, place: usize) -> Option<&PointObject<'b>> {
        self.branch.points.get(*self.points.get(place)?)
    }

    fn event(&self, place: usize) -> Option<&BranchEventObject<'b>> {
        self.branch.event_at(*self.points.get(place)?)
    }
}

/// One row for each event, and how the branch ends.
fn events(side: &Side<'_, '_>, columns: &Columns) -> String {
    let heads: Vec<String> = core::iter::once("<event".to_owned())
        .chain(columns.names.iter().cloned())
        .chain(columns.period.then(|| "period".to_owned()))
        .chain(["<before", "<after", "<"].map(str::to_owned))
        .collect();
    let events = (0..side.points.len()).filter_map(|place| Some((place, side.event(place)?)));
    let (ends, passed): (Vec<_>, Vec<_>) = events.partition(|(_, event)| event.fields.ends);
    let rows: Vec<Vec<String>> = passed.into_iter().map(|(place, event)| row(side, place, event, columns)).collect();
    let mut text = if rows.is_empty() { "  no events on the way\n".to_owned() } else { table(&heads, &rows) };
    if let Some((_, event)) = ends.last() {
        let before = (0..side.points.len()).rev().find(|place| side.event(*place).is_none());
        let before = before.and_then(|place| side.point(place)).map_or_else(String::new, state);
        // without forcing the label does not say the period
        let period = side.branch.points[event.point].period;
        let period = if columns.period { format!(", period {}", precise(period)) } else { String::new() };
        let (value, name, why) = (precise(event.parameter), event.kind, because(&event.event));
        let _ = writeln!(text, "  ends at {} {value}{period}, {before}: {name}{why}", columns.names[0]);
    }
    text
}

fn row(side: &Side<'_, '_>, place: usize, event: &BranchEventObject<'_>, columns: &Columns) -> Vec<String> {
    let point = &side.branch.points[event.point];
    let before = &event.fields.before;
    let after = event.fields.after.as_ref().unwrap_or(before);
    // on the other side of a jump there is another part of the branch
    let jumps = |place: usize| side.event(place).is_some_and(|event| event.event.is_jump());
    let next_to = |jump: bool, neighbour: Option<usize>, label: &str| {
        if jump { "-".to_owned() } else { beside(side, neighbour, label) }
    };
    let next = place + 1;
    let sides = [next_to(jumps(place), place.checked_sub(1), before), next_to(jumps(next), Some(next), after)];
    core::iter::once(event.kind.to_owned())
        .chain(point.values().iter().copied().chain(columns.period.then_some(point.period)).map(precise))
        .chain(sides)
        .chain([remark(&event.event)])
        .collect()
}

/// The stability of a branch next to an event. Unknown if there is no point between two events, because rounding hides
/// the multipliers there, or if the branch ends at the event.
fn beside(side: &Side<'_, '_>, neighbour: Option<usize>, label: &str) -> String {
    let Some((place, point)) = neighbour.and_then(|k| Some((k, side.point(k)?))) else { return label.to_owned() };
    let event = side.event(place);
    match event {
        _ if point.label == label && event.is_none_or(|event| event.event.is_end_of_range()) => state(point),
        Some(event) if event.fields.ends => format!("{label} not followed"),
        _ => format!("{label} unresolved"),
    }
}

/// The state at a point, such as `1/1 stable`.
fn state(point: &PointObject<'_>) -> String {
    format!("{} {}", point.label, if point.admissible { point.stability } else { "inadmissible" })
}

/// What an event means, without its name.
pub(crate) fn remark(event: &Event<'_>) -> String {
    match event {
        Event::Oscillator(point, event) => of_oscillator(point, event),
        Event::Machine(machine, event) => of_machine(event, machine),
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
        machine::BranchEvent::Grazing { stop, also, appears, turns } => {
            let verb = if appears { "appear" } else { "disappear" };
            let way = if turns { "turns" } else { "goes on" };
            match also {
                Some(other) => format!("impacts on {} and {} {verb}; the parameter {way}", name(stop), name(other)),
                None => format!("an impact on {} {verb}s; the parameter {way}", name(stop)),
            }
        }
        machine::BranchEvent::LossOfContact { stop } => format!("{} is no longer reached", name(stop)),
        machine::BranchEvent::RestForEver { stop } => format!("no force pulls it off {} any more", name(stop)),
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
