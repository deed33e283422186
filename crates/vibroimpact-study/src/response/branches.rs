//! The branches on which the cycles of the sweeps lie.

use super::plan::ResponsePlan;
use super::row::{ResponseRow, all};
use super::sweep::SweptMotion;
use crate::{Control, Cut, PlanError, RunError, SystemPlan};
use core::ops::RangeInclusive;
use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction, SolutionPoint};
use vibroimpact::orbit::{Cycle, refine, without_impacts};
use vibroimpact::quantities::of_cycle;
use vibroimpact::{Oscillator, ParameterPath};

/// Maximum number of branches, and of points in each direction along one.
pub(crate) const MOST_BRANCHES: usize = 40;
pub(crate) const MOST_POINTS: u32 = 3_000;
/// Two cycles closer than this are the same one.
const SAME: f64 = 1e-6;

/// Follows the branch of each cycle of the sweeps that lies on none of the branches so far. With damping, the motion
/// without impacts has a branch too.
pub(super) fn branches<'a>(
    system: &SystemPlan,
    plan: &ResponsePlan,
    motions: impl Iterator<Item = &'a SweptMotion>,
    control: &Control<'_>,
) -> Result<Vec<Vec<ResponseRow>>, RunError> {
    let cut = plan.cut();
    let ground = Ground { system, cut, range: cut.ends.0..=cut.ends.1, control };
    let mut found: Vec<Vec<SolutionPoint>> = Vec::new();
    for motion in motions {
        if control.stopping() || found.len() >= MOST_BRANCHES {
            break;
        }
        let osc = ground.oscillator(motion.row.value)?;
        let still = || if motion.row.label == "0" { without_impacts(&osc) } else { None };
        let Some(cycle) = motion.cycle.clone().or_else(still) else { continue };
        if found.iter().any(|points| ground.passes(points, &osc, &cycle, motion.row.value)) {
            continue;
        }
        found.push(ground.both_ways(&osc, &cycle, &cut.varying(system, motion.row.value)?));
    }
    let row = |point: &SolutionPoint| {
        let quantities =
            if control.stopping() { None } else { of_cycle(&ground.oscillator(point.value)?, &point.cycle) };
        Ok(ResponseRow {
            value: point.value,
            label: point.cycle.label.to_string(),
            admissible: point.physical,
            stability: Some(point.stability()),
            event: point.event.map(|event| event.name()),
            quantities: all(quantities),
        })
    };
    found.into_iter().map(|points| points.iter().map(row).collect()).collect()
}

/// The data common to all branches.
struct Ground<'a, 'c> {
    system: &'a SystemPlan,
    cut: Cut,
    range: RangeInclusive<f64>,
    control: &'a Control<'c>,
}

impl Ground<'_, '_> {
    fn oscillator(&self, value: f64) -> Result<Oscillator, PlanError> {
        self.cut.oscillator(self.system, value)
    }

    /// The points of the branch through a cycle along a line that begins there, from the end of the branch downwards to
    /// the end upwards.
    fn both_ways(&self, osc: &Oscillator, cycle: &Cycle, vary: &ParameterPath) -> Vec<SolutionPoint> {
        let options = BranchOptions { points: MOST_POINTS, ..BranchOptions::default() };
        let way = |direction| -> Vec<SolutionPoint> {
            let branch = Branch::new(osc, cycle, vary.clone(), self.range.clone(), direction, options);
            // a cycle that cannot be followed, such as one at the end of the range, is no branch
            branch.map_or_else(|_| Vec::new(), |branch| branch.take_while(|_| !self.control.stopping()).collect())
        };
        let mut points = way(Direction::Down);
        if points.last().is_some_and(|point| point.event == Some(BranchEvent::Closed)) {
            return points;
        }
        points.reverse();
        // both begin with the cycle itself
        points.extend(way(Direction::Up).into_iter().skip(usize::from(!points.is_empty())));
        // at an end of the range a branch has its first point twice
        points.dedup_by(|b, a| a.value == b.value && a.event.is_some() && a.cycle.same_as(&b.cycle, SAME));
        points
    }

    /// Whether a branch passes through a cycle at a value: Newton's method from a point beside it leads to the cycle.
    fn passes(&self, points: &[SolutionPoint], osc: &Oscillator, cycle: &Cycle, value: f64) -> bool {
        points.windows(2).any(|pair| {
            let (a, b) = (&pair[0], &pair[1]);
            if !(a.value.min(b.value)..=a.value.max(b.value)).contains(&value) {
                return false;
            }
            [a, b].into_iter().any(|point| {
                let guess = &point.cycle;
                if guess.label != cycle.label {
                    return false;
                }
                if guess.points.is_empty() || !cycle.rests.is_empty() {
                    // the only motion of its label: the steady one, or that of a release
                    return guess.rests.len() == cycle.rests.len();
                }
                refine(osc, guess).is_some_and(|orbit| orbit.cycle.same_as(cycle, SAME))
            })
        })
    }
}
