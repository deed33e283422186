//! Curves of events of machines as text.

use crate::report::words::table;
use core::fmt::Write;
use vibroimpact::machine::Machine;
use vibroimpact_report::number::{precise, short};
use vibroimpact_study::{MachineEventCurve, Name, Stretch, Task, Variable, counted};

/// The description of a curve, and the events on it from one end to the other.
pub(crate) fn text(machine: &Machine, task: &Task, found: &MachineEventCurve) -> String {
    let Task::Curve(plan) = task else { return String::new() };
    let over = |stretch: &Stretch<Variable>| {
        format!("{} from {} to {}", stretch.parameter.text(), short(stretch.from), short(stretch.to))
    };
    let mut text = format!("{} of {}\n", found.kind.name(), found.label);
    let found_at: Vec<String> = found.events.iter().map(|event| precise(event.value)).collect();
    let which =
        if found_at.len() > 1 { format!(", the curve is that of number {}", found.through + 1) } else { String::new() };
    let _ = writeln!(text, "  found at {} {}{which}", plan.vary.parameter.text(), found_at.join(", "));
    let points = counted(found.points.len() as u64, "point");
    let _ = writeln!(text, "  followed over {}, {}: {points}", over(&plan.vary), over(&plan.and));
    let heads = [
        "<event".to_owned(),
        plan.vary.parameter.text().to_owned(),
        plan.and.parameter.text().to_owned(),
        "<motion".into(),
    ];
    let rows: Vec<Vec<String>> = found
        .points
        .iter()
        .filter_map(|point| {
            let event = point.event?;
            let at = event.place().map_or_else(String::new, |place| format!(" at {}", machine.name_of(place)));
            let (p, q) = point.values;
            Some(vec![format!("{}{at}", event.name()), precise(p), precise(q), point.cycle.label.to_string()])
        })
        .collect();
    text + &table(&heads, &rows)
}
