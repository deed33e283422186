//! One step of a branch by its equations: how long it may be, and whether it led along the curve.

use super::arc::{Equations, correct};
use super::course::{Course, Here};
use super::free::hides;
use super::point::BranchEvent;

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

impl Course {
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
}

/// A corrected point may lie this share of the step off the tangent.
const STRAY: f64 = 0.3;
/// And this much more by rounding.
const NOTHING: f64 = 1e-9;
/// Cosine of the most a step may bend.
const BEND: f64 = 0.95;
/// Cosine of a bend below which the step may grow.
const STRAIGHT: f64 = 0.995;
