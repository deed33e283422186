//! The nearest events of a motion as text, and the box of parameters in which it was found.

use crate::report::branch::because;
use crate::report::motion::{InUnits, Teller};
use crate::report::words::table;
use std::fmt::Write;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Stability, Verdict};
use vibroimpact_report::json::margins::{EndObject, ParameterObject, machine_margins, margins, nearest};
use vibroimpact_report::number::{percent, precise, short};
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{Loss, MachineMargins, MotionBox, MotionMargins, ParameterMargin, counted};

/// The motion, its nearest events in each parameter, and its box.
pub(crate) fn text(found: &MotionMargins, osc: &Oscillator, units: &Units) -> String {
    let (label, stability) = (found.motion.label(), found.motion.stability(osc));
    let head = head(&InUnits(osc, units), &found.motion, stability);
    if found.parameters.is_empty() {
        return head + NONE;
    }
    let text = head + &events(&margins(found, units));
    text + &match &found.motion_box {
        Some(found_box) => of_box(found_box, &found.parameters, &label, units),
        None => format!("\nno box: the motion is {}\n", stability.map_or("undecided", |stability| stability.name())),
    }
}

/// The motion of a machine, and its nearest events in each number.
pub(crate) fn of_machine(found: &MachineMargins, machine: &Machine) -> String {
    let head = head(machine, &found.motion, found.motion.stability(machine));
    if found.numbers.is_empty() { head + NONE } else { head + &events(&machine_margins(found, machine)) }
}

const NONE: &str = "  it is no single periodic motion, so it has no branch to follow and no margins\n";

fn head<T: Teller>(teller: &T, motion: &Verdict<T::System>, stability: Option<Stability>) -> String {
    let stable = stability.map_or_else(String::new, |stability| format!(", {stability}"));
    let (label, by_stop, meaning) = (motion.label(), teller.by_stop(motion), teller.meaning(motion));
    format!("{label}{by_stop}: {meaning}{stable}\n")
}

/// What a change is measured in: the value of the number, or another scale.
const fn whole(usual: bool) -> &'static str {
    if usual { "its value" } else { "its scale" }
}

/// One row for each number and direction, and the nearest event.
fn events(all: &[ParameterObject<'_>]) -> String {
    let heads = ["<parameter", "value", "<way", "event at", "distance", "relative", "<event"].map(str::to_owned);
    let rows = all.iter().flat_map(|of| of.ends().map(|(way, end)| row(of, way, end)));
    let mut text = table(&heads, &rows.collect::<Vec<_>>());
    if let Some((of, way, EndObject { at: Some(at), event: Some(event), scaled, .. })) = nearest(all) {
        let (name, at, change) = (&of.words, precise(*at), percent(*scaled));
        let whole = whole(of.scale == of.value.abs());
        let _ = writeln!(text, "  nearest: {} at {name} {at}, {way} by {change} of {whole}", event.kind);
    }
    text
}

fn row(of: &ParameterObject<'_>, way: &str, end: &EndObject<'_>) -> Vec<String> {
    let ends = match &end.event {
        Some(event) => {
            let text = |value: Option<f64>, text: &dyn Fn(f64) -> String| value.map_or_else(String::new, text);
            let (before, after) = (&event.fields.before, event.fields.after.as_ref());
            let beyond = after.filter(|after| *after != before);
            let beyond = beyond.map_or_else(String::new, |after| format!(" to {after}"));
            [
                text(end.at, &precise),
                text(end.distance, &short),
                text(end.relative, &|share| format!("{:+.2} %", 100.0 * share)),
                format!("{}{beyond}{}", event.kind, because(&event.event)),
            ]
        }
        None => [String::new(), String::new(), String::new(), format!("none up to {}", short(end.limit))],
    };
    [of.words.clone(), short(of.value), way.to_owned()].into_iter().chain(ends).collect()
}

/// The box, and where the motion was lost next to it.
fn of_box(found: &MotionBox, parameters: &[ParameterMargin], label: &str, units: &Units) -> String {
    let mut text = format!(
        "\nbox: each parameter within {} of {}; {label} was found by trying {} on {}, not proved\n",
        percent(found.size),
        whole(parameters.iter().all(|margin| margin.scope.scale == margin.scope.value.abs())),
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
