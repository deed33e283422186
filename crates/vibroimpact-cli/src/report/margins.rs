//! The nearest events of a motion as text, and the box of parameters in which it was found.

use crate::report::motion::Teller;
use crate::report::words::table;
use std::fmt::Write;
use vibroimpact::Oscillator;
use vibroimpact_report::number::{percent, precise, short};
use vibroimpact_report::{AnswerOf, Units, Varied};
use vibroimpact_study::{Loss, MarginEnd, MotionBox, MotionMargins, ParameterMargin, PointOf, Solution, counted};

/// The motion, its nearest events in each number, and what is told beside them.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &MotionMargins<D::System, D::Name, PointOf<D>>) -> String {
    let (units, why) = (&of.units, |point: &PointOf<D>| D::because(of, point));
    let stability = found.motion.stability(&of.system);
    let stable = stability.map_or_else(String::new, |stability| format!(", {stability}"));
    let (by_stop, meaning) = (D::by_stop(of, &found.motion), D::meaning(of, &found.motion));
    let mut text = format!("{}{by_stop}: {meaning}{stable}\n", found.motion.label());
    if found.parameters.is_empty() {
        text.push_str("  it is no single periodic motion, so it has no branch to follow and no margins\n");
        return text;
    }
    let rows: Vec<Vec<String>> =
        found.parameters.iter().flat_map(|margin| margin.ends().map(|end| row(margin, end, units, &why))).collect();
    text.push_str(&table(&HEADS.map(str::to_owned), &rows));
    if let Some((margin, way, end)) = found.nearest() {
        let _ = writeln!(
            text,
            "  nearest: {} at {} {}, {way} by {} of {}",
            end.point.as_ref().and_then(Solution::event_name).unwrap_or_default(),
            margin.scope.parameter.words(units),
            precise(end.value * margin.scope.parameter.unit(units)),
            percent(end.scaled(&margin.scope)),
            whole(core::slice::from_ref(margin))
        );
    }
    text + &D::of_margins(of, found)
}

/// The box of parameters of an oscillator.
pub(super) fn of_box(found: &MotionMargins, osc: &Oscillator, units: &Units) -> String {
    match &found.motion_box {
        Some(found_box) => told_box(found_box, &found.parameters, &found.motion.label(), units),
        None => {
            let stability = found.motion.stability(osc).map_or("undecided", |stability| stability.name());
            format!("\nno box: the motion is {stability}\n")
        }
    }
}

/// The columns of the events.
const HEADS: [&str; 7] = ["<parameter", "value", "<way", "event at", "distance", "relative", "<event"];

/// What a box is measured in: the values of the parameters, or other scales.
fn whole<V, P>(parameters: &[ParameterMargin<V, P>]) -> &'static str {
    let usual = parameters.iter().all(|margin| margin.scope.scale == margin.scope.value.abs());
    if usual { "its value" } else { "its scale" }
}

/// The nearest event of a number in one direction.
fn row<V: Varied, P: Solution>(
    margin: &ParameterMargin<V, P>,
    (way, limit, end): (&str, f64, &MarginEnd<P>),
    units: &Units,
    why: &impl Fn(&P) -> String,
) -> Vec<String> {
    let (scope, unit) = (&margin.scope, margin.scope.parameter.unit(units));
    let begin = [scope.parameter.words(units), short(scope.value * unit), way.to_owned()];
    let ends = match end.point.as_ref().and_then(|point| Some((point, point.event_name()?))) {
        Some((point, name)) => {
            let relative = end.relative(scope).map_or_else(String::new, |share| format!("{:+.2} %", 100.0 * share));
            let before = point.label();
            let beyond = end.after.as_ref().filter(|after| **after != before);
            let beyond = beyond.map_or_else(String::new, |after| format!(" to {after}"));
            let event = format!("{name}{beyond}{}", why(point));
            [precise(end.value * unit), short(end.distance(scope) * unit), relative, event]
        }
        None => [String::new(), String::new(), String::new(), format!("none up to {}", short(limit * unit))],
    };
    begin.into_iter().chain(ends).collect()
}

/// The box, and where the motion was lost next to it.
fn told_box(found: &MotionBox, parameters: &[ParameterMargin], label: &str, units: &Units) -> String {
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
