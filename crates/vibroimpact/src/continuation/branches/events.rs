//! The events of a step of a branch, in order.
//!
//! The [tracer](crate::continuation) has located the zeros of the test functions on the step. Branch points are the
//! exception: two curves of solutions cross there and the equations are singular, so a branch point is interpolated
//! from points beside it.

use super::impact_branch::ImpactBranch;
use super::problem::{BranchSolution, RESOLUTION};
use super::switch::halved;
use crate::continuation::equations::cycle_equations::CycleEquations;
use crate::continuation::equations::test_functions::{Place, TestFunction};
use crate::continuation::event::{BranchEvent, EventDetail};
use crate::continuation::trace::interpolate;
use crate::continuation::trace::tracer::{Crossing, Step, last};
use crate::math::sort_by;
use crate::orbit::Orbit;

impl ImpactBranch {
    fn test(&self, j: usize) -> TestFunction {
        self.tracer.problem.tests[j]
    }

    /// Reports the events of a step in order, up to one that changes the signature or ends the branch.
    pub(crate) fn go_through(&mut self, step: Step<Orbit>) {
        let crossed = self.in_order(&step);
        let needed = |what: &Option<usize>, branch: &Self| what.is_some_and(|j| branch.test(j).needed());
        // the distance along the step of its last event
        let mut last = None;
        for (n, &(s, what)) in crossed.iter().enumerate() {
            let Some(j) = what else {
                return self.end_of_range(&step.there);
            };
            let test = self.test(j);
            let found = match test {
                TestFunction::Pace | TestFunction::PlusOne => self.critical(test, &step, s),
                TestFunction::MinusOne => self.tracer.between(&step, s).map(|w| (w, Some(BranchEvent::Flip))),
                _ => self.tracer.between(&step, s).map(|w| (w, None)),
            };
            // close to a branch point the tangent is not determined, so the tangent at the beginning of the step is
            // used
            let at = found.and_then(|(w, event)| {
                let along = self.tracer.tangent_at(&w).unwrap_or_else(|| self.tracer.here.tangent.clone());
                Some((self.tracer.solution_along(w, along)?, event))
            });
            let Some((at, event)) = at else {
                return self.finish(BranchEvent::NoConvergence);
            };
            let place = self.ahead(&at.w).unwrap_or(s);
            let (was, is) = (self.tracer.here.known.physical, step.there.known.physical);
            if let Some(event) = event {
                self.amid((last.replace(place), place), &crossed[..n], &step);
                self.add(&at, Some(event));
                if event.ends() {
                    self.over = true;
                    return;
                }
            } else if test.needed() && was && !self.path.options.keep_signature {
                self.amid((last, place), &crossed[..n], &step);
                if let TestFunction::Pull(k) = test {
                    return self.stick(&at, k);
                }
                return self.graze(&crossed[n..], &at);
            } else if test.needed() && is != was {
                let more = crossed[n + 1..].iter().any(|(_, what)| needed(what, self));
                // of several such events the last one makes the solution admissible, and the first one makes it
                // inadmissible
                match (is, more) {
                    (true, false) => self.add(&at, Some(BranchEvent::BecomesPhysical)),
                    (false, _) if !crossed[..n].iter().any(|(_, what)| needed(what, self)) => {
                        self.add(&at, Some(BranchEvent::BecomesVirtual));
                    }
                    _ => {}
                }
            }
        }
        if step.on_end {
            self.end(&step.there, BranchEvent::EndOfRange);
        } else {
            self.take(step.there);
        }
    }

    /// Ends the part of the branch on which the mass does not stick: without a rebound it stays on the stop after impact `k`.
    fn stick(&mut self, at: &BranchSolution, k: usize) {
        let (impact, cycle) = (self.listed(at, k), &at.known.cycle);
        let event = cycle.points.get(impact).map(|point| {
            let labels = (cycle.label, Some(cycle.label));
            let detail = EventDetail { impact: Some(impact), ..EventDetail::at(point.state.phase, labels) };
            BranchEvent::Sticking { stop: point.state.side.place(), begins: true, detail: Some(detail) }
        });
        self.end(at, event.unwrap_or(BranchEvent::NoConvergence));
    }

    /// The crossings of a step in order. A fold or branch point close to another event is located again first, because
    /// its place along the step is only known coarsely.
    fn in_order(&self, step: &Step<Orbit>) -> Vec<Crossing> {
        let mut found = step.crossed.clone();
        let critical = |what: Option<usize>| what.map(|j| self.test(j)).filter(TestFunction::critical);
        for k in 0..found.len() {
            let (s, what) = found[k];
            let Some(test) = critical(what) else { continue };
            let close = |(other, what): &Crossing| critical(*what).is_none() && (other - s).abs() < CLOSE;
            if found.iter().any(close)
                && let Some((w, Some(_))) = self.critical(test, step, s)
            {
                found[k].0 = self.ahead(&w).unwrap_or(s);
            }
        }
        sort_by(&mut found, |a, b| a.0.total_cmp(&b.0));
        found
    }

    /// The distance of a solution along the step; `None` for a cycle with a different number of impacts.
    fn ahead(&self, w: &[f64]) -> Option<f64> {
        (w.len() == self.tracer.here.w.len()).then(|| self.tracer.ahead(w))
    }

    /// Adds a point halfway between two events of a step, because no step ends there and the point shows whether the
    /// cycle is stable between them; `passed` are the crossings before it. Adds no point if the events are so close
    /// that a multiplier at the point contradicts the events that have been passed.
    fn amid(&mut self, events: (Option<f64>, f64), passed: &[Crossing], step: &Step<Orbit>) {
        let (Some(from), to) = events else { return };
        let s = 0.5 * (from + to);
        if s <= from || s >= to {
            return;
        }
        let Some(at) = self.tracer.at(step, s) else { return };
        let holds = |j: usize| {
            let crossed = passed.iter().any(|(_, what)| *what == Some(j));
            let expected = if crossed { self.tracer.sign(step.there.values[j]) } else { self.tracer.signs[j] };
            expected.is_none_or(|positive| (at.values[j] > 0.0) == positive)
        };
        let told = |j: &usize| matches!(self.test(*j), TestFunction::PlusOne | TestFunction::MinusOne);
        if (0..at.values.len()).filter(told).all(holds) {
            self.add(&at, None);
        }
    }

    /// The unknowns at a fold or branch point near `s`, and the event. A fold is a zero of both test functions and is
    /// reported as the zero of `PlusOne`, without an event for `Pace`. At a branch point only one of them changes sign.
    ///
    /// At a branch point two curves of solutions cross and the equations are singular, so it is interpolated between
    /// four points beside it.
    fn critical(&self, test: TestFunction, step: &Step<Orbit>, s: f64) -> Option<(Vec<f64>, Option<BranchEvent>)> {
        let (mut near, mut plus_one, mut pace) = (Vec::new(), Vec::new(), Vec::new());
        for at in FOUR {
            let w = self.tracer.between(step, s + at * ASIDE)?;
            let along = self.tracer.tangent_at(&w)?;
            let (osc, ring, flights) = self.cycles().flights(&w)?;
            let place = Place { osc: &osc, ring: &ring, flights: &flights };
            plus_one.push(TestFunction::PlusOne.value(self.cycles(), &along, &place));
            pace.push(TestFunction::Pace.value(self.cycles(), &along, &place));
            near.push(w);
        }
        let crosses = |values: &[f64]| values[0] * values[3] < 0.0;
        let x = match (crosses(&plus_one), crosses(&pace)) {
            (true, true) | (false, false) | (true, false) if test == TestFunction::Pace => {
                return Some((near.swap_remove(1), None));
            }
            (true, true) | (false, false) => {
                let j = self.tracer.problem.tests.iter().position(|test| *test == TestFunction::PlusOne)?;
                let s = self.tracer.zero(j, step, RESOLUTION)?;
                return Some((self.tracer.between(step, s)?, Some(BranchEvent::Fold)));
            }
            (false, true) => interpolate::zero(&pace),
            (true, false) => interpolate::zero(&plus_one),
        };
        let column = |i: usize| [near[0][i], near[1][i], near[2][i], near[3][i]];
        let w: Vec<f64> = (0..self.tracer.here.w.len()).map(|i| interpolate::at(x, &column(i))).collect();
        let (_, ring) = self.cycles().split(&w)?;
        let m = ring.len();
        if m.is_multiple_of(2) && ring.unlike_after(m / 2).is_some_and(|unlike| unlike < ALIKE) {
            let (ring, value) = halved(self.cycles(), &ring, last(&w))?;
            return Some((CycleEquations::join(&ring, value), Some(BranchEvent::Halving)));
        }
        Some((w, Some(BranchEvent::BranchPoint)))
    }

    /// Ends the branch at the point on the end of the range.
    fn end_of_range(&mut self, there: &BranchSolution) {
        let (here, (low, high)) = (&self.tracer.here, self.tracer.problem.range);
        let (before, after) = (last(&here.w), last(&there.w));
        let end = if after > high { high } else { low };
        let share = (end - before) / (after - before);
        let guess = self.tracer.chord(there, share);
        match self.tracer.on_end(&guess, end).and_then(|(w, _)| self.tracer.solution(w)) {
            Some(at) => self.end(&at, BranchEvent::EndOfRange),
            None => self.finish(BranchEvent::NoConvergence),
        }
    }
}

/// The unit of distance along the branch of the points from which a branch point is interpolated.
const ASIDE: f64 = 6e-4;
/// The places of these points, in this unit.
const FOUR: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// A fold or branch point closer than this to another event is located again before the events are ordered.
const CLOSE: f64 = 1e-4;
/// If the halves of a cycle differ by less than this where the parameter turns back, the cycle is a shorter one
/// repeated twice.
const ALIKE: f64 = 1e-5;
