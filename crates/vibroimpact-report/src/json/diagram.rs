//! A summary of an orbit diagram: numbers of motions of each kind.

use super::{Document, Pair, Place};
use crate::Asked;
use crate::table::diagram::{columns, of_machine};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::machine::Machine;
use vibroimpact_study::diagram::{Diagram, MotionKind, Sweep, SweepDirection};
use vibroimpact_study::{DiagramPlan, MachineDiagram, Plan};

/// The answer to `vibro diagram`.
#[derive(JsonSchema, Serialize)]
pub(super) struct DiagramAnswer<'a> {
    vary: &'a str,
    over: Place,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Pair<'a>>,
    /// The columns of the table.
    columns: Vec<String>,
    sweeps: Vec<Counts>,
}

/// The object of `vibro diagram`.
#[must_use]
pub fn document<'a>(asked: &Asked, plan: &'a Plan, osc: &Oscillator, found: &Diagram) -> impl Serialize + use<'a> {
    let task = &found.plan;
    let over = Place::over(&task.over, asked.units.of(task.vary));
    let also = Pair::of(&task.cut(), &asked.units);
    let answer = DiagramAnswer {
        vary: asked.units.name_of(task.vary),
        over,
        also,
        columns: columns(found, &asked.units),
        sweeps: counts(found),
    };
    Document::new(asked, osc, plan, answer)
}

impl<'a> DiagramAnswer<'a> {
    pub(super) fn of_machine(machine: &Machine, found: &'a MachineDiagram) -> Self {
        let DiagramPlan { vary, over, also, .. } = &found.plan;
        Self {
            vary,
            over: Place::over(over, 1.0),
            also: also.as_ref().map(Pair::of_machine),
            columns: of_machine(found, machine).header.split(',').map(str::to_owned).collect(),
            sweeps: machine_counts(found),
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
pub fn counts(found: &Diagram) -> Vec<Counts> {
    counted_by(found.plan.direction, found.steps.iter().map(|step| (step.sweep, step.kind, step.points.len())))
}

/// The same for a machine.
#[must_use]
pub fn machine_counts(found: &MachineDiagram) -> Vec<Counts> {
    counted_by(found.plan.direction, found.steps.iter().map(|step| (step.sweep, step.kind, step.points.len())))
}

fn counted_by(direction: SweepDirection, motions: impl Iterator<Item = (Sweep, MotionKind, usize)>) -> Vec<Counts> {
    let names: &[&str] = match direction {
        SweepDirection::Up => &["up"],
        SweepDirection::Down => &["down"],
        SweepDirection::Both => &["up", "down"],
        SweepDirection::Scatter { .. } => &["scatter"],
    };
    let mut counts: Vec<Counts> = names.iter().map(|sweep| Counts { sweep, ..Counts::default() }).collect();
    for (sweep, kind, points) in motions {
        let row = usize::from(sweep == Sweep::Down && counts.len() > 1);
        let count = &mut counts[row];
        count.motions += 1;
        count.points += points;
        *match kind {
            MotionKind::Impacts => &mut count.impact,
            MotionKind::NoImpact => &mut count.none,
            MotionKind::Stuck => &mut count.stuck,
            MotionKind::Undecided => &mut count.undecided,
        } += 1;
    }
    counts
}
