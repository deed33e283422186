//! The attractors to which scattered starts lead, and their shares.

use super::certainty::Certainty;
use super::motion::SharedMotion;
use crate::Units;
use crate::answer::{AnswerOf, Told};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::verdict::{Census, StartBox};

/// The answer to `vibro attractors`.
#[derive(JsonSchema, Serialize)]
pub(super) struct AttractorsAnswer<'a> {
    /// The motions, the most frequent first.
    motions: Vec<SharedMotion<'a>>,
    #[serde(flatten)]
    certainty: Certainty,
    /// The number of starts.
    starts: u64,
    /// The seed of their sequence.
    seed: u64,
    /// The box of the starts of an oscillator.
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    area: Option<Area>,
}

/// The box of scattered starts.
#[derive(JsonSchema, Serialize)]
pub struct Area {
    x: (f64, f64),
    v: (f64, f64),
    phase: (f64, f64),
}

impl Area {
    /// The natural box of an oscillator.
    pub(crate) fn natural(osc: &Oscillator, units: &Units) -> Self {
        let area = StartBox::natural(osc);
        let scaled = |(a, b): (f64, f64), unit: f64| (a * unit, b * unit);
        Self { x: scaled(area.x, units.length()), v: scaled(area.v, units.velocity()), phase: area.phase }
    }
}

impl<'a> AttractorsAnswer<'a> {
    /// The motions of a sequence of starts.
    pub(super) fn new<D: Told>(of: &'a AnswerOf<D>, census: &'a Census<D::System>, seed: u64) -> Self {
        let shared = census.by_share().into_iter().map(|found| SharedMotion {
            motion: D::motion(of, &found.verdict),
            share: census.share(found),
            starts: found.count,
        });
        let certainty = Certainty::of(census.by_share().into_iter().map(|found| found.count), census.total());
        Self { motions: shared.collect(), certainty, starts: census.total(), seed, area: D::area(of) }
    }
}
