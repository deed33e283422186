//! Curves of events in a plane of two parameters as text.

use crate::report::branch::chosen;
use crate::report::diagram::over;
use crate::report::words::table;
use vibroimpact::continuation::machine::{CurvePoint, SolutionPoint};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact_report::json::curve::values;
use vibroimpact_report::number::precise;
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{CurvePlan, EventCurve, counted};

/// The description of a curve, and the events on it from one end to the other.
pub(crate) fn text(found: &EventCurve, plan: &CurvePlan, units: &Units) -> String {
    let all = &found.points;
    let label = plan.label.as_deref().unwrap_or_default().trim();
    let rows = all.iter().enumerate().filter_map(|(k, point)| {
        let [p, q] = values(point.values, plan, units);
        // at an event itself rounding decides, so the neighbouring points are used
        let beside = [k.checked_sub(1).and_then(|k| all.get(k)), all.get(k + 1)];
        let physical = point.physical || beside.into_iter().flatten().any(|point| point.physical);
        let motion = if physical { label } else { "inadmissible" }.to_owned();
        Some(vec![point.event?.name().into(), precise(p), precise(q), motion])
    });
    let at = found.events.iter().map(|event| event.value);
    curve_text(found, (plan, units), (label, at.collect()), &rows.collect::<Vec<_>>())
}

/// The same of a machine.
pub(crate) fn of_machine(
    found: &EventCurve<Cycle, SolutionPoint, CurvePoint>,
    plan: &CurvePlan<String>,
    machine: &Machine,
) -> String {
    let rows = found.points.iter().filter_map(|point| {
        let event = point.event?;
        let at = event.place().map_or_else(String::new, |place| format!(" at {}", machine.name_of(place)));
        let (p, q) = point.values;
        Some(vec![format!("{}{at}", event.name()), precise(p), precise(q), point.cycle.label.to_string()])
    });
    let (label, at) = (found.chosen.cycle.label.to_string(), found.events.iter().map(|event| event.value));
    curve_text(found, (plan, &Units::default()), (&label, at.collect()), &rows.collect::<Vec<_>>())
}

/// A curve of an orbit with this label, and the values of the first number at the events on its branch.
fn curve_text<C, E, P, V: Varied>(
    found: &EventCurve<C, E, P>,
    (plan, units): (&CurvePlan<V>, &Units),
    (label, at): (&str, Vec<f64>),
    rows: &[Vec<String>],
) -> String {
    let [p, q] = [&plan.vary, &plan.and].map(|stretch| stretch.parameter.words(units));
    let at: Vec<String> = at.into_iter().map(|value| precise(value * plan.vary.parameter.unit(units))).collect();
    let several = at.len() > 1;
    let which = if several { format!(", the curve is that of number {}", found.through + 1) } else { String::new() };
    let points = counted(found.points.len() as u64, "point");
    let text = format!(
        "{} of {label} ({})\n  found at {p} {}{which}\n  followed over {}, {}: {points}\n",
        plan.kind.name(),
        chosen(&found.chosen),
        at.join(", "),
        over(&plan.vary, units),
        over(&plan.and, units)
    );
    text + &table(&["<event".to_owned(), p, q, "<motion".into()], rows)
}
