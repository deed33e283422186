//! Following an orbit from the edge of a region to a point inside, or across a fold to the other sheet.

use super::polygon::Bound;
use super::seed::Seed;
use super::sheet_walk::{REPEATED, SheetWalk};
use crate::continuation::equations::plane_equations::{Condition, Plane};
use crate::continuation::trace::equations::{tangent, unit};
use crate::continuation::trace::tracer::Step;
use crate::orbit::{Floquet, Orbit, ring_cycle, solve};

impl SheetWalk<'_> {
    /// The orbit at `target`, followed along a straight line from an orbit on the edge; `None` if it is inadmissible on
    /// this sheet, or is not reached.
    pub(crate) fn reach(&self, from: &[f64], target: (f64, f64), below: bool) -> Option<Seed> {
        let (p, q) = Plane::values(from);
        let (dp, dq) = (target.0 - p, target.1 - q);
        let mut row = vec![0.0; from.len()];
        let width = row.len();
        (row[width - 2], row[width - 1]) = (dp, dq);
        let mut walk = self.along(Condition::Line(dq, -dp, dq * p - dp * q), from, &row)?;
        let here = |w: &[f64]| (w[width - 2] - p) * dp + (w[width - 1] - q) * dq;
        let full = dp * dp + dq * dq;
        for _ in 0..self.options.vertices {
            if !(self.go_on)() {
                break;
            }
            let step = walk.step()?;
            let (before, after) = (here(&walk.here.w), here(&step.there.w));
            let passed = after >= full;
            let share = if passed { (full - before) / (after - before) } else { 1.0 };
            // at the beginning the function of the edge is zero, with either sign, so crossings there are ignored
            if step.crossed.iter().any(|&(s, _)| s > EDGE && s < share * step.length) || after <= before {
                return None;
            }
            if passed {
                // the distance along the tangent is only nearly proportional to that along the line, so the orbit is
                // solved at the target
                let guess = walk.between(&step, share * step.length)?;
                let (_, mut ring) = walk.problem.plane.split(&guess)?;
                let osc = walk.problem.plane.oscillator(target)?;
                let flights;
                (ring, flights) = solve(&osc, ring)?;
                let cycle = ring_cycle(&osc, &ring, &flights);
                let once = ring.clone().smallest(REPEATED).len() == ring.len();
                return (once && Orbit::judged(&osc, cycle).physical).then_some(Seed { ring, osc, below });
            }
            walk.take(step.there);
        }
        None
    }

    /// An orbit on the sheet beyond a fold, with its place in the plane; `None` if no such orbit is admissible.
    pub(crate) fn across(&self, fold: &[f64], below: bool) -> Option<(Seed, (f64, f64))> {
        let mut plane = self.plane.clone();
        plane.condition = self.bounds.iter().find(|(.., bound)| *bound == Bound::Fold)?.0;
        let row = unit(fold.len(), fold.len() - 2, 1.0);
        let along = tangent(&plane, fold, &row)?;
        // in the plane, perpendicular to the curve of folds
        let (x, y) = plane.scaled(&along);
        let (p, q) = Plane::values(fold);
        let (one, two) = plane.unscaled((-y, x));
        let line = Condition::Line(two, -one, two * p - one * q);
        for walk in self.ways(line, fold)? {
            for length in ACROSS {
                let mut walk = walk.clone();
                walk.step.now = length;
                walk.signs.iter_mut().for_each(|sign| *sign = None);
                let Some(Step { there, .. }) = walk.step() else { continue };
                let Some((osc, ring, flights)) = walk.problem.plane.flights(&there.w) else { continue };
                let other = Floquet::new(&osc, &ring, &flights).plus_one() * self.sheet < 0.0;
                if other && ring.sensible() && Orbit::judged(&osc, ring_cycle(&osc, &ring, &flights)).physical {
                    return Some((Seed { ring, osc, below: !below }, Plane::values(&there.w)));
                }
            }
        }
        None
    }
}

/// A crossing closer to the beginning of the line than this is the edge itself.
const EDGE: f64 = 1e-9;
/// The lengths of the step across a fold that are tried.
const ACROSS: [f64; 3] = [1e-2, 1e-3, 1e-4];
