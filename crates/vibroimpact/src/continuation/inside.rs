//! Orbits followed away from an edge: to a point within it, and over a fold onto the other sheet.

use super::arc::tangent;
use super::plane::{Condition, Plane};
use super::polygon::Bound;
use super::round::{REPEATED, Round};
use super::seed::Seed;
use super::walk::Stride;
use crate::orbit::{Floquet, Orbit, ring_cycle, solve};

impl Round<'_> {
    /// The orbit at `target`, followed straight from one on the edge; `None` if it is inadmissible on this sheet, or not reached.
    pub(super) fn reach(&self, from: &[f64], target: (f64, f64), below: bool) -> Option<Seed> {
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
            let Stride { there, length, crossed } = walk.stride()?;
            let (before, after) = (here(&walk.here.w), here(&there.w));
            let passed = after >= full;
            let share = if passed { (full - before) / (after - before) } else { 1.0 };
            // on the edge that it leaves a value is zero, with either sign
            if crossed.iter().any(|&(s, _)| s > EDGE && s < share * length) || after <= before {
                return None;
            }
            if passed {
                // the length of the step is not quite in proportion to its share
                let guess = walk.between(&there, share * length, length)?;
                let (_, mut ring) = walk.plane.split(&guess)?;
                let osc = walk.plane.oscillator(target)?;
                let flights;
                (ring, flights) = solve(&osc, ring)?;
                let cycle = ring_cycle(&osc, &ring, &flights);
                let once = ring.clone().smallest(REPEATED).len() == ring.len();
                return (once && Orbit::judged(&osc, cycle).physical).then_some(Seed { ring, osc, below });
            }
            walk.settle(there);
        }
        None
    }

    /// An orbit of the sheet on the other side of a fold, where that is a motion, and its place in the plane.
    pub(super) fn across(&self, fold: &[f64], below: bool) -> Option<(Seed, (f64, f64))> {
        let mut plane = self.plane.clone();
        plane.condition = self.bounds.iter().find(|(.., bound)| *bound == Bound::Fold)?.0;
        let mut row = vec![0.0; fold.len()];
        let width = row.len();
        row[width - 2] = 1.0;
        let along = tangent(&plane, fold, &row)?;
        // straight across the curve of folds
        let (x, y) = plane.scaled(&along);
        let (p, q) = Plane::values(fold);
        let (one, two) = plane.unscaled((-y, x));
        let line = Condition::Line(two, -one, two * p - one * q);
        for walk in self.ways(line, fold)? {
            for step in ACROSS {
                let mut walk = walk.clone();
                walk.step = step;
                walk.signs.iter_mut().for_each(|sign| *sign = None);
                let Some(Stride { there, .. }) = walk.stride() else { continue };
                let Some((osc, ring, flights)) = walk.plane.flights(&there.w) else { continue };
                let other = Floquet::new(&osc, &ring, &flights).plus_one() * self.sheet < 0.0;
                if other && ring.sensible() && Orbit::judged(&osc, ring_cycle(&osc, &ring, &flights)).physical {
                    return Some((Seed { ring, osc, below: !below }, Plane::values(&there.w)));
                }
            }
        }
        None
    }
}

/// A bound that is passed nearer to the edge than this is the edge itself.
const EDGE: f64 = 1e-9;
/// Steps across a fold.
const ACROSS: [f64; 3] = [1e-2, 1e-3, 1e-4];
