//! The motion to which each start of a plane leads.

mod measures;
mod merging;
mod plan;

pub use measures::{BasinMeasures, UncertaintyExponent, measures, missed_share, share_interval};
pub use merging::Merging;
pub use plan::BasinPlan;

use crate::{Axis, Coordinate, PlanError, Quantity, StartPlan, SystemPlan, axis, limits};
use std::borrow::Cow;
use vibroimpact::math::sort_by_key;
use vibroimpact::verdict::{CountedMotion, System};
use vibroimpact::{Oscillator, Start};

/// The result of a basin of any system: the motions, and for each start the motion to which it leads.
#[derive(Clone, Debug, PartialEq)]
pub struct Basin<S: System = Oscillator, V = Coordinate, F = Quantity> {
    /// The plan of the starts.
    pub plan: BasinPlan<V, F>,
    /// The motions, in the order of their first start.
    pub motions: Vec<CountedMotion<S>>,
    /// The motion of each start as an index into `motions`, or [`NO_START`]; the first axis varies fastest.
    pub cells: Vec<u16>,
    /// The number of events over which chaos was seen from each start of a machine, `None` unless its motion is chaotic; empty for
    /// an oscillator, whose motions say it.
    pub seen_events: Vec<Option<u64>>,
    /// For each motion a value of each field of the plan, not-a-number where it is not defined; empty if none is.
    pub quantities: Vec<Vec<f64>>,
}

/// Stands for the motion of a start beyond a rigid stop.
pub const NO_START: u16 = u16::MAX;

impl<S: System, V, F> Basin<S, V, F> {
    /// A basin from the motions of all starts, of which `quantities` returns the values of the fields.
    pub(crate) fn new(
        plan: BasinPlan<V, F>,
        (motions, cells): (Vec<CountedMotion<S>>, Vec<Option<usize>>),
        seen_events: Vec<Option<u64>>,
        quantities: impl Fn(&CountedMotion<S>) -> Vec<f64>,
    ) -> Result<Self, PlanError> {
        limits::check("motions", motions.len(), 0..=usize::from(NO_START))?;
        let cell = |cell: Option<usize>| cell.and_then(|number| u16::try_from(number).ok()).unwrap_or(NO_START);
        let cells = cells.into_iter().map(cell).collect();
        let quantities = motions.iter().map(quantities).collect();
        Ok(Self { plan, motions, cells, seen_events, quantities })
    }

    /// The number of the motion of cell number `k`; `None` beyond a rigid stop.
    #[must_use]
    pub fn motion(&self, k: usize) -> Option<usize> {
        Some(self.cells[k]).filter(|cell| *cell != NO_START).map(usize::from)
    }

    /// The label of cell number `k`; `refused` beyond a rigid stop.
    #[must_use]
    pub fn label(&self, k: usize) -> Cow<'static, str> {
        self.motion(k).map_or(Cow::Borrowed("refused"), |number| self.motions[number].verdict.label())
    }

    /// The number of starts beyond a rigid stop.
    #[must_use]
    pub fn refused(&self) -> usize {
        self.cells.iter().filter(|cell| **cell == NO_START).count()
    }

    /// The share of starts that lead to motion number `m`, of all that are allowed.
    #[must_use]
    #[allow(clippy::cast_precision_loss)]
    pub fn share(&self, m: usize) -> f64 {
        let total: u64 = self.motions.iter().map(|motion| motion.count).sum();
        self.motions[m].count as f64 / total.max(1) as f64
    }

    /// The indices of the motions in order of falling numbers of starts.
    #[must_use]
    pub fn by_count(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.motions.len()).collect();
        sort_by_key(&mut order, |m| core::cmp::Reverse(self.motions[*m].count));
        order
    }
}

impl Basin {
    /// The measures of its basins; `None` unless it has two axes.
    #[must_use]
    pub fn measures(&self) -> Option<BasinMeasures> {
        let [across, _] = self.plan.axes.as_slice() else { return None };
        Some(measures(&self.cells, across.over.count()))
    }
}

/// The start of cell number `k` of a basin of one oscillator.
pub(crate) fn start(osc: &Oscillator, plan: &BasinPlan, k: u64) -> Start {
    let mut rest = k;
    let mut place = [0; 4];
    for (place, axis) in place.iter_mut().zip(&plan.axes) {
        let count = axis.over.count() as u64;
        *place = usize::try_from(rest % count).unwrap_or(0);
        rest /= count;
    }
    let same = SystemPlan::default();
    start_at(osc, (&same, &same), (&plan.start(), &plan.axes), |k| place[k])
}

/// The start at a point of the axes, given the oscillator at that point. `systems` are that of the plan and that at the
/// point; `start` has the coordinates that are on no axis.
pub(crate) fn start_at(
    osc: &Oscillator,
    systems: (&SystemPlan, &SystemPlan),
    (start, axes): (&StartPlan, &[Axis]),
    place: impl Fn(usize) -> usize,
) -> Start {
    let given = axis::start_at(systems, start, axes, place);
    let (lowest, highest) = Start::room(osc);
    Start {
        // the ends of an axis lie within the stops; the clamp keeps rounded values between them within the stops too
        x: given.x.unwrap_or_else(|| Start::at_rest(osc).x).clamp(lowest, highest),
        v: given.v,
        phase: vibroimpact::system::phase::wrap(given.phase),
    }
}
