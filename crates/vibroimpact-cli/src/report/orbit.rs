//! An orbit that was looked for in words: a motion, or a solution of the equations that is none.

use crate::report::text::{impacts, motion, multipliers, stop_name};
use vibroimpact::Oscillator;
use vibroimpact::orbit::Orbit;
use vibroimpact::verdict::Verdict;
use vibroimpact_report::Units;
use vibroimpact_report::number::short;

/// Everything about it.
pub(crate) fn text(orbit: Orbit, osc: &Oscillator, units: &Units) -> String {
    if orbit.physical {
        return motion(&Verdict::Periodic(orbit.cycle), osc, units);
    }
    let cycle = &orbit.cycle;
    let mut text = format!("{}: not physical, it passes through a stop on its way\n", cycle.label);
    text.push_str(&impacts(cycle, osc, units));
    text.push_str(&format!("  multipliers {}\n", multipliers(cycle.multipliers)));
    if let Some(contact) = orbit.earlier {
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
