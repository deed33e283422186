//! The attractors to which scattered starts lead, and their shares.

use super::certainty::Certainty;
use super::motion::{MotionObject, SharedMotion};
use crate::Units;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Census, StartBox, System, Verdict};

/// The answer to `vibro attractors`.
#[derive(JsonSchema, Serialize)]
pub(super) struct AttractorsAnswer<'a> {
    motions: Vec<SharedMotion<'a>>,
    #[serde(flatten)]
    certainty: Certainty,
    starts: u64,
    seed: u64,
    /// The box of the starts of an oscillator.
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    area: Option<Area>,
}

/// The box of the starts.
#[derive(JsonSchema, Serialize)]
struct Area {
    x: (f64, f64),
    v: (f64, f64),
    phase: (f64, f64),
}

impl<'a> AttractorsAnswer<'a> {
    /// The motions of a sequence of starts in the natural box of an oscillator.
    pub(super) fn of_oscillator(osc: &Oscillator, seed: u64, census: &'a Census, units: &Units) -> Self {
        let area = StartBox::natural(osc);
        let scaled = |(a, b): (f64, f64), unit: f64| (a * unit, b * unit);
        let area = Area { x: scaled(area.x, units.length()), v: scaled(area.v, units.velocity()), phase: area.phase };
        let motion = |verdict| MotionObject::of_oscillator(verdict, osc, units);
        Self { area: Some(area), ..Self::new(census, seed, motion) }
    }

    /// Those of a machine.
    pub(super) fn of_machine(machine: &'a Machine, seed: u64, census: &'a Census<Machine>) -> Self {
        Self::new(census, seed, |verdict| MotionObject::of_machine(machine, verdict))
    }

    fn new<S: System>(census: &'a Census<S>, seed: u64, motion: impl Fn(&'a Verdict<S>) -> MotionObject<'a>) -> Self {
        let shared = census.by_share().into_iter().map(|found| SharedMotion {
            motion: motion(&found.verdict),
            share: census.share(found),
            starts: found.count,
        });
        let certainty = Certainty::of(census.by_share().into_iter().map(|found| found.count), census.total());
        Self { motions: shared.collect(), certainty, starts: census.total(), seed, area: None }
    }
}
