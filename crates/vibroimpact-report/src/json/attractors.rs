//! The attractors to which scattered starts lead, and their shares.

use super::Document;
use super::certainty::Certainty;
use super::motion::{MotionObject, SharedMotion};
use crate::Asked;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::verdict::{Census, StartBox};
use vibroimpact_study::Plan;

/// The fields of `vibro attractors`.
#[derive(Serialize)]
struct AttractorsFields<'a> {
    motions: Vec<SharedMotion<'a>>,
    #[serde(flatten)]
    certainty: Certainty,
    starts: u64,
    seed: u64,
    #[serde(rename = "box")]
    area: Area,
}

/// The box of the starts.
#[derive(Serialize)]
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
    Document::new(asked, osc, plan, AttractorsFields { motions: shared.collect(), certainty, starts, seed, area })
}
