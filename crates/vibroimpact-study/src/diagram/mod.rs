//! The orbit diagram: the motion after its transient, at each value of a parameter, or along a line through two.
//!
//! A sweep carries the state: the one in which a value left the motion is the start at the next value, as in a machine
//! that is slowly turned up or down; its first value starts at rest. A state on a stop stays on it when the gap changes,
//! one that a stop has moved over is put on that stop. A motion without impacts is carried on like any other, from a
//! point of its flight as many forcing periods later as the transient is long. So a sweep is sequential and one tile;
//! sweeps in both directions and scattered starts run over threads.

mod follow;
mod impacts;
mod plan;
mod strobes;

pub use follow::{DiagramPoint, MotionKind};
pub use plan::{DEFAULT_KEEP, DEFAULT_TRANSIENT, DiagramPlan, Show, SweepDirection};

use crate::{PlanError, SystemPlan};
use follow::AfterTransient;
use vibroimpact::verdict::{StartBox, scattered_starts};
use vibroimpact::{Oscillator, Start};

/// Which of the motions at one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sweep {
    /// That of the sweep with rising values.
    Up,
    /// That of the sweep with falling values.
    Down,
    /// That from scattered start number k, counted from 0.
    Start(u64),
}

/// A motion at one value.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramStep {
    /// Which value of the range, counted from 0.
    pub index: u32,
    /// Which motion.
    pub sweep: Sweep,
    /// What it is.
    pub kind: MotionKind,
    /// What there is to show of it, in order of time.
    pub points: Vec<DiagramPoint>,
}

/// The motions of a sweep in the order of the sweep, one sweep after another; of scattered starts, value by value.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    /// What was asked.
    pub plan: DiagramPlan,
    /// The motions.
    pub steps: Vec<DiagramStep>,
}

/// Step number `j` of sweep number `row`: at which value, and in which direction.
pub(crate) fn carried(plan: &DiagramPlan, row: u64, j: u32) -> (u32, Sweep) {
    let count = plan.over.count();
    let (first, last) = plan.over.ends();
    // number j of the values in rising order
    let rising = |j: u32| if first <= last { j } else { count - 1 - j };
    match plan.direction {
        SweepDirection::Down => (rising(count - 1 - j), Sweep::Down),
        SweepDirection::Both if row == 1 => (rising(count - 1 - j), Sweep::Down),
        _ => (rising(j), Sweep::Up),
    }
}

/// The motion at one value, and the oscillator and state to carry on.
pub(crate) fn step(
    system: &SystemPlan,
    plan: &DiagramPlan,
    (index, sweep): (u32, Sweep),
    before: Option<(Oscillator, Start)>,
) -> Result<(DiagramStep, (Oscillator, Start)), PlanError> {
    let osc = plan.oscillator(system, index)?;
    let start = match (plan.direction, sweep, before) {
        (SweepDirection::Scatter { seed, .. }, Sweep::Start(k), _) => {
            scattered_starts(&osc, StartBox::natural(&osc), seed, k)
        }
        (_, _, Some((old, left))) => follow::carried(left, &old, &osc),
        (_, _, None) => Start::at_rest(&osc),
    };
    let AfterTransient { kind, points, last } = match plan.show {
        Show::Velocity => impacts::after_transients(&osc, start, plan.transient, plan.keep),
        Show::Strobe => strobes::after_transients(&osc, start, plan.transient, plan.keep),
    };
    Ok((DiagramStep { index, sweep, kind, points }, (osc, last)))
}
