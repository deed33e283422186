//! The branch of a cycle in one parameter, point by point, through its events.
//!
//! Steps go by [pseudo-arclength](super) in the phases and speeds of all impacts and the parameter, so folds are passed
//! like any other point. On each step functions are watched that change sign at an event; where one does, the step is
//! searched for the zero, every point tried being a converged solution, so that the parameter of an event is right to
//! rounding. At a grazing impact the signature changes and the branch goes on with one impact more or less.

use super::arc::{Equations, correct, tangent};
use super::free::hides;
use super::options::{BranchError, BranchOptions, Direction};
use super::point::{BranchEvent, Point};
use super::varied::Varied;
use super::watch::{Place, Watch};
use crate::orbit::{Cycle, Orbit, Ring, ring_cycle, solve};
use crate::system::{Oscillator, Parameter};
use core::f64::consts::TAU;
use core::ops::RangeInclusive;
use std::collections::VecDeque;

/// A point under way: unknowns, tangent, and the values of what is watched.
#[derive(Clone, Debug)]
pub(super) struct Here {
    pub(super) w: Vec<f64>,
    pub(super) tangent: Vec<f64>,
    pub(super) values: Vec<f64>,
    pub(super) orbit: Orbit,
}

/// A step taken.
pub(super) struct Reached {
    pub(super) there: Here,
    /// Its length along the tangent.
    pub(super) length: f64,
    pub(super) corrections: u32,
    /// Of the angle by which it bent.
    pub(super) cosine: f64,
    /// Whether it ends on the end of the range.
    pub(super) end: bool,
}

/// A branch: an iterator over its points, events among them, that ends with an event that [ends](BranchEvent::ends) it.
///
/// ```
/// use vibroimpact::{Oscillator, Parameter, Label, orbit::{FindOptions, find}};
/// use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction};
/// // 1/beta = 1.11, eps = 0.5: as the gap grows 1/1 loses its stability to a motion of twice the period
/// let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5)?;
/// let orbit = find(&osc, Label::new(1, 1), FindOptions::default()).pop().expect("1/1 exists");
/// let (range, options) = (0.0..=4.0, BranchOptions::default());
/// let branch = Branch::new(&osc, &orbit.cycle, Parameter::Gap, range, Direction::Up, options).expect("it is a cycle");
/// let flip = branch.into_iter().find(|point| point.event == Some(BranchEvent::Flip)).expect("it flips");
/// assert!((flip.value - 1.829_006_189_683_6).abs() < 1e-12);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Branch {
    pub(super) range: (f64, f64),
    pub(super) options: BranchOptions,
    pub(super) equations: Varied,
    pub(super) watches: Vec<Watch>,
    /// The sign each watched function has had so far; `None` until one is known.
    pub(super) signs: Vec<Option<bool>>,
    pub(super) here: Here,
    pub(super) step: f64,
    /// Where the branch began: unknowns and tangent, while the signature is the same.
    pub(super) begin: Option<(Vec<f64>, Vec<f64>)>,
    /// Grazing events passed: the second time the branch has closed.
    pub(super) grazed: Vec<(f64, BranchEvent)>,
    pub(super) count: u32,
    pub(super) pending: VecDeque<Point>,
    pub(super) over: bool,
}

impl Branch {
    /// The branch of `cycle`, a cycle of `osc`, in `parameter` over `range`, beginning in `direction`.
    ///
    /// # Errors
    /// [`BranchError`] names what cannot be followed.
    pub fn new(
        osc: &Oscillator,
        cycle: &Cycle,
        parameter: Parameter,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let value = parameter.get(osc).ok_or(BranchError::NoSuchParameter(parameter.name()))?;
        let ring = Ring::of(osc, cycle).ok_or(BranchError::Rests)?;
        if ring.len() == 0 && osc.damping() == 0.0 {
            return Err(BranchError::Undamped);
        }
        let (ring, _) = solve(osc, ring).ok_or(BranchError::NoCycle)?;
        let equations = Self::equations(osc, parameter, &range, value, &ring)?;
        let w = Varied::join(&ring, value);
        let mut row = equations.parameter_row();
        if direction == Direction::Down {
            row.iter_mut().for_each(|r| *r = -*r);
        }
        let along = tangent(&equations, &w, &row).ok_or(BranchError::NoCycle)?;
        Self::begin(equations, w, along, (*range.start(), *range.end()), options).ok_or(BranchError::NoCycle)
    }

    pub(super) fn equations(
        osc: &Oscillator,
        parameter: Parameter,
        range: &RangeInclusive<f64>,
        value: f64,
        ring: &Ring,
    ) -> Result<Varied, BranchError> {
        let (low, high) = (*range.start(), *range.end());
        if !(low.is_finite() && high.is_finite() && low < high && range.contains(&value)) {
            return Err(BranchError::OutOfRange { value, low, high });
        }
        Ok(Varied::new(osc, parameter, ring, 0.25 * (high - low)))
    }

    /// From a solution `w` along the tangent `along`.
    pub(super) fn begin(
        equations: Varied,
        w: Vec<f64>,
        along: Vec<f64>,
        range: (f64, f64),
        options: BranchOptions,
    ) -> Option<Self> {
        let (osc, ring) = equations.split(&w)?;
        let watches = Watch::all(&osc, &ring);
        let here = Self::look(&equations, &watches, w, along)?;
        let signs = here.values.iter().map(|&value| sign(value)).collect();
        let begin = Some((here.w.clone(), here.tangent.clone()));
        let step = options.first;
        let mut branch = Self {
            range,
            options,
            equations,
            watches,
            signs,
            here,
            step,
            begin,
            grazed: Vec::new(),
            count: 0,
            pending: VecDeque::new(),
            over: false,
        };
        branch.pending.push_back(branch.point(&branch.here, None));
        Some(branch)
    }

    /// Everything about the point `w`, a solution, whose tangent is given.
    pub(super) fn look(equations: &Varied, watches: &[Watch], w: Vec<f64>, tangent: Vec<f64>) -> Option<Here> {
        let (osc, ring, flights) = equations.flights(&w)?;
        let place = Place { osc: &osc, ring: &ring, flights: &flights };
        let values = watches.iter().map(|watch| watch.value(equations, &tangent, &place)).collect();
        let orbit = Orbit::judged(&osc, ring_cycle(&osc, &ring, &flights));
        Some(Here { w, tangent, values, orbit })
    }

    pub(super) fn point(&self, here: &Here, event: Option<BranchEvent>) -> Point {
        let value = here.w.last().copied().unwrap_or(f64::NAN);
        Point { value, cycle: here.orbit.cycle.clone(), physical: here.orbit.physical, event }
    }

    /// The solution a distance `h` along the tangent from here, looked for near `guess`.
    pub(super) fn solution(&self, guess: &[f64], h: f64) -> Option<(Vec<f64>, u32)> {
        let row = self.equations.row(&self.here.tangent);
        let level = self.equations.dot(&self.here.tangent, &self.here.w) + h;
        correct(&self.equations, guess, &row, level)
    }

    /// Its tangent, in the direction of the one here.
    pub(super) fn tangent_at(&self, w: &[f64]) -> Option<Vec<f64>> {
        tangent(&self.equations, w, &self.equations.row(&self.here.tangent))
    }

    /// A step of length `h`, or to the end of the range if that is nearer, if it converges to a point near enough.
    pub(super) fn reach(&self, h: f64) -> Option<Reached> {
        let value = self.value(&self.here);
        let rate = self.here.tangent.last().copied().unwrap_or(0.0);
        let end = if rate > 0.0 { self.range.1 } else { self.range.0 };
        let beyond = (value + h * rate - end) * rate > 0.0;
        let h = if beyond { (end - value) / rate } else { h };
        let guess: Vec<f64> = self.here.w.iter().zip(&self.here.tangent).map(|(w, t)| w + h * t).collect();
        // the end itself, since beyond it there may be no oscillator
        let (w, corrections) = if beyond {
            let (mut w, corrections) = correct(&self.equations, &guess, &self.equations.parameter_row(), end)?;
            if let Some(value) = w.last_mut() {
                *value = end;
            }
            (w, corrections)
        } else {
            self.solution(&guess, h)?
        };
        let off: Vec<f64> = w.iter().zip(&guess).map(|(w, g)| w - g).collect();
        let (length, h) = (h, h + self.equations.dot(&self.here.tangent, &off));
        let along = self.tangent_at(&w)?;
        let cosine = self.equations.dot(&along, &self.here.tangent);
        if !(self.equations.length(&off) <= STRAY * length + NOTHING && cosine >= BEND) {
            return None;
        }
        let there = Self::look(&self.equations, &self.watches, w, along)?;
        // what is no event must not happen unseen
        if self.here.orbit.physical && !there.orbit.physical && !self.crosses(&there).any(|j| self.watches[j].needed())
        {
            return None;
        }
        if self.equations.impacts() == 0 && there.orbit.physical {
            let (here, _) = self.equations.split(&self.here.w)?;
            let (next, _) = self.equations.split(&there.w)?;
            if hides(&here, &next) {
                return None;
            }
        }
        Some(Reached { there, length: h, corrections, cosine, end: beyond })
    }

    /// The watched functions that change sign on the way to `there`.
    pub(super) fn crosses<'a>(&'a self, there: &'a Here) -> impl Iterator<Item = usize> + 'a {
        (0..self.watches.len()).filter(move |&j| match (self.signs[j], sign(there.values[j])) {
            (Some(before), Some(after)) => before != after,
            // exactly at zero: found on the next step
            _ => false,
        })
    }

    /// One step on, or the end of the branch.
    pub(super) fn advance(&mut self) {
        if self.count >= self.options.points {
            return self.finish(BranchEvent::StepLimit);
        }
        let reached = loop {
            match self.reach(self.step) {
                Some(reached) => break reached,
                None => self.step *= 0.5,
            }
            if self.step < self.options.shortest {
                return self.finish(BranchEvent::NoConvergence);
            }
        };
        if reached.corrections <= 3 && reached.cosine > STRAIGHT {
            self.step = (1.6 * self.step).min(self.options.longest);
        } else if reached.corrections > 5 {
            self.step *= 0.5;
        }
        match self.happenings(&reached.there, reached.length) {
            Some(happenings) => self.go_through(&happenings, reached),
            None => self.finish(BranchEvent::NoConvergence),
        }
    }

    pub(super) fn value(&self, here: &Here) -> f64 {
        self.value_of(&here.w)
    }

    pub(super) fn value_of(&self, w: &[f64]) -> f64 {
        w.last().copied().unwrap_or(f64::NAN)
    }

    /// Adds an event; a motion it is the end of counts as one still.
    pub(super) fn emit(&mut self, at: &Here, event: BranchEvent) {
        let mut point = self.point(at, Some(event));
        point.physical |= self.here.orbit.physical || event == BranchEvent::BecomesPhysical;
        self.pending.push_back(point);
        self.count += 1;
    }

    /// Ends the branch where it is.
    pub(super) fn finish(&mut self, event: BranchEvent) {
        let here = self.here.clone();
        self.emit(&here, event);
        self.over = true;
    }

    /// Makes `there` the present point.
    pub(super) fn settle(&mut self, there: Here) {
        for (known, value) in self.signs.iter_mut().zip(&there.values) {
            if let Some(now) = sign(*value) {
                *known = Some(now);
            }
        }
        let closed = self.begin.as_ref().is_some_and(|(w, along)| {
            let ahead = |h: &Here| {
                let mut off: Vec<f64> = h.w.iter().zip(w).map(|(a, b)| a - b).collect();
                // phases may have gone round
                let turns = TAU * (off[0] / TAU).round();
                let phases = off.len() - 1;
                off[..phases].iter_mut().step_by(2).for_each(|theta| *theta -= turns);
                (self.equations.dot(&off, along), self.equations.length(&off))
            };
            let ((before, _), (after, away)) = (ahead(&self.here), ahead(&there));
            self.count > 3
                && before < 0.0
                && after >= 0.0
                && away < 2.0 * self.options.longest
                && self.equations.dot(along, &there.tangent) > 0.5
        });
        self.here = there;
        let point = self.point(&self.here, closed.then_some(BranchEvent::Closed));
        self.pending.push_back(point);
        self.count += 1;
        self.over = closed;
    }
}

impl Iterator for Branch {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}

/// The sign of a watched value, `None` within rounding of zero.
pub(super) fn sign(value: f64) -> Option<bool> {
    (value.abs() > ZERO).then_some(value > 0.0)
}

/// Below this a watched value has no sign.
const ZERO: f64 = 1e-11;
/// A corrected point may lie this share of the step off the tangent.
const STRAY: f64 = 0.3;
/// And this much more by rounding.
const NOTHING: f64 = 1e-9;
/// Cosine of the most a step may bend.
const BEND: f64 = 0.95;
/// Cosine of a bend below which the step may grow.
const STRAIGHT: f64 = 0.995;
