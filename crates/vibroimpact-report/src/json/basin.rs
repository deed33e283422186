//! The motions of a basin and their shares of its starts.

use super::certainty::Certainty;
use super::motion::{MotionObject, SharedMotion};
use super::{AxisObject, Document};
use crate::{Asked, Units};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::machine::Machine;
use vibroimpact::math::sort_by_key;
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{Basin, MachineBasin, Plan, StartPlan};

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
    let order = by_count(found);
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, motion)| places[*motion] = place);
    let StartPlan { x, v, phase } = task.start();
    let start = Start { x: x.unwrap_or_else(|| Start::at_rest(osc).x), v, phase };
    let shared = order.into_iter().map(|m| SharedMotion {
        motion: MotionObject::of_oscillator(&found.motions[m].verdict, osc, units),
        share: found.share(m),
        starts: found.motions[m].count,
    });
    let answer = BasinAnswer {
        motions: shared.collect(),
        starts: found.cells.len(),
        axes: AxisObject::all(&task.axes, units),
        // refused with the plan
        refused: 0,
        cells: found.cells.iter().map(|motion| Some(places[usize::from(*motion)])).collect(),
        measures: MeasureFields::of(found),
    };
    Document::new(asked, osc, plan, answer).start(&start, units)
}

impl<'a> BasinAnswer<'a> {
    pub(super) fn of_machine(machine: &'a Machine, found: &'a MachineBasin) -> Self {
        let motions = found.motions.iter().zip(found.shares()).map(|(verdict, (starts, share))| SharedMotion {
            motion: MotionObject::of_machine(machine, verdict),
            share,
            starts,
        });
        Self {
            motions: motions.collect(),
            starts: found.cells.len(),
            axes: AxisObject::all(&found.axes, &Units::default()),
            refused: found.refused(),
            cells: found.cells.clone(),
            measures: None,
        }
    }
}

/// The indices of the motions in order of falling numbers of starts.
#[must_use]
pub fn by_count(found: &Basin) -> Vec<usize> {
    let mut order: Vec<usize> = (0..found.motions.len()).collect();
    sort_by_key(&mut order, |m| core::cmp::Reverse(found.motions[*m].count));
    order
}
