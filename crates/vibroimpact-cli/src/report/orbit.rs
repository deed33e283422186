//! An orbit that was looked for: a motion, or a solution of the equations that is none.

use crate::args::Units;
use crate::report::json::{Motion, side};
use crate::report::text::{impacts, motion, multipliers, short, stop_name};
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::orbit::{EarlierContact, Orbit};
use vibroimpact::verdict::Verdict;

/// One of `"orbits"`.
#[derive(Serialize)]
pub(crate) struct OrbitObject {
    #[serde(flatten)]
    motion: Motion,
    physical: bool,
    earlier_contact: Option<ContactObject>,
}

#[derive(Serialize)]
struct ContactObject {
    /// Counted from 1; none where the motion has no impacts.
    after_impact: Option<usize>,
    side: &'static str,
    /// Since that impact, or since phase 0.
    time: f64,
}

impl OrbitObject {
    pub(crate) fn new(orbit: Orbit, osc: &Oscillator, units: &Units) -> Self {
        let earlier = |contact: EarlierContact| ContactObject {
            after_impact: (!orbit.cycle.points.is_empty()).then_some(contact.flight + 1),
            side: side(contact.side),
            time: contact.time * units.time(),
        };
        Self {
            physical: orbit.physical,
            earlier_contact: orbit.earlier.map(earlier),
            motion: Motion::new(&Verdict::Periodic(orbit.cycle), osc, units),
        }
    }
}

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
