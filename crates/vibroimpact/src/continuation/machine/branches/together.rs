//! Multipliers that pass the unit circle together, as those of equal parts that do not act on each other.
//!
//! The determinants that are the test functions of bifurcations change their sign for each multiplier that passes, so two together
//! change none. The number of multipliers outside the circle tells it.

use super::branch::EventBranch;
use super::problem::Judged;
use super::step::{NEARBY, off_circle};
use crate::continuation::event::BranchEvent;
use crate::continuation::trace::tracer::Step;
use crate::math::{Multiplier, root, sort_by};
use crate::orbit::Stability;

/// The distance along a step to which the place is located, in parts of the step.
const FINE: f64 = 1e-13;
/// A modulus that differs from 1 by more is not 1 by the errors of a neutral motion.
const SURE: f64 = 1e-7;

impl EventBranch {
    /// Reports the flip, branch point or torus bifurcation at which several multipliers pass the unit circle together on a step
    /// without another bifurcation.
    pub(super) fn pass_together(&mut self, step: &Step<Judged>) {
        let (Some(before), Some(after)) = (outside(&self.tracer.here.known), outside(&step.there.known)) else {
            return;
        };
        // the largest of those that pass
        let rank = before.min(after);
        let off = |known: &Judged| Some(sorted(&known.multipliers).get(rank)?.modulus() - 1.0);
        let ends = (off(&self.tracer.here.known), off(&step.there.known));
        let (Some(at_here), Some(at_there)) = ends else { return };
        if before == after || at_here * at_there > 0.0 || at_here.abs().max(at_there.abs()) < SURE {
            return;
        }
        let value = |s: f64| off(&self.tracer.at(step, s)?.known);
        let place = root::between(value, (0.0, at_here), (step.length, at_there), FINE * step.length);
        let Some(at) = place.and_then(|s| self.tracer.at(step, s)) else { return };
        let Some(passing) = sorted(&at.known.multipliers).get(rank).copied() else { return };
        let event = match passing {
            Multiplier { im, .. } if im.abs() > NEARBY => BranchEvent::Torus,
            Multiplier { re, .. } if re < 0.0 => BranchEvent::Flip,
            _ => BranchEvent::BranchPoint,
        };
        if off_circle(&at.known.multipliers, event) < NEARBY {
            self.add(&at, Some(event));
        }
    }
}

/// The number of multipliers outside the unit circle, of an admissible solution.
fn outside(known: &Judged) -> Option<usize> {
    let cycle = known.cycle.as_ref()?;
    Some(cycle.stabilities().into_iter().filter(|stability| *stability == Stability::Unstable).count())
}

/// The multipliers, the largest first.
fn sorted(multipliers: &[Multiplier]) -> Vec<Multiplier> {
    let mut sorted = multipliers.to_vec();
    sort_by(&mut sorted, |a, b| b.modulus().total_cmp(&a.modulus()));
    sorted
}
