//! The attractors to which scattered starts lead, and their shares.

use super::Document;
use super::certainty::Certainty;
use super::motion::{MotionObject, SharedMotion};
use crate::Asked;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{Census, StartBox};
use vibroimpact_study::Plan;

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

/// The object of `vibro attractors`, for a number of starts of a sequence in the natural box of the system.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &Oscillator,
    (starts, seed): (u64, u64),
    census: &Census,
) -> impl Serialize + use<'a> {
    let (units, area) = (&asked.units, StartBox::natural(osc));
    let scaled = |(a, b): (f64, f64), unit: f64| (a * unit, b * unit);
    let shared = census.by_share().into_iter().map(|found| SharedMotion {
        motion: MotionObject::of_oscillator(&found.verdict, osc, units),
        share: census.share(found),
        starts: found.count,
    });
    let area = Area { x: scaled(area.x, units.length()), v: scaled(area.v, units.velocity()), phase: area.phase };
    let certainty = Certainty::of(census.by_share().into_iter().map(|found| found.count), census.total());
    Document::new(
        asked,
        osc,
        plan,
        AttractorsAnswer { motions: shared.collect(), certainty, starts, seed, area: Some(area) },
    )
}

impl<'a> AttractorsAnswer<'a> {
    pub(super) fn of_machine(machine: &'a Machine, seed: u64, census: &'a Census<Machine>) -> Self {
        let shared = census.by_share().into_iter().map(|found| SharedMotion {
            motion: MotionObject::of_machine(machine, &found.verdict),
            share: census.share(found),
            starts: found.count,
        });
        let certainty = Certainty::of(census.by_share().into_iter().map(|found| found.count), census.total());
        Self { motions: shared.collect(), certainty, starts: census.total(), seed, area: None }
    }
}
