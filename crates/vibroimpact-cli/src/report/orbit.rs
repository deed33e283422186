//! The orbits with a label as text: admissible ones and inadmissible solutions of the equations.

use crate::report::motion::{InUnits, Teller};
use crate::report::words::{by_stop, impacts, multipliers, stop_name};
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{Orbit, machine::Cycle};
use vibroimpact::verdict::Verdict;
use vibroimpact::{Label, Oscillator};
use vibroimpact_report::Units;
use vibroimpact_report::number::short;

/// The text of all orbits of a label.
pub(crate) fn text(orbits: &[Orbit], label: &str, osc: &Oscillator, units: &Units) -> String {
    if orbits.is_empty() {
        // the label has been parsed before, so this does not fail
        let label = label.parse().unwrap_or(Label::new(0, 1));
        let mut text = none(label);
        if label == Label::new(0, 1) {
            text.push_str("without damping, motions without impacts are no single cycle: `vibro settle` finds them\n");
        }
        return text;
    }
    numbered(orbits.iter().map(|orbit| one(orbit, osc, units)))
}

/// The same of a machine.
pub(crate) fn of_machine(cycles: &[Cycle], label: &str, machine: &Machine) -> String {
    if cycles.is_empty() {
        return none(label.trim());
    }
    numbered(cycles.iter().map(|cycle| machine.motion(&Verdict::Periodic(cycle.clone()))))
}

fn none(label: impl core::fmt::Display) -> String {
    format!("no orbit {label} was found\n")
}

/// The texts of orbits, with their numbers if there are several.
fn numbered(orbits: impl ExactSizeIterator<Item = String>) -> String {
    let count = orbits.len();
    let one = |(k, text): (usize, String)| {
        if count > 1 { format!("orbit {} of {count}\n{text}", k + 1) } else { text }
    };
    orbits.enumerate().map(one).collect::<Vec<_>>().join("\n")
}

/// The text of one orbit.
fn one(orbit: &Orbit, osc: &Oscillator, units: &Units) -> String {
    if orbit.physical {
        return InUnits(osc, units).motion(&Verdict::Periodic(orbit.cycle.clone()));
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
