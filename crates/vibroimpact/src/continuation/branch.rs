//! The branch of a cycle in one parameter, point by point, through its events.
//!
//! Steps go by [pseudo-arclength](super) in the phases and speeds of all impacts and the parameter, so folds are passed
//! like any other point. On each step functions are watched that change sign at an event; where one does, the step is
//! searched for the zero, every point tried being a converged solution, so that the parameter of an event is right to
//! rounding. At a grazing impact the signature changes and the branch goes on with one impact more or less.

use super::arc::{Equations, correct, tangent};
use super::graze::{Beyond, beyond};
use super::interpolate;
use super::point::{BranchEvent, Change, Point};
use super::root;
use super::switch::halved;
use super::varied::Varied;
use super::watch::{Place, Watch};
use crate::orbit::{Cycle, Orbit, Ring, ring_cycle, solve};
use crate::system::{Oscillator, Parameter, phase};
use crate::verdict::Label;
use core::f64::consts::TAU;
use core::ops::RangeInclusive;
use std::collections::VecDeque;
use thiserror::Error;

/// Which way the parameter goes at first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// It grows.
    Up,
    /// It falls.
    Down,
}

/// How a branch is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchOptions {
    /// The longest step: the change of all phases together in radians, of speeds, and of the parameter in quarters of
    /// its range.
    pub longest: f64,
    /// The first step, also after a grazing event.
    pub first: f64,
    /// A step that would have to be shorter than this ends the branch.
    pub shortest: f64,
    /// The most points.
    pub points: u32,
    /// The most impacts a cycle may come to have; towards a complete chatter there is no end of them.
    pub impacts: u32,
    /// Whether the signature is kept at grazing events, so that the branch goes on through solutions that are no motions.
    pub keep_signature: bool,
}

impl Default for BranchOptions {
    /// Steps up to 0.05, beginning with 0.002, never below 1e-9; 20 000 points, 32 impacts; the signature
    /// changes where the motion asks for it.
    fn default() -> Self {
        Self { longest: 0.05, first: 2e-3, shortest: 1e-9, points: 20_000, impacts: 32, keep_signature: false }
    }
}

/// Why a branch cannot begin.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum BranchError {
    /// The parameter belongs to a stop that is not there.
    #[error("{0} is a parameter of the second stop, and there is only one stop")]
    NoSuchParameter(&'static str),
    /// The range is not two finite numbers in order, or the value at which the branch begins lies outside.
    #[error("the branch begins at {value}, which does not lie in the range from {low} to {high}")]
    OutOfRange {
        /// Where it begins.
        value: f64,
        /// Lower end of the range.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// A cycle with a rest: it is fixed by its release and has no equations to follow.
    #[error("a cycle that rests on a stop cannot be followed: it is determined by its release at each value anew")]
    Rests,
    /// Newton's method does not converge from the cycle at these parameters.
    #[error("the cycle given does not solve its equations at these parameters")]
    NoCycle,
    /// Not the event that a branch was asked from.
    #[error("no branch of that kind begins at this point")]
    NotThere,
}

/// A point under way: unknowns, tangent, and the values of what is watched.
#[derive(Clone, Debug)]
struct Here {
    w: Vec<f64>,
    tangent: Vec<f64>,
    values: Vec<f64>,
    orbit: Orbit,
}

/// A step taken.
struct Reached {
    there: Here,
    /// Its length along the tangent.
    length: f64,
    corrections: u32,
    /// Of the angle by which it bent.
    cosine: f64,
    /// Whether it ends on the end of the range.
    end: bool,
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
    range: (f64, f64),
    options: BranchOptions,
    equations: Varied,
    watches: Vec<Watch>,
    /// The sign each watched function has had so far; `None` until one is known.
    signs: Vec<Option<bool>>,
    here: Here,
    step: f64,
    /// Where the branch began: unknowns and tangent, while the signature is the same.
    begin: Option<(Vec<f64>, Vec<f64>)>,
    /// Grazing events passed: the second time the branch has closed.
    grazed: Vec<(f64, BranchEvent)>,
    count: u32,
    pending: VecDeque<Point>,
    over: bool,
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
    fn look(equations: &Varied, watches: &[Watch], w: Vec<f64>, tangent: Vec<f64>) -> Option<Here> {
        let (osc, ring, flights) = equations.flights(&w)?;
        let place = Place { osc: &osc, ring: &ring, flights: &flights };
        let values = watches.iter().map(|watch| watch.value(equations, &tangent, &place)).collect();
        let orbit = Orbit::judged(&osc, ring_cycle(&osc, &ring, &flights));
        Some(Here { w, tangent, values, orbit })
    }

    fn point(&self, here: &Here, event: Option<BranchEvent>) -> Point {
        let value = here.w.last().copied().unwrap_or(f64::NAN);
        Point { value, cycle: here.orbit.cycle.clone(), physical: here.orbit.physical, event }
    }

    /// The solution a distance `h` along the tangent from here, looked for near `guess`.
    fn solution(&self, guess: &[f64], h: f64) -> Option<(Vec<f64>, u32)> {
        let row = self.equations.row(&self.here.tangent);
        let level = self.equations.dot(&self.here.tangent, &self.here.w) + h;
        correct(&self.equations, guess, &row, level)
    }

    /// Its tangent, in the direction of the one here.
    fn tangent_at(&self, w: &[f64]) -> Option<Vec<f64>> {
        tangent(&self.equations, w, &self.equations.row(&self.here.tangent))
    }

    /// A step of length `h`, or to the end of the range if that is nearer, if it converges to a point near enough.
    fn reach(&self, h: f64) -> Option<Reached> {
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
        Some(Reached { there, length: h, corrections, cosine, end: beyond })
    }

    /// The watched functions that change sign on the way to `there`.
    fn crosses<'a>(&'a self, there: &'a Here) -> impl Iterator<Item = usize> + 'a {
        (0..self.watches.len()).filter(move |&j| match (self.signs[j], sign(there.values[j])) {
            (Some(before), Some(after)) => before != after,
            // exactly at zero: found on the next step
            _ => false,
        })
    }

    /// One step on, or the end of the branch.
    fn advance(&mut self) {
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

    /// What happens on the step to `there`: how far along, and which watched function (`None`: the end of the range).
    fn happenings(&self, there: &Here, h: f64) -> Option<Vec<(f64, Option<usize>)>> {
        let mut found = Vec::new();
        for j in self.crosses(there) {
            // folds and branch points are looked at more closely later
            let coarse = matches!(self.watches[j], Watch::Pace | Watch::PlusOne);
            found.push((self.zero(j, there, h, if coarse { COARSE } else { RESOLUTION })?, Some(j)));
        }
        let (before, after) = (self.value(&self.here), self.value(there));
        for (end, beyond) in [(self.range.0, after < self.range.0), (self.range.1, after > self.range.1)] {
            if beyond {
                let f = |s: f64| Some(self.between(there, s, h)?.last()? - end);
                found.push((root::between(f, (0.0, before - end), (h, after - end), RESOLUTION)?, None));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(found)
    }

    fn value(&self, here: &Here) -> f64 {
        self.value_of(&here.w)
    }

    fn value_of(&self, w: &[f64]) -> f64 {
        w.last().copied().unwrap_or(f64::NAN)
    }

    /// The solution a distance `s` along the step to `there`, which is `h` away.
    fn between(&self, there: &Here, s: f64, h: f64) -> Option<Vec<f64>> {
        let guess: Vec<f64> = self.here.w.iter().zip(&there.w).map(|(a, b)| a + (b - a) * (s / h)).collect();
        Some(self.solution(&guess, s)?.0)
    }

    /// How far along the step to `there` the watched function `j` is zero.
    fn zero(&self, j: usize, there: &Here, h: f64, resolution: f64) -> Option<f64> {
        let watch = self.watches[j];
        let value = |s: f64| {
            let w = self.between(there, s, h)?;
            let along = if watch == Watch::Pace { self.tangent_at(&w)? } else { Vec::new() };
            let (osc, ring, flights) = self.equations.flights(&w)?;
            Some(watch.value(&self.equations, &along, &Place { osc: &osc, ring: &ring, flights: &flights }))
        };
        // right at a branch point nothing converges: beside it, then
        let f = |s: f64| value(s).or_else(|| value(s + COARSE)).or_else(|| value(s - COARSE));
        // the sign here is known even where the value is zero to rounding
        let positive = self.signs[j]?;
        let mut at_here = self.here.values[j];
        if sign(at_here) != Some(positive) {
            at_here = if positive { TINY } else { -TINY };
        }
        root::between(f, (0.0, at_here), (h, there.values[j]), resolution)
    }

    /// Passes the events of a step in their order, up to one that changes the signature or ends the branch.
    fn go_through(&mut self, happenings: &[(f64, Option<usize>)], reached: Reached) {
        let Reached { there, length: h, end, .. } = reached;
        for (n, &(s, what)) in happenings.iter().enumerate() {
            let Some(j) = what else {
                return self.end_of_range(&there);
            };
            let watch = self.watches[j];
            let found = match watch {
                Watch::Pace | Watch::PlusOne => self.critical(watch, &there, s, h),
                Watch::MinusOne => self.between(&there, s, h).map(|w| (w, Some(BranchEvent::Flip))),
                _ => self.between(&there, s, h).map(|w| (w, None)),
            };
            // on the verge of a branch point the tangent may be anything: that of the step will do
            let at = found.and_then(|(w, event)| {
                let along = self.tangent_at(&w).unwrap_or_else(|| self.here.tangent.clone());
                Some((Self::look(&self.equations, &self.watches, w, along)?, event))
            });
            let Some((at, event)) = at else {
                return self.finish(BranchEvent::NoConvergence);
            };
            if let Some(event) = event {
                self.emit(&at, event);
                if event.ends() {
                    self.over = true;
                    return;
                }
            } else if watch.needed() && self.here.orbit.physical && !self.options.keep_signature {
                if let Watch::Pull(k) = watch {
                    let impact = self.listed(&at, k);
                    self.emit(&at, BranchEvent::Stick { impact });
                    self.over = true;
                    return;
                }
                return self.graze(&happenings[n..], &at);
            } else if watch.needed() && there.orbit.physical != self.here.orbit.physical {
                let more = happenings[n + 1..].iter().any(|(_, j)| j.is_some_and(|j| self.watches[j].needed()));
                // of several the last makes it a motion, the first makes it none
                match (there.orbit.physical, more) {
                    (true, false) => self.emit(&at, BranchEvent::BecomesPhysical),
                    (false, _) if !happenings[..n].iter().any(|(_, j)| j.is_some_and(|j| self.watches[j].needed())) => {
                        self.emit(&at, BranchEvent::BecomesVirtual);
                    }
                    _ => {}
                }
            }
        }
        if end {
            self.emit(&there, BranchEvent::EndOfRange);
            self.over = true;
        } else {
            self.settle(there);
        }
    }

    /// The unknowns at a fold or a branch point near `s`, and which it is; no event where the parameter turns and the
    /// multiplier that passes +1 says the same.
    ///
    /// At a branch point two curves of solutions cross and the equations are singular, so it is interpolated between four
    /// points beside it.
    fn critical(&self, watch: Watch, there: &Here, s: f64, h: f64) -> Option<(Vec<f64>, Option<BranchEvent>)> {
        let (mut near, mut plus_one, mut pace) = (Vec::new(), Vec::new(), Vec::new());
        for at in FOUR {
            let w = self.between(there, s + at * ASIDE, h)?;
            let along = self.tangent_at(&w)?;
            let (osc, ring, flights) = self.equations.flights(&w)?;
            let place = Place { osc: &osc, ring: &ring, flights: &flights };
            plus_one.push(Watch::PlusOne.value(&self.equations, &along, &place));
            pace.push(Watch::Pace.value(&self.equations, &along, &place));
            near.push(w);
        }
        let crosses = |values: &[f64]| values[0] * values[3] < 0.0;
        let x = match (crosses(&plus_one), crosses(&pace)) {
            (true, true) | (false, false) if watch == Watch::Pace => return Some((near.swap_remove(1), None)),
            (true, false) if watch == Watch::Pace => return Some((near.swap_remove(1), None)),
            (true, true) | (false, false) => {
                let j = self.watches.iter().position(|w| *w == Watch::PlusOne)?;
                let s = self.zero(j, there, h, RESOLUTION)?;
                return Some((self.between(there, s, h)?, Some(BranchEvent::Fold)));
            }
            (false, true) => interpolate::zero(&pace),
            (true, false) => interpolate::zero(&plus_one),
        };
        let column = |i: usize| [near[0][i], near[1][i], near[2][i], near[3][i]];
        let w: Vec<f64> = (0..self.here.w.len()).map(|i| interpolate::at(x, &column(i))).collect();
        let (_, ring) = self.equations.split(&w)?;
        let m = ring.len();
        if m.is_multiple_of(2) && ring.unlike_after(m / 2).is_some_and(|unlike| unlike < ALIKE) {
            let (ring, value) = halved(&self.equations, &ring, self.value_of(&w))?;
            return Some((Varied::join(&ring, value), Some(BranchEvent::Halving)));
        }
        Some((w, Some(BranchEvent::BranchPoint)))
    }

    /// The point on the end of the range.
    fn end_of_range(&mut self, there: &Here) {
        let end = if self.value(there) > self.range.1 { self.range.1 } else { self.range.0 };
        let share = (end - self.value(&self.here)) / (self.value(there) - self.value(&self.here));
        let guess: Vec<f64> = self.here.w.iter().zip(&there.w).map(|(a, b)| a + (b - a) * share).collect();
        let on_end = correct(&self.equations, &guess, &self.equations.parameter_row(), end).and_then(|(mut w, _)| {
            if let Some(value) = w.last_mut() {
                *value = end;
            }
            let along = self.tangent_at(&w)?;
            Self::look(&self.equations, &self.watches, w, along)
        });
        match on_end {
            Some(at) => {
                self.emit(&at, BranchEvent::EndOfRange);
                self.over = true;
            }
            None => self.finish(BranchEvent::NoConvergence),
        }
    }

    /// Adds an event; a motion it is the end of counts as one still.
    fn emit(&mut self, at: &Here, event: BranchEvent) {
        let mut point = self.point(at, Some(event));
        point.physical |= self.here.orbit.physical || event == BranchEvent::BecomesPhysical;
        self.pending.push_back(point);
        self.count += 1;
    }

    /// Ends the branch where it is.
    fn finish(&mut self, event: BranchEvent) {
        let here = self.here.clone();
        self.emit(&here, event);
        self.over = true;
    }

    /// Makes `there` the present point.
    fn settle(&mut self, there: Here) {
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

    /// Where in the list of the point's cycle impact `k` is.
    fn listed(&self, at: &Here, k: usize) -> usize {
        let points = &at.orbit.cycle.points;
        let Some((_, ring)) = self.equations.split(&at.w) else { return k };
        let theta = phase::wrap(ring.theta(k));
        points.iter().position(|p| p.state.phase == theta && p.state.velocity == ring.speed(k)).unwrap_or(k)
    }

    /// A grazing event and what is beyond it: the impacts and touches of this step that happen together.
    fn graze(&mut self, happenings: &[(f64, Option<usize>)], at: &Here) {
        let together = happenings.iter().take_while(|(s, _)| s - happenings[0].0 < TOGETHER);
        let watches: Vec<Watch> = together.filter_map(|(_, j)| j.map(|j| self.watches[j])).collect();
        let gone: Vec<usize> =
            watches.iter().filter_map(|w| if let Watch::Speed(k) = w { Some(*k) } else { None }).collect();
        let mut touches: Vec<_> = watches
            .iter()
            .filter_map(|w| if let Watch::Clear(k, side) = w { Some((*k, *side)) } else { None })
            .collect();
        if !gone.is_empty() {
            // a touch at the same time is that of another turn of the cycle that is left
            touches.clear();
        }
        let Some((osc, ring)) = self.equations.split(&at.w) else {
            return self.finish(BranchEvent::NoConvergence);
        };
        let before = Label::new(u32::try_from(ring.len()).unwrap_or(u32::MAX), ring.periods);
        let (change, k, side) = match (touches.first(), gone.first()) {
            (Some(&(k, side)), _) => (Change::Appears, k, side),
            (None, Some(&k)) => (Change::Disappears, k, ring.side(k)),
            (None, None) => return self.finish(BranchEvent::NoConvergence),
        };
        let phase = match change {
            Change::Appears => {
                let time = crate::orbit::closest(&osc, &ring, k, side).map_or(0.0, |closest| closest.time);
                phase::advance(phase::wrap(ring.theta(k)), osc.beta(), time)
            }
            Change::Disappears => phase::wrap(ring.theta(k)),
        };
        // where the motion without impacts just touches, all impacts of a longer cycle go at once
        if (0..ring.len()).all(|k| ring.speed(k).abs() < AT_REST) {
            self.emit(at, BranchEvent::LossOfContact { side, phase });
            self.over = true;
            return;
        }
        let value = self.value(at);
        let next = beyond(&self.equations, (&osc, &ring, value), &touches, &gone, &at.tangent);
        let Some((Beyond { equations, w, tangent, positive }, after)) = next.and_then(|next| {
            let (_, ring) = next.equations.split(&next.w)?;
            let label = Label::new(u32::try_from(ring.len()).unwrap_or(u32::MAX), ring.periods);
            Some((next, label))
        }) else {
            return self.finish(BranchEvent::NoConvergence);
        };
        let turns = self.equations.pace(&at.tangent) * equations.pace(&tangent) < 0.0;
        let impact = self.listed(at, k);
        let event = BranchEvent::Grazing { change, impact, side, phase, before, after, turns };
        let again = |(v, e): &(f64, BranchEvent)| (v - value).abs() < AGAIN * (1.0 + value.abs()) && alike(e, &event);
        if self.grazed.iter().any(again) {
            self.emit(at, BranchEvent::Closed);
            self.over = true;
            return;
        }
        self.grazed.push((value, event));
        self.emit(at, event);
        if equations.impacts() > self.options.impacts as usize {
            self.here.w = at.w.clone();
            self.here.orbit = at.orbit.clone();
            return self.finish(BranchEvent::ImpactLimit);
        }
        let Some((osc, ring)) = equations.split(&w) else {
            return self.finish(BranchEvent::NoConvergence);
        };
        let watches = Watch::all(&osc, &ring);
        let Some(mut here) = Self::look(&equations, &watches, w, tangent) else {
            return self.finish(BranchEvent::NoConvergence);
        };
        // on the verge a motion may count as none by rounding
        here.orbit.physical = true;
        self.signs = watches
            .iter()
            .zip(&here.values)
            .map(|(watch, &value)| if positive.contains(watch) { Some(true) } else { sign(value) })
            .collect();
        (self.equations, self.watches, self.here) = (equations, watches, here);
        (self.step, self.begin) = (self.options.first, None);
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

/// Whether two grazing events at the same value are the same.
fn alike(a: &BranchEvent, b: &BranchEvent) -> bool {
    use BranchEvent::Grazing;
    match (a, b) {
        (
            Grazing { change, side, phase, before, after, .. },
            Grazing { change: c, side: s, phase: p, before: b, after: a, .. },
        ) => (change, side, before, after) == (c, s, b, a) && phase::difference(*phase, *p).abs() < 1e-6,
        _ => false,
    }
}

/// The sign of a watched value, `None` within rounding of zero.
fn sign(value: f64) -> Option<bool> {
    (value.abs() > ZERO).then_some(value > 0.0)
}

/// Below this a watched value has no sign.
const ZERO: f64 = 1e-11;
/// Stands for a value that is zero to rounding but known to be on one side.
const TINY: f64 = 1e-12;
/// Events are located to this along the step.
const RESOLUTION: f64 = 1e-15;
/// Grazes no further apart than this along the step are one event.
const TOGETHER: f64 = 1e-9;
/// Speeds below this at a grazing event are zero: there they are located to rounding.
const AT_REST: f64 = 1e-6;
/// Grazing events at values closer than this, relative, may be the same.
const AGAIN: f64 = 1e-9;
/// A branch point is looked at this far to either side along the branch.
const ASIDE: f64 = 6e-4;
/// Where, in that unit.
const FOUR: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// How closely folds and branch points are located before they are looked at.
const COARSE: f64 = 3e-5;
/// The halves of a cycle closer than this are the same, at a turn.
const ALIKE: f64 = 1e-5;
/// A corrected point may lie this share of the step off the tangent.
const STRAY: f64 = 0.3;
/// And this much more by rounding.
const NOTHING: f64 = 1e-9;
/// Cosine of the most a step may bend.
const BEND: f64 = 0.95;
/// Cosine of a bend below which the step may grow.
const STRAIGHT: f64 = 0.995;
