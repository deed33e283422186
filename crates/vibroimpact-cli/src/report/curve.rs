//! Curves of events in a plane of two parameters as text.

use crate::report::branch::chosen;
use crate::report::diagram::over;
use crate::report::words::table;
use vibroimpact_report::json::curve::{CurveAnswer, CurveEventObject};
use vibroimpact_report::number::precise;
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{CurvePlan, counted};

/// The description of a curve, and the events on it from one end to the other.
pub(crate) fn text<V: Varied>(answer: &CurveAnswer<'_>, (plan, units): (&CurvePlan<V>, &Units)) -> String {
    let [p, q] = [&plan.vary, &plan.and].map(|side| side.parameter.words(units));
    let at: Vec<String> = answer.found_at.iter().map(|value| precise(*value)).collect();
    let which =
        if at.len() > 1 { format!(", the curve is that of number {}", answer.through.event) } else { String::new() };
    let text = format!(
        "{} of {} ({})\n  found at {p} {}{which}\n  followed over {}, {}: {}\n",
        plan.kind.name(),
        answer.label,
        chosen(answer.orbit, answer.stability),
        at.join(", "),
        over(&plan.vary, units),
        over(&plan.and, units),
        counted(answer.points.len() as u64, "point")
    );
    let rows: Vec<Vec<String>> = answer.events.iter().map(|event| row(answer, event)).collect();
    text + &table(&["<event".to_owned(), p, q, "<motion".into()], &rows)
}

fn row(answer: &CurveAnswer<'_>, event: &CurveEventObject<'_>) -> Vec<String> {
    let CurveEventObject { kind, values: [p, q], point, stop, also } = *event;
    let mut at = stop.map_or_else(String::new, |stop| format!(" at {stop}"));
    if let Some(other) = also {
        at += &format!(" and {other}");
    }
    // at an event itself rounding decides, so the neighbouring points are used
    let around = &answer.points[point.saturating_sub(1)..answer.points.len().min(point + 2)];
    let admissible = around.iter().any(|point| point.admissible);
    let motion = if admissible { &answer.points[point].label } else { "inadmissible" };
    vec![format!("{kind}{at}"), precise(p), precise(q), motion.to_owned()]
}
