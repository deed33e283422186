//! The orbit diagram: the motion after its transient, at each value of a parameter or along a line through two.
//!
//! A sweep carries the state: the last state at one value is the start at the next value, as in a machine whose speed
//! is slowly raised or lowered. The first value starts at rest. When the gap changes, a mass on a stop stays on it, and
//! a mass that a stop has passed is placed on that stop. A motion without impacts is carried on too, from the state as
//! many forcing periods later as the transient is long. A sweep is therefore sequential and forms one tile. The two
//! directions of a sweep, and scattered starts, are computed in parallel.

mod after_transient;
mod follow;
mod impacts;
mod machine;
mod oscillator;
mod plan;
mod settled;
mod strobes;

pub(crate) use after_transient::{EVENTS_EACH, at_phase_zero};
pub(crate) use follow::{AfterTransient, SAME, carried_state};
pub use follow::{DiagramPoint, MotionKind};
pub(crate) use machine::point as machine_point;
pub(crate) use oscillator::point;
pub use plan::{DEFAULT_KEEP, DEFAULT_TRANSIENT, DiagramPlan, Show, ShowText, Shown, SweepDirection};
pub(crate) use plan::{check_order, check_shown};
pub(crate) use settled::state_on;

use crate::{Parameter, Values};

/// Identifies a motion among those at one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sweep {
    /// The motion of the sweep with rising values.
    Up,
    /// The motion of the sweep with falling values.
    Down,
    /// The motion from scattered start number k, counted from 0.
    Start(u64),
}

/// A motion at one value.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramStep {
    /// Number of the value among those of the plan, counted from 0.
    pub index: u32,
    /// The sweep or start of the motion.
    pub sweep: Sweep,
    /// The kind of the motion.
    pub kind: MotionKind,
    /// The points to show, in order of time.
    pub points: Vec<DiagramPoint>,
}

impl DiagramStep {
    /// Whether the motion repeats, that is, has fewer impacts or states than are shown at most. One alone counts as repeated.
    #[must_use]
    pub fn repeats(&self, keep: u64) -> bool {
        let kept = self.points.iter().filter(|point| !matches!(point, DiagramPoint::Chatter { .. })).count();
        (kept as u64) < keep || kept == 1
    }
}

/// The motions: for sweeps in the order of the sweep, one sweep after another; for scattered starts value by value.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram<V = Parameter, S = Show> {
    /// The plan.
    pub plan: DiagramPlan<V, S>,
    /// The motions.
    pub steps: Vec<DiagramStep>,
}

/// The number of the value, and the direction, at step `j` of sweep number `row`.
pub(crate) fn carried(over: &Values, direction: SweepDirection, row: u64, j: u32) -> (u32, Sweep) {
    let count = number_of(over);
    let (first, last) = over.ends();
    // index of value number j in rising order
    let rising = |j: u32| if first <= last { j } else { count - 1 - j };
    match direction {
        SweepDirection::Down => (rising(count - 1 - j), Sweep::Down),
        SweepDirection::Both if row == 1 => (rising(count - 1 - j), Sweep::Down),
        _ => (rising(j), Sweep::Up),
    }
}

/// The number of values. A checked plan has a million at most.
pub(crate) fn number_of(over: &Values) -> u32 {
    u32::try_from(over.count()).unwrap_or(u32::MAX)
}
