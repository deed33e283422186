//! The events on a step of a branch: where they are, and what they are.
//!
//! A watched function has changed sign on the step. Its zero is looked for along the step, every point tried being a
//! converged solution of the equations, so the parameter of an event is right to rounding. A branch point is the exception:
//! there two curves of solutions cross and the equations are singular, so it is interpolated from beside it.

use super::arc::{Equations, correct};
use super::course::{Course, Here, sign};
use super::interpolate;
use super::point::BranchEvent;
use super::root;
use super::step::Reached;
use super::switch::halved;
use super::test_functions::{Place, Watch};
use super::varied::Varied;

impl Course {
    /// What happens on the step to `there`: how far along, and which watched function (`None`: the end of the range).
    pub(super) fn happenings(&self, there: &Here, h: f64) -> Option<Vec<(f64, Option<usize>)>> {
        let mut found = Vec::new();
        for j in self.crosses(there) {
            // folds and branch points are looked at more closely later
            found
                .push((self.zero(j, there, h, if self.watches[j].critical() { COARSE } else { RESOLUTION })?, Some(j)));
        }
        let (before, after) = (self.value(&self.here), self.value(there));
        for (end, beyond) in [(self.range.0, after < self.range.0), (self.range.1, after > self.range.1)] {
            if beyond {
                let f = |s: f64| Some(self.between(there, s, h)?.last()? - end);
                found.push((root::between(f, (0.0, before - end), (h, after - end), RESOLUTION)?, None));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.refine(&mut found, there, h);
        Some(found)
    }

    /// Puts a fold or a branch point that is close to another event in its order: it was located coarsely.
    fn refine(&self, found: &mut [(f64, Option<usize>)], there: &Here, h: f64) {
        let critical = |what: Option<usize>| what.map(|j| self.watches[j]).filter(Watch::critical);
        for k in 0..found.len() {
            let (s, what) = found[k];
            let Some(watch) = critical(what) else { continue };
            let close = |(other, what): &(f64, Option<usize>)| critical(*what).is_none() && (other - s).abs() < CLOSE;
            if found.iter().any(close)
                && let Some((w, Some(_))) = self.critical(watch, there, s, h)
            {
                found[k].0 = self.ahead(&w).unwrap_or(s);
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// How far along the step a point of it is; `None` for a cycle with other impacts.
    fn ahead(&self, w: &[f64]) -> Option<f64> {
        let off: Vec<f64> = w.iter().zip(&self.here.w).map(|(a, b)| a - b).collect();
        (w.len() == self.here.w.len()).then(|| self.equations.dot(&self.here.tangent, &off))
    }

    /// A point between two events of one step, `passed` being what has happened before it: no step ends there, and it is what says
    /// whether the cycle is stable between them. None where the events are too close for their test functions to tell.
    fn amid(&mut self, events: (Option<f64>, f64), passed: &[(f64, Option<usize>)], there: &Here, h: f64) {
        let (Some(from), to) = events else { return };
        let s = 0.5 * (from + to);
        if s <= from || s >= to {
            return;
        }
        let at = self.between(there, s, h).and_then(|w| {
            let along = self.tangent_at(&w)?;
            Self::look(&self.equations, &self.watches, w, along)
        });
        let Some(at) = at else { return };
        let holds = |j: usize| {
            let crossed = passed.iter().any(|(_, what)| *what == Some(j));
            let expected = if crossed { sign(there.values[j]) } else { self.signs[j] };
            expected.is_none_or(|positive| (at.values[j] > 0.0) == positive)
        };
        let told = |j: &usize| matches!(self.watches[*j], Watch::PlusOne | Watch::MinusOne);
        if (0..self.watches.len()).filter(told).all(holds) {
            self.pending.push_back(self.point(&at, None));
            self.count += 1;
        }
    }

    /// The solution a distance `s` along the step to `there`, which is `h` away.
    pub(super) fn between(&self, there: &Here, s: f64, h: f64) -> Option<Vec<f64>> {
        let guess: Vec<f64> = self.here.w.iter().zip(&there.w).map(|(a, b)| a + (b - a) * (s / h)).collect();
        Some(self.solution(&guess, s)?.0)
    }

    /// How far along the step to `there` the watched function `j` is zero.
    pub(super) fn zero(&self, j: usize, there: &Here, h: f64, resolution: f64) -> Option<f64> {
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
    pub(super) fn go_through(&mut self, happenings: &[(f64, Option<usize>)], reached: Reached) {
        let Reached { there, length: h, end, .. } = reached;
        // where the last event of this step is
        let mut last = None;
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
            let place = self.ahead(&at.w).unwrap_or(s);
            if let Some(event) = event {
                self.amid((last.replace(place), place), &happenings[..n], &there, h);
                self.emit(&at, event);
                if event.ends() {
                    self.over = true;
                    return;
                }
            } else if watch.needed() && self.here.orbit.physical && !self.options.keep_signature {
                self.amid((last, place), &happenings[..n], &there, h);
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
    pub(super) fn critical(
        &self,
        watch: Watch,
        there: &Here,
        s: f64,
        h: f64,
    ) -> Option<(Vec<f64>, Option<BranchEvent>)> {
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
    pub(super) fn end_of_range(&mut self, there: &Here) {
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
}

/// Stands for a value that is zero to rounding but known to be on one side.
const TINY: f64 = 1e-12;
/// Events are located to this along the step.
const RESOLUTION: f64 = 1e-15;
/// A branch point is looked at this far to either side along the branch.
const ASIDE: f64 = 6e-4;
/// Where, in that unit.
const FOUR: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// How closely folds and branch points are located before they are looked at.
const COARSE: f64 = 3e-5;
/// A fold or a branch point closer than this to another event is located before the two are put in order.
const CLOSE: f64 = 1e-4;
/// The halves of a cycle closer than this are the same, at a turn.
const ALIKE: f64 = 1e-5;
