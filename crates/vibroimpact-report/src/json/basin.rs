//! The motions of a basin and their shares of its starts.

use super::AxisObject;
use super::certainty::Certainty;
use super::motion::SharedMotion;
use crate::answer::{AnswerOf, BasinOf, Told};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact_study::Basin;
use vibroimpact_study::basin::BasinMeasures;

/// The answer to `vibro basin`. Coordinates on no axis are those of the start.
#[derive(JsonSchema, Serialize)]
pub(super) struct BasinAnswer<'a> {
    motions: Vec<SharedMotion<'a>>,
    starts: usize,
    axes: Vec<AxisObject>,
    /// Starts beyond a rigid stop.
    refused: usize,
    /// The number of the motion of each start, the first axis varying fastest; null beyond a rigid stop.
    cells: Vec<Option<usize>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    measures: Option<MeasureFields>,
}

/// Measures of the basins in a plane.
#[derive(JsonSchema, Serialize)]
pub struct MeasureFields {
    #[serde(flatten)]
    measures: Measures,
    #[serde(flatten)]
    certainty: Certainty,
}

/// Those that do not depend on the number of starts.
#[derive(JsonSchema, Serialize)]
pub struct Measures {
    /// Side of the boxes of the entropies, in starts.
    box_side: usize,
    entropy: f64,
    boundary_entropy: Option<f64>,
    uncertainty_exponent: Option<ExponentFields>,
    /// The comparison of the boundaries of at least three basins.
    #[serde(skip_serializing_if = "Option::is_none")]
    merging: Option<MergingFields>,
}

#[derive(JsonSchema, Serialize)]
struct ExponentFields {
    value: f64,
    error: f64,
}

/// How far the boundaries of the basins are from each other, in starts, and whether they count as one.
#[derive(JsonSchema, Serialize)]
struct MergingFields {
    motions: usize,
    radius: usize,
    limit: usize,
    common: f64,
    wada: bool,
}

impl From<BasinMeasures> for Measures {
    fn from(found: BasinMeasures) -> Self {
        Self {
            box_side: found.side,
            entropy: found.entropy,
            boundary_entropy: found.boundary_entropy,
            uncertainty_exponent: found.uncertainty.map(|of| ExponentFields { value: of.value, error: of.error }),
            merging: found.merging.map(|of| MergingFields {
                motions: of.motions,
                radius: of.radius,
                limit: of.limit,
                common: of.common,
                wada: of.wada(),
            }),
        }
    }
}

impl MeasureFields {
    pub(crate) fn of(found: &Basin) -> Option<Self> {
        let counts = found.by_count().into_iter().map(|m| found.motions[m].count);
        let certainty = Certainty::of(counts, found.cells.len() as u64);
        Some(Self { measures: found.measures()?.into(), certainty })
    }
}

impl<'a> BasinAnswer<'a> {
    /// The motions in order of falling numbers of starts.
    pub(super) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a BasinOf<D>) -> Self {
        let order = found.by_count();
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, motion)| places[*motion] = place);
        let shared = order.into_iter().map(|m| SharedMotion {
            motion: D::motion(of, &found.motions[m].verdict),
            share: found.share(m),
            starts: found.motions[m].count,
        });
        Self {
            motions: shared.collect(),
            starts: found.cells.len(),
            axes: AxisObject::all(&found.plan.axes, &of.units),
            refused: found.refused(),
            cells: (0..found.cells.len()).map(|k| found.motion(k).map(|number| places[number])).collect(),
            measures: D::measures(found),
        }
    }
}
