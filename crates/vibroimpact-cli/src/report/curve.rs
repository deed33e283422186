//! Curves of events in a plane of two parameters as text.

use crate::report::branch::chosen;
use crate::report::diagram::over;
use crate::report::words::table;
use std::fmt::Write;
use vibroimpact::machine::Machine;
use vibroimpact_report::json::curve::values;
use vibroimpact_report::number::{precise, short};
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{CurvePlan, EventCurve, MachineEventCurve, Name, Stretch, Variable, counted};

/// A curve of any system, as it is told.
struct Told {
    head: String,
    /// The names of both parameters.
    names: [String; 2],
    /// Values of the first parameter at the events on the branch, and the number of that through which the curve passes.
    found_at: Vec<f64>,
    through: usize,
    /// The ranges in words, and the number of points.
    over: [String; 2],
    points: usize,
    /// The events on the curve, from one end to the other.
    rows: Vec<Vec<String>>,
}

impl Told {
    fn text(self) -> String {
        let [p, q] = &self.names;
        let found_at: Vec<String> = self.found_at.iter().map(|value| precise(*value)).collect();
        let several = found_at.len() > 1;
        let which = if several { format!(", the curve is that of number {}", self.through + 1) } else { String::new() };
        let mut text = format!("{}\n  found at {p} {}{which}\n", self.head, found_at.join(", "));
        let points = counted(self.points as u64, "point");
        let _ = writeln!(text, "  followed over {}: {points}", self.over.join(", "));
        let heads = ["<event".to_owned(), p.clone(), q.clone(), "<motion".into()];
        text + &table(&heads, &self.rows)
    }
}

/// The description of a curve, and the events on it from one end to the other.
pub(crate) fn text(found: &EventCurve, plan: &CurvePlan, units: &Units) -> String {
    let p = plan.vary.parameter;
    let all = &found.points;
    let rows = all
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
    let told = Told {
        head: format!(
            "{} of {} ({})",
            plan.kind.name(),
            plan.label.as_deref().unwrap_or_default().trim(),
            chosen(&found.chosen)
        ),
        names: [p.words(units), plan.and.parameter.words(units)],
        found_at: found.events.iter().map(|event| event.value * units.of(p)).collect(),
        through: found.through,
        over: [over(&plan.vary, units), over(&plan.and, units)],
        points: all.len(),
        rows,
    };
    told.text()
}

/// The same of a machine.
pub(crate) fn of_machine(found: &MachineEventCurve, plan: &CurvePlan<Variable>, machine: &Machine) -> String {
    let over = |stretch: &Stretch<Variable>| {
        format!("{} from {} to {}", stretch.parameter.text(), short(stretch.from), short(stretch.to))
    };
    let rows = found
        .points
        .iter()
        .filter_map(|point| {
            let event = point.event?;
            let at = event.place().map_or_else(String::new, |place| format!(" at {}", machine.name_of(place)));
            let (p, q) = point.values;
            Some(vec![format!("{}{at}", event.name()), precise(p), precise(q), point.cycle.label.to_string()])
        })
        .collect();
    // of the orbit at which the branch begins only the number is known
    let which = found.among.filter(|(_, count)| *count > 1);
    let which = which.map_or_else(String::new, |(number, count)| format!(" (orbit {number} of {count})"));
    let told = Told {
        head: format!("{} of {}{which}", found.kind.name(), found.label),
        names: [&plan.vary, &plan.and].map(|stretch| stretch.parameter.text().to_owned()),
        found_at: found.events.iter().map(|event| event.value).collect(),
        through: found.through,
        over: [over(&plan.vary), over(&plan.and)],
        points: found.points.len(),
        rows,
    };
    told.text()
}
