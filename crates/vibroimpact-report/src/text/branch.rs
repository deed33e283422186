//! Branches of periodic orbits as text: their events, and how they end.

use crate::json::branch::{
    BranchAnswer, BranchEventObject, BranchObject, ChosenObject, EventOf, OriginObject, PointObject,
};
use crate::number::{precise, short};
use crate::task::diagram::range;
use crate::text::words::{aligned, stop_name};
use crate::{Units, Varied};
use std::fmt::Write;
use vibroimpact::continuation::{BranchEvent, EventDetail, SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::Stability;
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
    let mut text = if rows.is_empty() { "  no events on the way\n".to_owned() } else { aligned(&heads, &rows) };
    if let Some((_, event)) = ends.last() {
        let last = (0..side.points.len()).rev().skip_while(|place| side.event(*place).is_some());
        let last: Vec<_> =
            last.take_while(|place| side.event(*place).is_none()).filter_map(|place| side.point(place)).collect();
        // closest to the end rounding can hide the multipliers
        let told = last.iter().find(|point| point.stability != "neutral").or(last.first());
        let before = told.map_or_else(String::new, |point| state(point));
        // without forcing the label does not say the period
        let period = side.branch.points[event.point].period;
        let period = if columns.period { format!(", period {}", precise(period)) } else { String::new() };
        let (value, name, why) = (precise(event.parameter), event.kind, because(event.event, event.of));
        let _ = writeln!(text, "  ends at {} {value}{period}, {before}: {name}{why}", columns.names[0]);
    }
    text
}

fn row(side: &Side<'_, '_>, place: usize, event: &BranchEventObject<'_>, columns: &Columns) -> Vec<String> {
    let point = &side.branch.points[event.point];
    let before = &event.fields.before;
    let after = event.fields.after.as_ref().unwrap_or(before);
    // on the other side of a jump there is another part of the branch
    let jumps = |place: usize| side.event(place).is_some_and(|event| event.event == BranchEvent::Jump);
    let next_to = |jump: bool, neighbour: Option<usize>, label: &str| {
        if jump { "-".to_owned() } else { beside(side, neighbour, label) }
    };
    let next = place + 1;
    let sides = [next_to(jumps(place), place.checked_sub(1), before), next_to(jumps(next), Some(next), after)];
    core::iter::once(event.kind.to_owned())
        .chain(point.values().iter().copied().chain(columns.period.then_some(point.period)).map(precise))
        .chain(sides)
        .chain([remark(event.event, event.of)])
        .collect()
}

/// The stability of a branch next to an event. Unknown if there is no point between two events, because rounding hides
/// the multipliers there, or if the branch ends at the event.
fn beside(side: &Side<'_, '_>, neighbour: Option<usize>, label: &str) -> String {
    let Some((place, point)) = neighbour.and_then(|k| Some((k, side.point(k)?))) else { return label.to_owned() };
    let event = side.event(place);
    match event {
        _ if point.label == label && event.is_none_or(|event| event.event == BranchEvent::EndOfRange) => state(point),
        Some(event) if event.fields.ends => format!("{label} not followed"),
        _ => format!("{label} unresolved"),
    }
}

/// The state at a point, such as `1/1 stable`.
fn state(point: &PointObject<'_>) -> String {
    format!("{} {}", point.label, if point.admissible { point.stability } else { "inadmissible" })
}

/// What an event means, without its name.
pub(crate) fn remark(event: BranchEvent, of: EventOf<'_>) -> String {
    match (event, of) {
        (BranchEvent::Halving, _) => "it becomes an orbit of half the period".into(),
        (BranchEvent::StepLimit, _) => "--points allows more".into(),
        (_, EventOf::Oscillator(point)) => of_oscillator(point, event),
        (_, EventOf::Machine(machine)) => of_machine(event, machine),
    }
}

/// The same after a colon; empty if there is nothing to say.
pub(crate) fn because(event: BranchEvent, of: EventOf<'_>) -> String {
    let why = remark(event, of);
    if why.is_empty() { why } else { format!(": {why}") }
}

fn of_machine(event: BranchEvent, machine: &Machine) -> String {
    let name = |place: usize| machine.name_of(place);
    match event {
        BranchEvent::Grazing { stop, also, appears, turns, .. } => {
            let verb = if appears { "appear" } else { "disappear" };
            let way = if turns { "turns" } else { "goes on" };
            match also {
                Some(other) => format!("impacts on {} and {} {verb}; the parameter {way}", name(stop), name(other)),
                None => format!("an impact on {} {verb}s; the parameter {way}", name(stop)),
            }
        }
        BranchEvent::LossOfContact { stop, .. } if stop >= machine.stops().len() => {
            format!("{} holds no more", name(stop))
        }
        BranchEvent::LossOfContact { stop, .. } => format!("{} is no longer reached", name(stop)),
        BranchEvent::RestForEver { stop } if stop >= machine.stops().len() => format!("{} slips no more", name(stop)),
        BranchEvent::RestForEver { stop } => format!("no force pulls it off {} any more", name(stop)),
        BranchEvent::Corner { first, second } if first == second => {
            format!("two limits of {} at once", name(first))
        }
        BranchEvent::Corner { first, second } => {
            format!("{} and {} at once", name(first), name(second))
        }
        BranchEvent::Sticking { stop: place, .. }
        | BranchEvent::Holding { joint: place, .. }
        | BranchEvent::Change { place: Some(place) } => format!("at {}", name(place)),
        _ => String::new(),
    }
}

/// The change of an impact at a grazing event.
fn touch(cycle: &Cycle, appears: bool, (stop, impact, phase): (usize, Option<usize>, f64)) -> String {
    let (stop, phase) = (stop_name(vibroimpact::Side::at(stop)), short(phase));
    match impact.map(|impact| impact + 1) {
        None => format!("an impact on the {stop} appears, phase {phase}"),
        Some(impact) if !appears => format!("impact {impact} on the {stop} disappears, phase {phase}"),
        // the list of a cycle with sticking begins at a release
        Some(impact) if !cycle.rests.is_empty() && impact == cycle.points.len() => {
            format!("an impact on the {stop} appears after the release, phase {phase}")
        }
        Some(impact) => format!("an impact on the {stop} appears after impact {impact}, phase {phase}"),
    }
}

fn of_oscillator(point: &SolutionPoint, event: BranchEvent) -> String {
    let name = event.place().map_or("stop", |stop| stop_name(vibroimpact::Side::at(stop)));
    let detail = event.detail();
    let phase = detail.map_or_else(String::new, |detail| short(detail.phase));
    match event {
        BranchEvent::Grazing { stop, also, appears, turns, detail: Some(detail) } => {
            let way = match (point.cycle.rests.is_empty(), turns) {
                (true, true) => "; the parameter turns",
                (true, false) => "; the parameter goes on",
                (false, _) => "",
            };
            let other = also.zip(detail.also).map(|(stop, (impact, phase))| (stop, impact, phase));
            let touches = [Some((stop, detail.impact, detail.phase)), other];
            let said: Vec<String> =
                touches.into_iter().flatten().map(|one| touch(&point.cycle, appears, one)).collect();
            format!("{}{way}", said.join(", and "))
        }
        BranchEvent::SoftLanding { .. } => format!("it lands on the {name} without speed, phase {phase}"),
        BranchEvent::RestForEver { .. } => format!("the force no longer pulls the mass off the {name}"),
        BranchEvent::Sticking { begins: false, .. } => {
            format!("the rest on the {name} is over as it begins, phase {phase}")
        }
        BranchEvent::Sticking { detail: Some(EventDetail { impact: Some(impact), .. }), .. } => {
            format!("the mass stays on the {name} after impact {}, phase {phase}", impact + 1)
        }
        BranchEvent::Sticking { .. } => {
            let label = point.cycle.label;
            format!("impacts are added without end, towards a rest on the {name} at phase {phase}; beyond, {label}")
        }
        BranchEvent::LossOfContact { .. } => format!("the mass no longer reaches the {name}, phase {phase}"),
        BranchEvent::ImpactLimit => "more impacts than are followed".into(),
        _ => String::new(),
    }
}
