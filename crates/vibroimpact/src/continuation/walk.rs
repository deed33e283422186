//! A walk along a curve in a plane of parameters, and what changes sign on the way.

use super::arc::{Equations, correct, tangent};
use super::plane::{Condition, Plane};
use super::root;

/// A point of a walk.
#[derive(Clone, Debug)]
pub(super) struct Spot {
    pub(super) w: Vec<f64>,
    pub(super) tangent: Vec<f64>,
    /// Values of what is watched.
    pub(super) values: Vec<f64>,
}

/// A walk: where it is, and what it watches.
#[derive(Clone, Debug)]
pub(super) struct Walk {
    pub(super) plane: Plane,
    pub(super) watched: Vec<Condition>,
    /// The signs so far; `None` until one is known.
    pub(super) signs: Vec<Option<bool>>,
    pub(super) here: Spot,
    pub(super) step: f64,
    pub(super) longest: f64,
}

/// A step taken: where to, how far, and where on it which watched function is zero.
pub(super) struct Stride {
    pub(super) there: Spot,
    pub(super) length: f64,
    pub(super) crossed: Vec<(f64, usize)>,
}

impl Walk {
    /// From a solution `w` of the plane's equations along the side of the curve that `row` is positive on.
    pub(super) fn new(
        mut plane: Plane,
        watched: Vec<Condition>,
        w: Vec<f64>,
        row: &[f64],
        longest: f64,
    ) -> Option<Self> {
        plane.measure(&w);
        let along = tangent(&plane, &w, row)?;
        let values = Self::look(&plane, &watched, &w)?;
        let signs = values.iter().map(|&value| sign(value)).collect();
        let here = Spot { w, tangent: along, values };
        Some(Self { plane, watched, signs, here, step: (0.1 * longest).min(FIRST), longest })
    }

    fn look(plane: &Plane, watched: &[Condition], w: &[f64]) -> Option<Vec<f64>> {
        watched.iter().map(|&condition| plane.value(condition, w)).collect()
    }

    /// Everything about a solution.
    pub(super) fn spot(&self, w: Vec<f64>) -> Option<Spot> {
        let along = tangent(&self.plane, &w, &self.plane.row(&self.here.tangent))?;
        let values = Self::look(&self.plane, &self.watched, &w)?;
        Some(Spot { w, tangent: along, values })
    }

    fn solution(&self, guess: &[f64], h: f64) -> Option<(Vec<f64>, u32)> {
        let row = self.plane.row(&self.here.tangent);
        let level = self.plane.dot(&self.here.tangent, &self.here.w) + h;
        correct(&self.plane, guess, &row, level)
    }

    fn reach(&self, h: f64) -> Option<(Spot, bool)> {
        let guess: Vec<f64> = self.here.w.iter().zip(&self.here.tangent).map(|(w, t)| w + h * t).collect();
        let (w, corrections) = self.solution(&guess, h)?;
        let off: Vec<f64> = w.iter().zip(&guess).map(|(w, g)| w - g).collect();
        let spot = self.spot(w)?;
        let cosine = self.plane.dot(&spot.tangent, &self.here.tangent);
        let near = self.plane.length(&off) <= STRAY * h && cosine >= BEND;
        near.then_some((spot, corrections <= 4 && cosine > STRAIGHT))
    }

    /// The next step; `None` where the curve is lost.
    pub(super) fn stride(&mut self) -> Option<Stride> {
        let (there, length, easy, crossed) = loop {
            // a zero that is not found lies beyond something that a shorter step stays short of
            if let Some((there, easy)) = self.reach(self.step)
                && let Some(crossed) = self.crossings(&there, self.step)
            {
                break (there, self.step, easy, crossed);
            }
            self.step *= 0.5;
            if self.step < SHORTEST {
                return None;
            }
        };
        if easy {
            self.step = (1.6 * self.step).min(self.longest);
        }
        Some(Stride { there, length, crossed })
    }

    /// Where on the step to `there` which watched functions are zero, in order.
    fn crossings(&self, there: &Spot, length: f64) -> Option<Vec<(f64, usize)>> {
        let mut crossed = Vec::new();
        for j in 0..self.watched.len() {
            let (Some(before), Some(after)) = (self.signs[j], sign(there.values[j])) else { continue };
            if before != after {
                crossed.push((self.zero(j, there, length)?, j));
            }
        }
        crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(crossed)
    }

    /// The solution a distance `s` along the step of length `h` to `there`.
    pub(super) fn between(&self, there: &Spot, s: f64, h: f64) -> Option<Vec<f64>> {
        let guess: Vec<f64> = self.here.w.iter().zip(&there.w).map(|(a, b)| a + (b - a) * (s / h)).collect();
        Some(self.solution(&guess, s)?.0)
    }

    fn zero(&self, j: usize, there: &Spot, h: f64) -> Option<f64> {
        let f = |s: f64| self.plane.value(self.watched[j], &self.between(there, s, h)?);
        let positive = self.signs[j]?;
        let mut at_here = self.here.values[j];
        if sign(at_here) != Some(positive) {
            at_here = if positive { TINY } else { -TINY };
        }
        root::between(f, (0.0, at_here), (h, there.values[j]), RESOLUTION)
    }

    /// Makes `there` the present point.
    pub(super) fn settle(&mut self, there: Spot) {
        for (known, value) in self.signs.iter_mut().zip(&there.values) {
            if let Some(now) = sign(*value) {
                *known = Some(now);
            }
        }
        self.here = there;
        if self.plane.relative {
            self.plane.measure(&self.here.w);
            let length = self.plane.length(&self.here.tangent);
            self.here.tangent.iter_mut().for_each(|t| *t /= length);
        }
    }
}

/// The sign of a watched value, `None` within rounding of zero.
pub(super) fn sign(value: f64) -> Option<bool> {
    (value.abs() > ZERO).then_some(value > 0.0)
}

/// Below this a watched value has no sign.
const ZERO: f64 = 1e-9;
/// Stands for a value that is zero to rounding but known to be on one side.
const TINY: f64 = 1e-12;
/// Crossings are located to this along the step.
const RESOLUTION: f64 = 1e-14;
/// The first step, at most.
const FIRST: f64 = 1e-3;
/// Steps never become shorter.
const SHORTEST: f64 = 1e-10;
/// A corrected point may lie this share of the step off the tangent.
const STRAY: f64 = 0.2;
/// Cosine of the most a step may bend.
const BEND: f64 = 0.98;
/// Cosine of a bend below which the step may grow.
const STRAIGHT: f64 = 0.998;
