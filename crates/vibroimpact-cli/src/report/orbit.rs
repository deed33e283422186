//! The orbits with a label as text: admissible ones and inadmissible solutions of the equations.

use crate::report::motion::Teller;
use crate::report::words::{by_stop, impacts, multipliers, stop_name};
use vibroimpact::Label;
use vibroimpact::verdict::Verdict;
use vibroimpact_report::AnswerOf;
use vibroimpact_report::number::short;
use vibroimpact_study::{CycleOf, Orbit, SystemPlan, Task};

/// The text of all orbits of a label, with their numbers if there are several.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, orbits: &[Orbit<CycleOf<D>>]) -> String {
    let count = orbits.len();
    if count == 0 {
        let label = if let Task::Orbit { label } = &of.plan.task { label.trim() } else { "" };
        let label = label.parse().map_or_else(|_| label.to_owned(), |label: Label| label.to_string());
        return format!("no orbit {label} was found\n{}", D::orbit_text(of, None));
    }
    let one = |(k, orbit): (usize, &Orbit<CycleOf<D>>)| {
        let text = D::orbit_text(of, Some(orbit));
        if count > 1 { format!("orbit {} of {count}\n{text}", k + 1) } else { text }
    };
    orbits.iter().enumerate().map(one).collect::<Vec<_>>().join("\n")
}

/// The text of an orbit of an oscillator; without one why there may be none.
pub(super) fn of_oscillator(of: &AnswerOf<SystemPlan>, orbit: Option<&Orbit>) -> String {
    let (osc, units) = (&of.system, &of.units);
    let Some(orbit) = orbit else {
        let free = matches!(&of.plan.task, Task::Orbit { label } if label.parse() == Ok(Label::new(0, 1)));
        let why = "without damping, motions without impacts are no single cycle: `vibro settle` finds them\n";
        return if free { why } else { "" }.to_owned();
    };
    if orbit.admissible {
        return SystemPlan::told(of, &Verdict::Periodic(orbit.cycle.clone()));
    }
    let cycle = &orbit.cycle;
    let by_stop = by_stop(&Verdict::Periodic(cycle.clone()), osc);
    let mut text = format!("{}{by_stop}: inadmissible, it passes through a stop on its way\n", cycle.label);
    text.push_str(&impacts(cycle, osc, units));
    text.push_str(&format!("  multipliers {}\n", multipliers(&cycle.multipliers)));
    if let Some(contact) = &orbit.earlier {
        let unit = if units.si { " s" } else { "" };
        let (stop, time) = (stop_name(contact.side), short(contact.time * units.time()));
        let impact = contact.flight + 1;
        text.push_str(&match cycle.points.get(contact.flight) {
            None => format!("  it would swing through the {stop}, which it meets {time}{unit} after phase 0\n"),
            Some(point) if contact.time > 0.0 => format!(
                "  earlier contact: after impact {impact} it meets the {stop} at a time of {time}{unit}, not {}{unit}\n",
                short(point.interval * units.time())
            ),
            Some(_) => format!("  earlier contact: it does not leave the {stop} after impact {impact}\n"),
        });
    }
    text
}
