//! Curves of events in a plane of two parameters as text.

use crate::report::branch::{chosen, named};
use crate::report::words::table;
use std::fmt::Write;
use vibroimpact::Parameter;
use vibroimpact_report::Units;
use vibroimpact_report::json::curve::values;
use vibroimpact_report::number::{precise, short};
use vibroimpact_study::{CurvePlan, EventCurve, Stretch, counted};

/// The description of a curve, and the events on it from one end to the other.
pub(crate) fn text(found: &EventCurve, plan: &CurvePlan, units: &Units) -> String {
    let name = |parameter: Parameter| named(parameter, units);
    let over = |stretch: &Stretch| {
        let unit = units.of(stretch.parameter);
        format!("{} from {} to {}", name(stretch.parameter), short(stretch.from * unit), short(stretch.to * unit))
    };
    let (p, kind) = (plan.vary.parameter, plan.kind.name());
    let mut text =
        format!("{kind} of {} ({})\n", plan.label.as_deref().unwrap_or_default().trim(), chosen(&found.chosen));
    let found_at: Vec<String> = found.events.iter().map(|event| precise(event.value * units.of(p))).collect();
    let which =
        if found_at.len() > 1 { format!(", the curve is that of number {}", found.through + 1) } else { String::new() };
    let _ = writeln!(text, "  found at {} {}{which}", name(p), found_at.join(", "));
    let _ = writeln!(
        text,
        "  followed over {}, {}: {}",
        over(&plan.vary),
        over(&plan.and),
        counted(found.points.len() as u64, "point")
    );
    let heads = ["<event".to_owned(), name(p), name(plan.and.parameter), "<motion".into()];
    let all = &found.points;
    let rows: Vec<Vec<String>> = all
        .iter()
        .enumerate()
        .filter_map(|(k, point)| {
            let [p, q] = values(point, plan, units);
            // at an event itself rounding decides, so the neighbouring points are used
            let beside = [k.checked_sub(1).and_then(|k| all.get(k)), all.get(k + 1)];
            let physical = point.physical || beside.into_iter().flatten().any(|point| point.physical);
            let motion =
                if physical { plan.label.as_deref().unwrap_or_default().trim() } else { "inadmissible" }.to_owned();
            Some(vec![point.event?.name().into(), precise(p), precise(q), motion])
        })
        .collect();
    text + &table(&heads, &rows)
}
