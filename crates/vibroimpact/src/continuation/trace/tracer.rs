//! The tracer: steps along a curve of solutions, and the zeros of test functions on a step.
//!
//! From a solution $`w`$ with unit tangent $`t`$ a step of length h is predicted at $`w + ht`$. Newton's method
//! corrects it in the plane perpendicular to the tangent (see [`Equations`]). A step is accepted if the corrected point
//! lies near the prediction, the tangent has turned little and the problem admits the new solution. Otherwise a step of
//! half the length is tried. Test functions are smooth along the curve and change sign at an event. When one has
//! changed sign, its zero is bracketed along the step. Every point that is tried is a converged solution, so an event
//! is correct to rounding.

use super::equations::{Equations, correct, corrected, tangent, tangent_of, unit};
use super::step_length::StepLength;
use crate::math::root;
use crate::math::sort_by;
use core::cell::RefCell;
use core::f64::consts::TAU;
use core::fmt::Debug;

/// Equations whose curves of solutions are traced, with the test functions on their solutions.
pub(crate) trait Problem: Clone + Debug {
    /// What is known of a solution apart from its unknowns and test functions.
    type Known: Clone + Debug;
    type Equations: Equations;

    fn equations(&self) -> &Self::Equations;

    /// The rules for accepting steps and for the sign of a test function.
    fn rules(&self) -> StepRules;

    /// The number of test functions.
    fn tests(&self) -> usize;

    /// The values of all test functions at a solution with this tangent, and what else is known of it; `None` if one
    /// has no value.
    fn look(&self, w: &[f64], tangent: &[f64]) -> Option<(Vec<f64>, Self::Known)>;

    /// What else is known of a solution, which does not depend on the tangent.
    fn known(&self, w: &[f64]) -> Option<Self::Known> {
        self.look(w, &vec![0.0; w.len()]).map(|(_, known)| known)
    }

    /// The value of test function `j` at a solution; `tangent` computes the tangent there.
    fn test(&self, j: usize, w: &[f64], tangent: impl Fn() -> Option<Vec<f64>>) -> Option<f64>;

    /// The resolution to which a zero of test function `j` is located along a step.
    fn resolution(&self, j: usize) -> f64;

    /// The number of unknowns at the beginning that are alternately phases and speeds.
    fn phases(&self) -> usize;

    /// Whether a step may end at `there`; `crossed` are the test functions that change sign on the step.
    fn admits(&self, _here: &Solution<Self::Known>, _there: &Solution<Self::Known>, _crossed: &[usize]) -> bool {
        true
    }

    /// The range of the last unknown; `None` if it is not limited. A step that would leave the range ends at its end.
    fn range(&self) -> Option<(f64, f64)> {
        None
    }

    /// Adapts the weights to a solution; returns whether the weights can have changed.
    fn weigh(&mut self, _w: &[f64]) -> bool {
        false
    }
}

/// When a step is accepted, when the next step is longer or shorter, and when a test function counts as zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepRules {
    /// The largest distance of a corrected point from its prediction, as a fraction of the step.
    pub(crate) stray: f64,
    /// The distance added to this for rounding errors.
    pub(crate) rounding: f64,
    /// The smallest cosine of the angle between the tangents at both ends of a step.
    pub(crate) bend: f64,
    /// The next step may be longer only if the cosine of that angle exceeds this,
    pub(crate) straight: f64,
    /// and only if the step took at most this number of corrections.
    pub(crate) few: u32,
    /// After more corrections than this the next step is shorter.
    pub(crate) many: u32,
    /// The sign of a test function with an absolute value below this is unknown.
    pub(crate) zero: f64,
    /// If a point close to a zero has no solution, the test function is evaluated this far away along the step; 0 to
    /// fail instead.
    pub(crate) beside: f64,
}

/// A solution on the curve.
#[derive(Clone, Debug)]
pub(crate) struct Solution<K> {
    pub(crate) w: Vec<f64>,
    /// The unit tangent at the solution.
    pub(crate) tangent: Vec<f64>,
    /// The values of the test functions.
    pub(crate) values: Vec<f64>,
    pub(crate) known: K,
}

/// A crossing on a step: the distance along the step, and the test function that is zero there (`None`: the end of the
/// range).
pub(crate) type Crossing = (f64, Option<usize>);

/// A step that satisfies the rules and can be taken.
#[derive(Clone, Debug)]
pub(crate) struct Step<K> {
    pub(crate) there: Solution<K>,
    /// Its length along the tangent at its beginning.
    pub(crate) length: f64,
    /// Whether it ends at the end of the range.
    pub(crate) on_end: bool,
    /// The crossings on it, in order.
    pub(crate) crossed: Vec<Crossing>,
    /// The factor for the length of the next step.
    growth: f64,
    /// The distance of the solution on it that was found last, and by how much the cubic between both ends missed it.
    missed: RefCell<Option<(f64, Vec<f64>)>>,
}

/// The state of a trace: the current solution, the signs of the test functions, and the length of the next step.
#[derive(Clone, Debug)]
pub(crate) struct Tracer<P: Problem> {
    pub(crate) problem: P,
    /// `None` while the sign of a test function is unknown.
    pub(crate) signs: Vec<Option<bool>>,
    pub(crate) here: Solution<P::Known>,
    pub(crate) step: StepLength,
    /// The terms of second and third order of the cubic through the last two solutions, where there are two.
    bend: Option<[Vec<f64>; 2]>,
}

/// A corrected point: its unknowns, the number of corrections, and its tangent if that is known already.
type Corrected = (Vec<f64>, u32, Option<Vec<f64>>);

impl<P: Problem> Tracer<P> {
    /// Begins at the solution `w` with the unit tangent `along`; `None` if a test function has no value there.
    pub(crate) fn new(problem: P, w: Vec<f64>, along: Vec<f64>, step: StepLength) -> Option<Self> {
        let (values, known) = problem.look(&w, &along)?;
        let zero = problem.rules().zero;
        let signs = values.iter().map(|&value| sign(value, zero)).collect();
        Some(Self { problem, signs, here: Solution { w, tangent: along, values, known }, step, bend: None })
    }

    /// The sign of a value of a test function; `None` within rounding of zero.
    pub(crate) fn sign(&self, value: f64) -> Option<bool> {
        sign(value, self.problem.rules().zero)
    }

    /// The tangent at the solution `w`, in the direction of the current tangent; `None` if it is not unique.
    pub(crate) fn tangent_at(&self, w: &[f64]) -> Option<Vec<f64>> {
        tangent(self.problem.equations(), w, &self.problem.equations().row(&self.here.tangent))
    }

    /// The solution `w` with its tangent and test functions; `None` if one of them cannot be computed.
    pub(crate) fn solution(&self, w: Vec<f64>) -> Option<Solution<P::Known>> {
        let along = self.tangent_at(&w)?;
        self.solution_along(w, along)
    }

    /// The same with the given tangent.
    pub(crate) fn solution_along(&self, w: Vec<f64>, along: Vec<f64>) -> Option<Solution<P::Known>> {
        let (values, known) = self.problem.look(&w, &along)?;
        Some(Solution { w, tangent: along, values, known })
    }

    /// The next step; `None` if no step down to the smallest length succeeds. The current solution stays the same until
    /// [`take`](Self::take).
    pub(crate) fn step(&mut self) -> Option<Step<P::Known>> {
        let mut length = self.step;
        let step = length.find(|h| self.reach(h));
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

    /// Predicts and corrects a step of length `h`, or a step to the end of the range if that is nearer.
    fn reach(&self, h: f64) -> Option<Step<P::Known>> {
        let (here, rules) = (&self.here, self.problem.rules());
        // whether the step would leave the range, and how long it is to its end
        let end = self.problem.range().and_then(|(low, high)| {
            let (value, rate) = (last(&here.w), last(&here.tangent));
            let end = if rate > 0.0 { high } else { low };
            ((value + h * rate - end) * rate > 0.0).then(|| (end, (end - value) / rate))
        });
        let h = end.map_or(h, |(_, to_end)| to_end);
        let guess: Vec<f64> = here.w.iter().zip(&here.tangent).map(|(w, t)| w + h * t).collect();
        // where the curve bends much, higher orders say nothing
        let bend = self.bend.as_ref().filter(|bend| self.problem.equations().length(&bend[0]) * h < 0.5 * rules.stray);
        let near: Vec<f64> = bend.map_or_else(
            || guess.clone(),
            |[second, third]| {
                let orders = second.iter().zip(third);
                guess.iter().zip(orders).map(|(w, (second, third))| w + h * h * (second + h * third)).collect()
            },
        );
        let (w, corrections, along) = match end {
            // a solution exactly on the end, because the parameter can be invalid beyond it
            Some((end, _)) => {
                let (w, corrections) = self.on_end(&near, end)?;
                (w, corrections, None)
            }
            None => self.across(&near, h)?,
        };
        let off: Vec<f64> = w.iter().zip(&guess).map(|(w, g)| w - g).collect();
        let along = along.or_else(|| self.tangent_at(&w))?;
        let cosine = self.problem.equations().dot(&along, &here.tangent);
        // written so that a number that is no number refuses the step
        if !(self.problem.equations().length(&off) <= rules.stray * h + rules.rounding && cosine >= rules.bend) {
            return None;
        }
        let there = self.solution_along(w, along)?;
        let changed = self.changed(&there);
        if !self.problem.admits(here, &there, &changed) {
            return None;
        }
        let growth = if corrections <= rules.few && cosine > rules.straight {
            GROWTH
        } else if corrections > rules.many {
            0.5
        } else {
            1.0
        };
        // the length is measured along the tangent, because a correction to the end of a range is not perpendicular to
        // it
        let length = match self.problem.range() {
            Some(_) => h + self.problem.equations().dot(&here.tangent, &off),
            None => h,
        };
        let mut step =
            Step { there, length, on_end: end.is_some(), crossed: Vec::new(), growth, missed: RefCell::default() };
        // if a zero cannot be located, the step is too long: there is another event before it
        step.crossed = self.crossings(&step, changed)?;
        Some(step)
    }

    /// The solution near `guess` at the distance `h` along the current tangent.
    fn across(&self, guess: &[f64], h: f64) -> Option<Corrected> {
        let equations = self.problem.equations();
        let row = equations.row(&self.here.tangent);
        let level = equations.dot(&self.here.tangent, &self.here.w) + h;
        let found = corrected(equations, guess, &row, level)?;
        let along = if P::Equations::SLOW { tangent_of(equations, &found.factors, found.w.len()) } else { None };
        // beside a fold the sign of the last component needs the tangent at the solution
        let turns = |along: &Vec<f64>| {
            let pace = last(equations.weights()) * last(along) * last(along);
            found.off > TURNED && pace < STEEP * STEEP
        };
        Some((found.w, found.count, along.filter(|along| !turns(along))))
    }

    /// The solution near `guess` whose last unknown is exactly `end`, and the number of corrections.
    pub(crate) fn on_end(&self, guess: &[f64], end: f64) -> Option<(Vec<f64>, u32)> {
        let row = unit(guess.len(), guess.len() - 1, 1.0);
        let (mut w, corrections) = correct(self.problem.equations(), guess, &row, end)?;
        *w.last_mut()? = end;
        Some((w, corrections))
    }

    /// The test functions that change sign on the step to `there`. One that is exactly zero there is detected on the
    /// next step.
    fn changed(&self, there: &Solution<P::Known>) -> Vec<usize> {
        let changes = |&j: &usize| match (self.signs[j], self.sign(there.values[j])) {
            (Some(before), Some(after)) => before != after,
            _ => false,
        };
        (0..self.problem.tests()).filter(changes).collect()
    }

    /// The crossings on a step on which these test functions change sign, in order; `None` if a zero cannot be located.
    fn crossings(&self, step: &Step<P::Known>, changed: Vec<usize>) -> Option<Vec<Crossing>> {
        let mut found = Vec::new();
        for j in changed {
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
        sort_by(&mut found, |a, b| a.0.total_cmp(&b.0));
        Some(found)
    }

    /// The solution at the distance `s` along a step.
    pub(crate) fn between(&self, step: &Step<P::Known>, s: f64) -> Option<Vec<f64>> {
        Some(self.found_between(step, s)?.0)
    }

    fn found_between(&self, step: &Step<P::Known>, s: f64) -> Option<Corrected> {
        let mut guess = self.chord(&step.there, s / step.length);
        if !P::Equations::SLOW {
            return self.across(&guess, s);
        }
        self.round(&mut guess, step, s / step.length);
        let cubic = guess.clone();
        // a cubic misses a curve by this function of the distance, times a number that changes little
        let shape = |s: f64| {
            let parts = s * (step.length - s);
            parts * parts
        };
        if let Some((from, missed)) = &*step.missed.borrow() {
            let share = shape(s) / shape(*from);
            // close to the ends only rounding errors are missed
            if share < MOST_MISSED {
                guess.iter_mut().zip(missed).for_each(|(w, missed)| *w += share * missed);
            }
        }
        let found = self.across(&guess, s)?;
        let missed = found.0.iter().zip(&cubic).map(|(w, cubic)| w - cubic).collect();
        step.missed.replace(Some((s, missed)));
        Some(found)
    }

    /// Moves the point at this share of the chord of a step onto the cubic with the tangents at both ends.
    fn round(&self, point: &mut [f64], step: &Step<P::Known>, share: f64) {
        // lengths are those along the tangent at the beginning
        let pace = self.problem.equations().dot(&self.here.tangent, &step.there.tangent);
        let (before, after) = (share * (1.0 - share) * (1.0 - share), share * share * (share - 1.0));
        let ways = self.here.w.iter().zip(&step.there.w).zip(self.here.tangent.iter().zip(&step.there.tangent));
        for (point, ((one, other), (from, to))) in point.iter_mut().zip(ways) {
            let chord = other - one;
            *point += before * (step.length * from - chord) + after * (step.length * to / pace - chord);
        }
    }

    /// The point at this share of the chord to a solution.
    pub(crate) fn chord(&self, there: &Solution<P::Known>, share: f64) -> Vec<f64> {
        self.here.w.iter().zip(&there.w).map(|(a, b)| a + (b - a) * share).collect()
    }

    /// The solution at the distance `s` along a step, with its tangent and test functions.
    pub(crate) fn at(&self, step: &Step<P::Known>, s: f64) -> Option<Solution<P::Known>> {
        let (w, _, along) = self.found_between(step, s)?;
        match along {
            Some(along) => self.solution_along(w, along),
            None => self.solution(w),
        }
    }

    /// The distance along a step at which test function `j` is zero. It must change sign on the step.
    pub(crate) fn zero(&self, j: usize, step: &Step<P::Known>, resolution: f64) -> Option<f64> {
        let value = |s: f64| {
            let w = self.between(step, s)?;
            self.problem.test(j, &w, || self.tangent_at(&w))
        };
        let beside = self.problem.rules().beside;
        let near = |by: f64| move |s: f64| if beside > 0.0 { value(s + by * beside) } else { None };
        let f = |s: f64| value(s).or_else(|| near(1.0)(s)).or_else(|| near(-1.0)(s));
        // the sign at the beginning is known even if the value is zero to rounding
        let positive = self.signs[j]?;
        let mut at_here = self.here.values[j];
        if self.sign(at_here) != Some(positive) {
            at_here = if positive { TINY } else { -TINY };
        }
        root::between(f, (0.0, at_here), (step.length, step.there.values[j]), resolution)
    }

    /// The part of a step up to the distance `s` along it, with the crossings on that part: a test function that changes sign
    /// twice on the step can do so once there.
    pub(crate) fn part(&self, step: &Step<P::Known>, s: f64) -> Option<Step<P::Known>> {
        let there = self.at(step, s)?;
        let changed = self.changed(&there);
        let mut part =
            Step { there, length: s, on_end: false, crossed: Vec::new(), growth: 1.0, missed: RefCell::default() };
        part.crossed = self.crossings(&part, changed)?;
        Some(part)
    }

    /// The distance of the solution `w` from the current solution, along the tangent.
    pub(crate) fn ahead(&self, w: &[f64]) -> f64 {
        let off: Vec<f64> = w.iter().zip(&self.here.w).map(|(a, b)| a - b).collect();
        self.problem.equations().dot(&self.here.tangent, &off)
    }

    /// Whether the solution `begin` lies between the current solution and `there`, so that the curve is closed. The
    /// phases may have increased by a multiple of 2 pi.
    pub(crate) fn passes(&self, begin: &Solution<P::Known>, there: &Solution<P::Known>) -> bool {
        let ahead = |solution: &Solution<P::Known>| {
            let mut off: Vec<f64> = solution.w.iter().zip(&begin.w).map(|(a, b)| a - b).collect();
            let turns = TAU * (off[0] / TAU).round();
            // each impact has a phase and a velocity, in turn
            off[..self.problem.phases()].iter_mut().step_by(2).for_each(|theta| *theta -= turns);
            (self.problem.equations().dot(&off, &begin.tangent), self.problem.equations().length(&off))
        };
        // the numbers of unknowns can differ: then these are other equations
        if begin.w.len() != there.w.len() {
            return false;
        }
        let ((before, _), (after, away)) = (ahead(&self.here), ahead(there));
        before < 0.0 && after >= 0.0 && away < 2.0 * self.step.longest
    }

    /// Whether the curve closes on the step to `there`: it passes `begin` in the same direction.
    pub(crate) fn closes(&self, begin: &Solution<P::Known>, there: &Solution<P::Known>) -> bool {
        self.passes(begin, there) && self.problem.equations().dot(&begin.tangent, &there.tangent) > 0.5
    }

    /// The terms of second and third order at `there` of the cubic with the tangents at the current solution and there, by the
    /// distance along the tangent there.
    fn cubic_to(&self, there: &Solution<P::Known>) -> Option<[Vec<f64>; 2]> {
        let (equations, here) = (self.problem.equations(), &self.here);
        let way: Vec<f64> = there.w.iter().zip(&here.w).map(|(to, from)| to - from).collect();
        let (length, pace) = (equations.dot(&there.tangent, &way), equations.dot(&there.tangent, &here.tangent));
        let terms = here.tangent.iter().zip(&there.tangent).zip(&way).map(|((from, to), way)| {
            let (from, chord) = (from / pace, way / length);
            ((2.0 * to + from - 3.0 * chord) / length, (to + from - 2.0 * chord) / (length * length))
        });
        (length > 0.0).then(|| terms.unzip()).map(|(second, third)| [second, third])
    }

    /// Makes `there` the current solution.
    pub(crate) fn take(&mut self, there: Solution<P::Known>) {
        let zero = self.problem.rules().zero;
        for (known, value) in self.signs.iter_mut().zip(&there.values) {
            // within rounding of zero the last known sign stays
            *known = sign(*value, zero).or(*known);
        }
        if P::Equations::SLOW {
            self.bend = self.cubic_to(&there);
        }
        self.here = there;
        // new weights change the length of the tangent, which has to be 1
        if self.problem.weigh(&self.here.w) {
            let length = self.problem.equations().length(&self.here.tangent);
            self.here.tangent.iter_mut().for_each(|t| *t /= length);
        }
    }
}

fn sign(value: f64, zero: f64) -> Option<bool> {
    (value.abs() > zero).then_some(value > 0.0)
}

/// The last unknown: of a branch, the parameter.
pub(crate) fn last(w: &[f64]) -> f64 {
    w.last().copied().unwrap_or(f64::NAN)
}

/// What a cubic misses at one place tells it at another where it is not so many times as large.
const MOST_MISSED: f64 = 16.0;
/// Derivatives this far from a solution have its tangent,
const TURNED: f64 = 1e-9;
/// and those farther away the sign of its component along the last unknown, where that exceeds this part of its length.
const STEEP: f64 = 1e-2;
/// The factor for the length of the next step after an easy step.
const GROWTH: f64 = 1.6;
/// The resolution to which the end of a range is located along the step.
const FINE: f64 = 1e-15;
/// Replaces the value of a test function that is zero to rounding but has a known sign.
const TINY: f64 = 1e-12;
