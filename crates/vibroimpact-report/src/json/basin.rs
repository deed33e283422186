//! The motions of a basin and their shares of its starts.

use super::certainty::Certainty;
use super::motion::{MotionFields, SharedMotion};
use super::{Document, Place};
use crate::Asked;
use serde::Serialize;
use vibroimpact::math::sort_by_key;
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{Basin, Coordinate, Plan};

/// The fields of `vibro basin`: the axes of the starts, and the values of coordinates on no axis.
#[derive(Serialize)]
struct BasinFields {
    x: Place,
    v: Place,
    phase: Place,
    motions: Vec<SharedMotion>,
    starts: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    measures: Option<MeasureFields>,
}

/// Measures of the basins in a plane.
#[derive(Serialize)]
struct MeasureFields {
    /// Side of the boxes of the entropies, in starts.
    box_side: usize,
    entropy: f64,
    boundary_entropy: Option<f64>,
    uncertainty_exponent: Option<ExponentFields>,
    /// The comparison of the boundaries of at least three basins.
    #[serde(skip_serializing_if = "Option::is_none")]
    merging: Option<MergingFields>,
    #[serde(flatten)]
    certainty: Certainty,
}

#[derive(Serialize)]
struct ExponentFields {
    value: f64,
    error: f64,
}

/// How far the boundaries of the basins are from each other, in starts, and whether they count as one.
#[derive(Serialize)]
struct MergingFields {
    motions: usize,
    radius: usize,
    limit: usize,
    common: f64,
    wada: bool,
}

impl MeasureFields {
    fn of(found: &Basin) -> Option<Self> {
        let measures = found.measures()?;
        let total = found.cells.len() as u64;
        Some(Self {
            box_side: measures.side,
            entropy: measures.entropy,
            boundary_entropy: measures.boundary_entropy,
            uncertainty_exponent: measures.uncertainty.map(|of| ExponentFields { value: of.value, error: of.error }),
            merging: measures.merging.map(|of| MergingFields {
                motions: of.motions,
                radius: of.radius,
                limit: of.limit,
                common: of.common,
                wada: of.wada(),
            }),
            certainty: Certainty::of(by_count(found).into_iter().map(|m| found.motions[m].count), total),
        })
    }
}

/// The object of `vibro basin`.
#[must_use]
pub fn document<'a>(asked: &Asked, plan: &'a Plan, osc: &Oscillator, found: &Basin) -> impl Serialize + use<'a> {
    let (units, task) = (&asked.units, &found.plan);
    let place = |vary: Coordinate, unit: f64, fixed: f64| {
        let axis = task.axes.iter().find(|axis| axis.vary == vary);
        axis.map_or(Place::At(fixed * unit), |axis| Place::over(&axis.over, unit))
    };
    let shared = by_count(found).into_iter().map(|m| SharedMotion {
        motion: MotionFields::new(&found.motions[m].verdict, osc, units),
        share: found.share(m),
        count: found.motions[m].count,
    });
    let answer = BasinFields {
        x: place(Coordinate::X, units.length(), task.start.x.unwrap_or_else(|| Start::at_rest(osc).x)),
        v: place(Coordinate::V, units.velocity(), task.start.v),
        phase: place(Coordinate::Phase, 1.0, task.start.phase),
        motions: shared.collect(),
        starts: found.cells.len(),
        measures: MeasureFields::of(found),
    };
    Document::new(asked, osc, plan, answer)
}

/// The indices of the motions in order of falling numbers of starts.
#[must_use]
pub fn by_count(found: &Basin) -> Vec<usize> {
    let mut order: Vec<usize> = (0..found.motions.len()).collect();
    sort_by_key(&mut order, |m| core::cmp::Reverse(found.motions[*m].count));
    order
}
