//! What a store keeps of a motion: that of an oscillator, or that of a machine.

use crate::Unit;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{System, Verdict};

/// A system whose verdicts can be stored.
pub(crate) trait Stored: System {
    /// The units of velocity and time.
    const UNITS: [Unit; 2];

    /// What the tables of numbered motions contain; `None` for a motion that its label names: all but cycles, and rests of a
    /// machine that has several stops.
    fn stored_cycle(motion: &Verdict<Self>) -> Option<StoredCycle>;
}

/// A cycle, or a rest, in the tables of a study.
pub(crate) struct StoredCycle {
    /// The label m/n.
    pub(super) label: String,
    /// The stops that stay closed for ever, by their numbers from 0.
    pub(super) stops: Vec<usize>,
    /// The largest modulus of the multipliers; not-a-number for a rest.
    pub(super) multiplier: f64,
    /// For each impact, or each event of a machine, the phase, the speed of arrival, and the time to the next one.
    pub(super) points: Vec<[f64; 3]>,
}

impl Stored for Oscillator {
    const UNITS: [Unit; 2] = [Unit::VELOCITY, Unit::TIME];

    fn stored_cycle(motion: &Verdict) -> Option<StoredCycle> {
        let Verdict::Periodic(cycle) = motion else { return None };
        let [a, b] = cycle.multipliers;
        Some(StoredCycle {
            label: cycle.label.to_string(),
            stops: Vec::new(),
            multiplier: a.modulus().max(b.modulus()),
            points: cycle.points.iter().map(|p| [p.state.phase, p.state.velocity, p.interval]).collect(),
        })
    }
}

impl Stored for Machine {
    const UNITS: [Unit; 2] = [Unit::CONSISTENT; 2];

    fn stored_cycle(motion: &Verdict<Self>) -> Option<StoredCycle> {
        let Verdict::Periodic(cycle) = motion else {
            let rest = |stops| StoredCycle {
                label: motion.label().into_owned(),
                stops,
                multiplier: f64::NAN,
                points: Vec::new(),
            };
            return Some(motion.closed()).filter(|stops| !stops.is_empty()).map(rest);
        };
        let ends = cycle.events.iter().skip(1).map(|event| event.time).chain([cycle.period]);
        let points = cycle.events.iter().zip(ends).map(|(event, next)| [event.phase, event.speed, next - event.time]);
        Some(StoredCycle {
            label: cycle.label.to_string(),
            stops: Vec::new(),
            multiplier: cycle.multipliers.iter().map(|one| one.modulus()).fold(0.0, f64::max),
            points: points.collect(),
        })
    }
}
