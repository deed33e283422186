//! Curves of events in a plane of two parameters as text.

use crate::report::branch::chosen;
use crate::report::diagram::over;
use crate::report::words::table;
use vibroimpact_report::Varied;
use vibroimpact_report::number::precise;
use vibroimpact_report::solutions::{CurvePointView, CurveView};
use vibroimpact_study::counted;

/// The description of a curve, and the events on it from one end to the other.
pub(crate) fn text<V: Varied>(view: &CurveView<'_, V>) -> String {
    let [p, q] = view.sides().map(|side| side.parameter.words(&view.units));
    let at: Vec<String> = view.found_at.iter().map(|value| precise(*value)).collect();
    let which =
        if at.len() > 1 { format!(", the curve is that of number {}", view.through + 1) } else { String::new() };
    let [across, up] = view.sides().map(|side| over(side, &view.units));
    let text = format!(
        "{} of {} ({})\n  found at {p} {}{which}\n  followed over {across}, {up}: {}\n",
        view.plan.kind.name(),
        view.label,
        chosen(view.number, view.stability),
        at.join(", "),
        counted(view.points.len() as u64, "point")
    );
    let rows: Vec<Vec<String>> = (0..view.points.len()).filter_map(|k| row(view, k)).collect();
    text + &table(&["<event".to_owned(), p, q, "<motion".into()], &rows)
}

/// The row of point number `k`, if it is an event.
fn row<V>(view: &CurveView<'_, V>, k: usize) -> Option<Vec<String>> {
    let all = &view.points;
    let CurvePointView { event, values: [p, q], cycle, .. } = &all[k];
    let (name, stop) = (*event)?;
    let at = stop.map_or_else(String::new, |stop| format!(" at {stop}"));
    // at an event itself rounding decides, so the neighbouring points are used
    let around = all.get(k.saturating_sub(1)..all.len().min(k + 2))?;
    let admissible = around.iter().any(|point| point.admissible);
    // on a curve of an oscillator the cycle may have an impact without speed, which its label does not count
    let label = if view.machine.is_some() { cycle.label() } else { view.label };
    let motion = if admissible { label.to_string() } else { "inadmissible".to_owned() };
    Some(vec![format!("{name}{at}"), precise(*p), precise(*q), motion])
}
