//! One step after another along a curve of solutions, and where on a step a test function is zero.
//!
//! From a solution $`w`$ with unit tangent $`t`$ a step of length h is predicted at $`w + ht`$ and corrected by Newton's method in the
//! plane across (see [`Equations`]). It is taken if the corrected point lies near the predicted one, the tangent has turned little and the
//! problem admits it; else a step of half the length is tried. Test functions are smooth along the curve and change sign at an
//! event. Where one has changed sign, its zero is bracketed along the step. Every point tried is a converged solution, so an event is
//! right to rounding.

use super::equations::{Equations, correct, tangent};
use super::root;
use super::step_length::StepLength;
use core::f64::consts::TAU;
use core::fmt::Debug;

/// Equations whose curves of solutions are traced, with the test functions on their solutions.
pub(crate) trait Problem: Equations {
    /// What else is known of a solution.
    type Known: Clone + Debug;

    /// When a step is taken, and how precisely a zero is located.
    fn rules(&self) -> StepRules;

    /// How many test functions there are.
    fn tests(&self) -> usize;

    /// The values of all test functions at a solution with this tangent, and what else is known of it; `None` where one has none.
    fn look(&self, w: &[f64], tangent: &[f64]) -> Option<(Vec<f64>, Self::Known)>;

    /// The value of test function `j` at a solution; `tangent` computes the tangent there.
    fn test(&self, j: usize, w: &[f64], tangent: impl Fn() -> Option<Vec<f64>>) -> Option<f64>;

    /// How closely a zero of test function `j` is located along a step.
    fn resolution(&self, j: usize) -> f64;

    /// How many unknowns at the beginning are phases and speeds in turn.
    fn phases(&self) -> usize;

    /// Whether a step may lead to `there`, the test functions in `crossed` having changed sign.
    fn admits(&self, _here: &Solution<Self::Known>, _there: &Solution<Self::Known>, _crossed: &[usize]) -> bool {
        true
    }

    /// The range of the last unknown. A step that would leave it ends on its end.
    fn range(&self) -> Option<(f64, f64)> {
        None
    }

    /// Fits the weights to a solution; whether they have changed.
    fn weigh(&mut self, _w: &[f64]) -> bool {
        false
    }
}

/// When a step is taken, when the next one is longer or shorter, and when a test function counts as zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepRules {
    /// A corrected point may lie this share of the step off the tangent,
    pub(crate) stray: f64,
    /// and this much more by rounding.
    pub(crate) rounding: f64,
    /// Cosine of the most a step may bend.
    pub(crate) bend: f64,
    /// Cosine of a bend below which the next step may be longer,
    pub(crate) straight: f64,
    /// if there were at most so many corrections.
    pub(crate) few: u32,
    /// After more corrections than this the next step is shorter.
    pub(crate) many: u32,
    /// A test function nearer to zero than this has no sign.
    pub(crate) zero: f64,
    /// Where a point next to a zero has no solution, the test function is evaluated this far beside it; 0 for never.
    pub(crate) beside: f64,
}

/// A solution on the curve.
#[derive(Clone, Debug)]
pub(crate) struct Solution<K> {
    pub(crate) w: Vec<f64>,
    /// The unit tangent there.
    pub(crate) tangent: Vec<f64>,
    /// Values of the test functions.
    pub(crate) values: Vec<f64>,
    pub(crate) known: K,
}

/// What is passed on a step: how far along it, and the test function that is zero there (`None`: the end of the range).
pub(crate) type Crossing = (f64, Option<usize>);

/// A step that may be taken.
#[derive(Clone, Debug)]
pub(crate) struct Step<K> {
    pub(crate) there: Solution<K>,
    /// Its length along the tangent.
    pub(crate) length: f64,
    /// Whether it ends on the end of the range.
    pub(crate) on_end: bool,
    /// What is passed on it, in order.
    pub(crate) crossed: Vec<Crossing>,
    /// The factor by which the next step is longer.
    growth: f64,
}

/// Where a trace is: the present solution, the signs of the test functions so far, and the length of the next step.
#[derive(Clone, Debug)]
pub(crate) struct Tracer<P: Problem> {
    pub(crate) problem: P,
    /// `None` until the sign of a test function is known.
    pub(crate) signs: Vec<Option<bool>>,
    pub(crate) here: Solution<P::Known>,
    pub(crate) step: StepLength,
}

impl<P: Problem> Tracer<P> {
    /// From the solution `w` along its unit tangent `along`; `None` where a test function has no value.
    pub(crate) fn new(problem: P, w: Vec<f64>, along: Vec<f64>, step: StepLength) -> Option<Self> {
        let (values, known) = problem.look(&w, &along)?;
        let zero = problem.rules().zero;
        let signs = values.iter().map(|&value| sign(value, zero)).collect();
        Some(Self { problem, signs, here: Solution { w, tangent: along, values, known }, step })
    }

    /// The sign of a value of a test function; `None` within rounding of zero.
    pub(crate) fn sign(&self, value: f64) -> Option<bool> {
        sign(value, self.problem.rules().zero)
    }

    /// The tangent at a solution, in the direction of the one here.
    pub(crate) fn tangent_at(&self, w: &[f64]) -> Option<Vec<f64>> {
        tangent(&self.problem, w, &self.problem.row(&self.here.tangent))
    }

    /// Everything about the solution `w`.
    pub(crate) fn solution(&self, w: Vec<f64>) -> Option<Solution<P::Known>> {
        let along = self.tangent_at(&w)?;
        self.solution_along(w, along)
    }

    /// The same, with a tangent that is known.
    pub(crate) fn solution_along(&self, w: Vec<f64>, along: Vec<f64>) -> Option<Solution<P::Known>> {
        let (values, known) = self.problem.look(&w, &along)?;
        Some(Solution { w, tangent: along, values, known })
    }

    /// The next step; `None` where the curve is lost. Nothing is passed until it is [taken](Self::take).
    pub(crate) fn step(&mut self) -> Option<Step<P::Known>> {
        let mut length = self.step;
        let step = length.find(|h| {
            let mut step = self.reach(h)?;
            // a zero that is not found lies beyond something that a shorter step stays short of
            step.crossed = self.crossings(&step)?;
            Some(step)
        });
        if let Some(step) = &step {
            if step.growth > 1.0 {
                length.grow(step.growth);
            } else if step.growth < 1.0 {
                length.halve();
            }
        }
        self.step = length;
        step
    }

    /// Predictor and correction over a length `h`, or to the end of the range if that is nearer.
    fn reach(&self, h: f64) -> Option<Step<P::Known>> {
        let (here, rules) = (&self.here, self.problem.rules());
        let end = self.problem.range().and_then(|(low, high)| {
            let (value, rate) = (last(&here.w), last(&here.tangent));
            let end = if rate > 0.0 { high } else { low };
            ((value + h * rate - end) * rate > 0.0).then(|| (end, (end - value) / rate))
        });
        let h = end.map_or(h, |(_, to_end)| to_end);
        let guess: Vec<f64> = here.w.iter().zip(&here.tangent).map(|(w, t)| w + h * t).collect();
        let (w, corrections) = match end {
            // the end itself, since beyond it there may be no oscillator
            Some((end, _)) => self.on_end(&guess, end)?,
            None => self.across(&guess, h)?,
        };
        let off: Vec<f64> = w.iter().zip(&guess).map(|(w, g)| w - g).collect();
        let along = self.tangent_at(&w)?;
        let cosine = self.problem.dot(&along, &here.tangent);
        if !(self.problem.length(&off) <= rules.stray * h + rules.rounding && cosine >= rules.bend) {
            return None;
        }
        let there = self.solution_along(w, along)?;
        if !self.problem.admits(here, &there, &self.changed(&there)) {
            return None;
        }
        let growth = if corrections <= rules.few && cosine > rules.straight {
            GROWTH
        } else if corrections > rules.many {
            0.5
        } else {
            1.0
        };
        // corrections lie across the tangent but for those to the end of a range, so where there is one the length is measured
        let length = match self.problem.range() {
            Some(_) => h + self.problem.dot(&here.tangent, &off),
            None => h,
        };
        Some(Step { there, length, on_end: end.is_some(), crossed: Vec::new(), growth })
    }

    /// The solution near `guess` a distance `h` along the tangent from here, and the corrections it took.
    fn across(&self, guess: &[f64], h: f64) -> Option<(Vec<f64>, u32)> {
        let row = self.problem.row(&self.here.tangent);
        let level = self.problem.dot(&self.here.tangent, &self.here.w) + h;
        correct(&self.problem, guess, &row, level)
    }

    /// The solution near `guess` whose last unknown is `end`, to the last digit.
    pub(crate) fn on_end(&self, guess: &[f64], end: f64) -> Option<(Vec<f64>, u32)> {
        let mut row = vec![0.0; guess.len()];
        *row.last_mut()? = 1.0;
        let (mut w, corrections) = correct(&self.problem, guess, &row, end)?;
        *w.last_mut()? = end;
        Some((w, corrections))
    }

    /// The test functions that change sign on the way to `there`. One that is exactly zero there is found on the next step.
    fn changed(&self, there: &Solution<P::Known>) -> Vec<usize> {
        let changes = |&j: &usize| match (self.signs[j], self.sign(there.values[j])) {
            (Some(before), Some(after)) => before != after,
            _ => false,
        };
        (0..self.problem.tests()).filter(changes).collect()
    }

    /// What is passed on a step, in order; `None` if a zero is not found.
    fn crossings(&self, step: &Step<P::Known>) -> Option<Vec<Crossing>> {
        let mut found = Vec::new();
        for j in self.changed(&step.there) {
            found.push((self.zero(j, step, self.problem.resolution(j))?, Some(j)));
        }
        let (before, after) = (last(&self.here.w), last(&step.there.w));
        if let Some((low, high)) = self.problem.range() {
            for (end, beyond) in [(low, after < low), (high, after > high)] {
                if beyond {
                    let f = |s: f64| Some(last(&self.between(step, s)?) - end);
                    found.push((root::between(f, (0.0, before - end), (step.length, after - end), FINE)?, None));
                }
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(found)
    }

    /// The solution a distance `s` along a step.
    pub(crate) fn between(&self, step: &Step<P::Known>, s: f64) -> Option<Vec<f64>> {
        let share = s / step.length;
        let guess: Vec<f64> = self.here.w.iter().zip(&step.there.w).map(|(a, b)| a + (b - a) * share).collect();
        Some(self.across(&guess, s)?.0)
    }

    /// How far along a step test function `j`, which changes sign on it, is zero.
    pub(crate) fn zero(&self, j: usize, step: &Step<P::Known>, resolution: f64) -> Option<f64> {
        let value = |s: f64| {
            let w = self.between(step, s)?;
            self.problem.test(j, &w, || self.tangent_at(&w))
        };
        let beside = self.problem.rules().beside;
        let near = |by: f64| move |s: f64| if beside > 0.0 { value(s + by * beside) } else { None };
        let f = |s: f64| value(s).or_else(|| near(1.0)(s)).or_else(|| near(-1.0)(s));
        // the sign here is known even where the value is zero to rounding
        let positive = self.signs[j]?;
        let mut at_here = self.here.values[j];
        if self.sign(at_here) != Some(positive) {
            at_here = if positive { TINY } else { -TINY };
        }
        root::between(f, (0.0, at_here), (step.length, step.there.values[j]), resolution)
    }

    /// How far along the step from here a solution lies.
    pub(crate) fn ahead(&self, w: &[f64]) -> f64 {
        let off: Vec<f64> = w.iter().zip(&self.here.w).map(|(a, b)| a - b).collect();
        self.problem.dot(&self.here.tangent, &off)
    }

    /// Whether the solution `begin` lies between here and `there`, so that a closed curve has come back to it. Phases may have gone
    /// round whole turns.
    pub(crate) fn passes(&self, begin: &Solution<P::Known>, there: &Solution<P::Known>) -> bool {
        let ahead = |solution: &Solution<P::Known>| {
            let mut off: Vec<f64> = solution.w.iter().zip(&begin.w).map(|(a, b)| a - b).collect();
            let turns = TAU * (off[0] / TAU).round();
            off[..self.problem.phases()].iter_mut().step_by(2).for_each(|theta| *theta -= turns);
            (self.problem.dot(&off, &begin.tangent), self.problem.length(&off))
        };
        let ((before, _), (after, away)) = (ahead(&self.here), ahead(there));
        before < 0.0 && after >= 0.0 && away < 2.0 * self.step.longest
    }

    /// Makes `there` the present solution.
    pub(crate) fn take(&mut self, there: Solution<P::Known>) {
        let zero = self.problem.rules().zero;
        for (known, value) in self.signs.iter_mut().zip(&there.values) {
            *known = sign(*value, zero).or(*known);
        }
        self.here = there;
        if self.problem.weigh(&self.here.w) {
            let length = self.problem.length(&self.here.tangent);
            self.here.tangent.iter_mut().for_each(|t| *t /= length);
        }
    }
}

fn sign(value: f64, zero: f64) -> Option<bool> {
    (value.abs() > zero).then_some(value > 0.0)
}

fn last(w: &[f64]) -> f64 {
    w.last().copied().unwrap_or(f64::NAN)
}

/// After an easy step the next one is longer by this.
const GROWTH: f64 = 1.6;
/// The end of a range is located to this along the step.
const FINE: f64 = 1e-15;
/// Stands for a value that is zero to rounding but known to be on one side.
const TINY: f64 = 1e-12;
