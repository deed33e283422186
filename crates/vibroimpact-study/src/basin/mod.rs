//! The motion to which each start of a plane leads.

mod measures;
mod merging;
mod plan;

pub use measures::{BasinMeasures, UncertaintyExponent, measures, missed_share, share_interval};
pub use merging::Merging;
pub use plan::BasinPlan;

use crate::{Axis, StartPlan, SystemPlan, axis};
use vibroimpact::verdict::CountedMotion;
use vibroimpact::{Oscillator, Start};

/// The result of a basin: the motions, and for each start the motion to which it leads.
#[derive(Clone, Debug, PartialEq)]
pub struct Basin {
    /// The plan of the starts.
    pub plan: BasinPlan,
    /// The motions, in the order of their first start.
    pub motions: Vec<CountedMotion>,
    /// The motion of each start as an index into `motions`; the first axis varies fastest.
    pub cells: Vec<u16>,
}

impl Basin {
    /// The label of cell number `k`.
    #[must_use]
    pub fn label(&self, k: usize) -> std::borrow::Cow<'static, str> {
        self.motions[usize::from(self.cells[k])].verdict.label()
    }

    /// The measures of its basins; `None` unless it has two axes.
    #[must_use]
    pub fn measures(&self) -> Option<BasinMeasures> {
        let [across, _] = self.plan.axes.as_slice() else { return None };
        Some(measures(&self.cells, across.over.count()))
    }

    /// The share of starts that lead to motion number `m`.
    #[must_use]
    #[allow(clippy::cast_precision_loss)]
    pub fn share(&self, m: usize) -> f64 {
        self.motions[m].count as f64 / self.cells.len() as f64
    }
}

/// The start of cell number `k` of a basin of one oscillator.
#[must_use]
pub fn start(osc: &Oscillator, plan: &BasinPlan, k: u64) -> Start {
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
