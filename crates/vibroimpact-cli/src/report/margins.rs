//! The nearest events of a motion as text, and the box of parameters in which it was found.

use crate::report::branch::remark;
use crate::report::motion::{InUnits, Teller};
use crate::report::words::table;
use std::fmt::Write;
use vibroimpact::Oscillator;
use vibroimpact::continuation::{BranchEvent, SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Stability, Verdict};
use vibroimpact_report::number::{percent, precise, short};
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{
    EventRecord, Loss, MachineMargins, MarginEnd, MotionBox, MotionMargins, NumberEvent, NumberMargin, ParameterMargin,
    counted,
};

/// The motion, its nearest events in each parameter, and its box.
pub(crate) fn text(found: &MotionMargins, osc: &Oscillator, units: &Units) -> String {
    let label = found.motion.label();
    let mut text = head(&InUnits(osc, units), &found.motion, found.motion.stability(osc));
    if found.parameters.is_empty() {
        text.push_str("  it is no single periodic motion, so it has no branch to follow and no margins\n");
        return text;
    }
    text.push_str(&events(&found.parameters, units));
    if let Some((margin, end)) = found.nearest() {
        let event = end.event().map_or("", |event| event.name());
        let way = if end.distance(&margin.scope) < 0.0 { "down" } else { "up" };
        let _ = writeln!(
            text,
            "  nearest: {event} at {} {}, {way} by {} of {}",
            margin.scope.parameter.words(units),
            precise(end.value * units.of(margin.scope.parameter)),
            percent(end.distance(&margin.scope).abs() / margin.scope.scale),
            whole(core::slice::from_ref(margin))
        );
    }
    match &found.motion_box {
        Some(found_box) => text.push_str(&of_box(found_box, &found.parameters, &label, units)),
        None => {
            let stability = found.motion.stability(osc).map_or("undecided", |stability| stability.name());
            let _ = writeln!(text, "\nno box: the motion is {stability}");
        }
    }
    text
}

fn head<T: Teller>(teller: &T, motion: &Verdict<T::System>, stability: Option<Stability>) -> String {
    let stable = stability.map_or_else(String::new, |stability| format!(", {stability}"));
    let (label, by_stop, meaning) = (motion.label(), teller.by_stop(motion), teller.meaning(motion));
    format!("{label}{by_stop}: {meaning}{stable}\n")
}

/// The motion of a machine, and its nearest events in each number.
pub(crate) fn of_machine(found: &MachineMargins, machine: &Machine) -> String {
    let mut text = head(machine, &found.motion, found.motion.stability(machine));
    if found.numbers.is_empty() {
        text.push_str("  it is no single periodic motion, so it has no branch to follow and no margins\n");
        return text;
    }
    let row = |number: &NumberMargin, (way, limit, event): (&str, f64, Option<&NumberEvent>)| {
        let begin = [number.path.clone(), short(number.value), way.to_owned()];
        let told = event.and_then(|event| Some((event, event.point.event?)));
        let ends = told.map_or_else(
            || [String::new(), String::new(), String::new(), format!("none up to {}", short(limit))],
            |(event, kind)| {
                let distance = event.point.value - number.value;
                let relative = 100.0 * distance / number.scale();
                let before = event.point.cycle.label.to_string();
                let beyond = event.after.as_ref().filter(|after| **after != before);
                let beyond = beyond.map_or_else(String::new, |after| format!(" to {after}"));
                let of = kind.place().map_or_else(String::new, |place| format!(": {}", machine.name_of(place)));
                let words = format!("{}{beyond}{of}", kind.name());
                [precise(event.point.value), short(distance), format!("{relative:+.2} %"), words]
            },
        );
        begin.into_iter().chain(ends).collect::<Vec<String>>()
    };
    let rows: Vec<Vec<String>> =
        found.numbers.iter().flat_map(|number| number.ends().map(|end| row(number, end))).collect();
    text.push_str(&table(&HEADS.map(str::to_owned), &rows));
    if let Some((number, way, scaled)) = found.nearest() {
        let _ = writeln!(text, "  nearest: {way} in {}, by {} of its value", number.path, percent(scaled));
    }
    text
}

/// The columns of the events.
const HEADS: [&str; 7] = ["<parameter", "value", "<way", "event at", "distance", "relative", "<event"];

/// What a box is measured in: the values of the parameters, or other scales.
fn whole(parameters: &[ParameterMargin]) -> &'static str {
    let usual = parameters.iter().all(|margin| margin.scope.scale == margin.scope.value.abs());
    if usual { "its value" } else { "its scale" }
}

/// One row for each parameter and direction.
fn events(parameters: &[ParameterMargin], units: &Units) -> String {
    let heads = HEADS.map(str::to_owned);
    let rows: Vec<Vec<String>> = parameters
        .iter()
        .flat_map(|margin| {
            let scope = &margin.scope;
            let [down, up] = [("down", &margin.down, scope.low), ("up", &margin.up, scope.high)];
            [row(margin, down, units), row(margin, up, units)]
        })
        .collect();
    table(&heads, &rows)
}

fn row(margin: &ParameterMargin, (way, end, limit): (&str, &MarginEnd, f64), units: &Units) -> Vec<String> {
    let (scope, unit) = (&margin.scope, units.of(margin.scope.parameter));
    let begin = [scope.parameter.words(units), short(scope.value * unit), way.to_owned()];
    let (at, distance, relative, event) = match (&end.point, end.event()) {
        (Some(point), Some(event)) => {
            let relative = end.relative(scope).map_or_else(String::new, |share| format!("{:+.2} %", 100.0 * share));
            (precise(end.value * unit), short(end.distance(scope) * unit), relative, told(point, &event))
        }
        _ => (String::new(), String::new(), String::new(), format!("none up to {}", short(limit * unit))),
    };
    begin.into_iter().chain([at, distance, relative, event]).collect()
}

/// The name of an event, the motion beyond, and its meaning.
fn told(point: &SolutionPoint, event: &BranchEvent) -> String {
    let record = EventRecord::of(point, event);
    let beyond = match record.label_after {
        Some(after) if after != record.label_before => format!(" to {after}"),
        _ => String::new(),
    };
    let why = remark(point, event);
    let why = if why.is_empty() { why } else { format!(": {why}") };
    format!("{}{beyond}{why}", event.name())
}

/// The box, and where the motion was lost next to it.
fn of_box(found: &MotionBox, parameters: &[ParameterMargin], label: &str, units: &Units) -> String {
    let mut text = format!(
        "\nbox: each parameter within {} of {}; {label} was found by trying {} on {}, not proved\n",
        percent(found.size),
        whole(parameters),
        counted(found.points, "point"),
        counted(found.lines, "line")
    );
    let heads = ["<parameter", "from", "to", "scale"].map(str::to_owned);
    let rows: Vec<Vec<String>> = parameters
        .iter()
        .map(|margin| {
            let (scope, unit) = (&margin.scope, units.of(margin.scope.parameter));
            let ends = [scope.at(-found.size), scope.at(found.size), scope.scale].map(|value| short(value * unit));
            core::iter::once(scope.parameter.words(units)).chain(ends).collect()
        })
        .collect();
    text.push_str(&table(&heads, &rows));
    let Some(edge) = &found.edge else {
        text.push_str("  it ends at the end of a range\n");
        return text;
    };
    let values: Vec<String> = parameters
        .iter()
        .zip(&edge.values)
        .map(|(margin, value)| {
            let parameter = margin.scope.parameter;
            format!("{} {}", parameter.words(units), short(value * units.of(parameter)))
        })
        .collect();
    let _ = writeln!(text, "  next to it, at {}: {}", values.join(", "), lost(edge.loss, label));
    text
}

/// Why a motion was not found.
fn lost(loss: Loss, label: &str) -> String {
    match loss {
        Loss::NoSystem => "the two stops leave no room".to_owned(),
        Loss::NoSolution => format!("no {label} was found close by"),
        Loss::Inadmissible => format!("{label} passes through a stop, or loses an impact"),
        Loss::Unstable => format!("{label} is unstable"),
        Loss::Shorter => format!("{label} becomes a motion of a shorter period"),
        Loss::OtherMotion => "another motion follows the release".to_owned(),
    }
}
