//! A summary of an orbit diagram: numbers of motions of each kind.

use super::{Pair, Place};
use crate::table::diagram::columns;
use crate::{ShownValue, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact_study::diagram::{Diagram, MotionKind, Sweep, SweepDirection};

/// The answer to `vibro diagram`.
#[derive(JsonSchema, Serialize)]
pub(super) struct DiagramAnswer {
    vary: String,
    over: Place,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Pair>,
    /// The columns of the table.
    columns: Vec<String>,
    sweeps: Vec<Counts>,
}

impl DiagramAnswer {
    pub(super) fn new<V: Varied, S: ShownValue>(found: &Diagram<V, S>, units: &Units) -> Self {
        let plan = &found.plan;
        Self {
            vary: plan.vary.field(units).to_owned(),
            over: Place::over(&plan.over, plan.vary.unit(units)),
            also: Pair::of(&plan.cut(), units),
            columns: columns(found, units),
            sweeps: counts(found),
        }
    }
}

/// Numbers of motions of each kind in a sweep, or in all scattered starts.
#[derive(Clone, Debug, Default, JsonSchema, Serialize)]
pub struct Counts {
    /// `up`, `down` or `scatter`.
    pub sweep: &'static str,
    /// Number of motions followed.
    pub motions: usize,
    /// Number of motions with impacts.
    pub impact: usize,
    /// Number of motions without further impacts.
    pub none: usize,
    /// Number of motions at rest on a stop for ever.
    pub stuck: usize,
    /// Number of motions whose search used up its steps.
    pub undecided: usize,
    /// Number of points to show.
    pub points: usize,
}

/// The counts, one for each sweep.
#[must_use]
pub fn counts<V, S>(found: &Diagram<V, S>) -> Vec<Counts> {
    let names: &[&str] = match found.plan.direction {
        SweepDirection::Up => &["up"],
        SweepDirection::Down => &["down"],
        SweepDirection::Both => &["up", "down"],
        SweepDirection::Scatter { .. } => &["scatter"],
    };
    let mut counts: Vec<Counts> = names.iter().map(|sweep| Counts { sweep, ..Counts::default() }).collect();
    for step in &found.steps {
        let row = usize::from(step.sweep == Sweep::Down && counts.len() > 1);
        let count = &mut counts[row];
        count.motions += 1;
        count.points += step.points.len();
        *match step.kind {
            MotionKind::Impacts => &mut count.impact,
            MotionKind::NoImpact => &mut count.none,
            MotionKind::Stuck => &mut count.stuck,
            MotionKind::Undecided => &mut count.undecided,
        } += 1;
    }
    counts
}
