//! The cycles of the branches that begin at a flip or leave at a branch point.
//!
//! A little beyond a flip, on one of its sides, a cycle of twice the period lies at a distance of about the square root of
//! the change of the number, in the direction that one period multiplies by -1. Beside a branch point, where a branch with a
//! symmetry loses it, two cycles lie in the direction that one period multiplies by +1, one to either side. They are found by
//! Newton's method from there.

use super::family::Family;
use super::point::SolutionPoint;
use crate::continuation::event::BranchEvent;
use crate::math::eigenvector;
use crate::orbit::{MachineFrame, MachineLap, machine::Cycle};

/// Changes of the number, in units of the scale, at which the cycle is searched for.
const BESIDE: [f64; 4] = [1e-4, 1e-3, 1e-5, 5e-3];
/// Distances along the direction, in units of the square root of the change and of the size of the motion.
const ALONG: [f64; 4] = [1.0, 0.3, 3.0, 0.1];
/// Two cycles beside a branch point that are apart by less than this part of the step along the direction are the same.
const MOVED: f64 = 0.1;

impl SolutionPoint {
    /// The cycles of the branches that begin here, each with the value of the number at which it was found, on a branch over a
    /// range of four times `scale`.
    ///
    /// At a [flip](BranchEvent::Flip) it is a cycle of twice the period. At a [branch
    /// point](BranchEvent::BranchPoint) there are up to two, one to either side. At other points there is none.
    #[must_use]
    pub fn leaving(&self, family: &Family, scale: f64) -> Vec<(f64, Cycle)> {
        let (multiplier, sides): (f64, &[f64]) = match self.event {
            Some(BranchEvent::Flip) => (-1.0, &[1.0]),
            Some(BranchEvent::BranchPoint) => (1.0, &[1.0, -1.0]),
            _ => return Vec::new(),
        };
        let direction = family.at(self.value).and_then(|machine| {
            let frame = MachineFrame::new(&machine);
            let time = frame.time(self.cycle.label.periods, self.cycle.period);
            let begin = self.cycle.strobes.first()?;
            let turn = MachineLap::fly(&frame, begin, time)?.derivative?;
            // one period multiplies translations, and without forcing the direction along the motion, by +1 too
            let turn = if multiplier > 0.0 { frame.within_cycles(turn, begin) } else { turn };
            eigenvector(&turn, multiplier)
        });
        let Some(direction) = direction else { return Vec::new() };
        let turns = if multiplier < 0.0 { 2 } else { 1 };
        let mut found: Vec<(f64, Cycle)> = Vec::new();
        for side in sides {
            let known = found.first().map(|(_, cycle)| cycle);
            found.extend(self.beside(family, scale, (turns, *side, &direction), known));
        }
        found
    }

    /// The cycle of another branch beside this point, which takes `turns` times as long, on a side of the direction. It is neither
    /// the cycle that goes on here nor the one that is known.
    fn beside(
        &self,
        family: &Family,
        scale: f64,
        (turns, sign, direction): (u32, f64, &[f64]),
        known: Option<&Cycle>,
    ) -> Option<(f64, Cycle)> {
        let begin = self.cycle.strobes.first()?;
        let size = self.cycle.sizes.0.max(self.cycle.sizes.1);
        for by in BESIDE {
            for side in [1.0, -1.0] {
                let value = self.value + side * by * scale;
                let Some(beside) = family.at(value) else { continue };
                let frame = MachineFrame::new(&beside);
                let values = frame.shape.values(begin);
                let periods = turns * self.cycle.label.periods;
                let time = f64::from(turns) * frame.time(self.cycle.label.periods, self.cycle.period);
                // one of twice the period is never the one that goes on
                let onward = if turns == 1 { Cycle::lasting(&frame, begin, (periods, time)) } else { None };
                for along in ALONG {
                    let step = along * by.sqrt();
                    let guess = values.iter().zip(direction).map(|(x, d)| x + sign * step * size * d);
                    let guess = frame.shape.with_values(begin, &guess.collect::<Vec<_>>());
                    let cycle = Cycle::lasting(&frame, &guess, (periods, time));
                    let other = |cycle: &Cycle| {
                        [onward.as_ref(), known].into_iter().flatten().all(|one| !cycle.same_as(one, MOVED * step))
                    };
                    if let Some(cycle) = cycle.filter(other) {
                        return Some((value, cycle));
                    }
                }
            }
        }
        None
    }
}
