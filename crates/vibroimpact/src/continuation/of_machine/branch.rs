//! The branch of a cycle of a machine in one of its numbers.

use super::at_rest::at_rest;
use super::beginning::{begun, last};
use super::beyond::{across, beyond, replayed, same_beyond, with_ring};
use super::change::{Difference, additional, difference, missing_hold};
use super::complete_chatter::{ADAPTED, CompleteChatter};
use super::edge::edge;
use super::equations::MachineEquations;
use super::family::MachineFamily;
use super::halving::halved;
use super::joined::SHORT;
use super::meeting::meeting;
use super::point::{MachineBranchEvent, MachinePoint};
use super::problem::{Judged, MINUS_ONE, MachineProblem, MachineSolution, PACE, PLUS_ONE, TORUS};
use super::summed::{of_chatter, sums};
use super::touch::{grazing, touching};
use crate::continuation::branches::{BranchOptions, Direction};
use crate::continuation::trace::tracer::{Crossing, Problem, Step, Tracer};
use crate::math::{Multiplier, sort_by};
use crate::orbit::{Chatter, MachineCycle, MachineFrame, MachineRing, RingEvent};
use crate::regime::GuardKind;
use core::ops::RangeInclusive;
use std::collections::VecDeque;
use thiserror::Error;

/// Why a branch of a machine cannot begin.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MachineBranchError {
    /// The range is not two finite numbers in increasing order, or does not contain the value of the machine.
    #[error("the branch begins at {value}, which does not lie in the range from {low} to {high}")]
    OutOfRange {
        /// The value of the machine.
        value: f64,
        /// Lower end of the range.
        low: f64,
        /// Upper end of the range.
        high: f64,
    },
    /// The cycle has no events, or Newton's method does not converge from it.
    #[error(
        "the orbit cannot be followed from here: it has no events, or its equations have no single curve of solutions close by\nhint: begin a little beside a bifurcation or a grazing contact"
    )]
    NoCycle,
}

/// A branch: an iterator over its points, including its events. The last point has an event that
/// [ends](MachineBranchEvent::ends) the branch.
#[derive(Clone, Debug)]
pub struct MachineBranch {
    options: BranchOptions,
    pub(super) tracer: Tracer<MachineProblem>,
    begin: Option<MachineSolution>,
    /// The changes of the events so far, with the number of unknowns and the direction; at the second one of a kind the
    /// branch is closed.
    passed: Vec<(f64, usize, bool, MachineBranchEvent)>,
    count: u32,
    pending: VecDeque<MachinePoint>,
    over: bool,
}

impl MachineBranch {
    /// The branch of `cycle`, a cycle of the machine of `family` at `value`, over `range`, beginning in `direction`. In the
    /// options the largest number of impacts is not used.
    ///
    /// # Errors
    /// [`MachineBranchError`] if the branch cannot begin.
    pub fn new(
        (family, value): (&MachineFamily, f64),
        cycle: &MachineCycle,
        range: &RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, MachineBranchError> {
        let (low, high) = (*range.start(), *range.end());
        if !(low.is_finite() && high.is_finite() && low < high && range.contains(&value)) {
            return Err(MachineBranchError::OutOfRange { value, low, high });
        }
        let machine = &family.at(value).ok_or(MachineBranchError::NoCycle)?;
        let ring = cycle
            .strobes
            .first()
            .and_then(|begin| MachineRing::of(&MachineFrame::new(machine), begin, (cycle.label.periods, cycle.period)))
            .ok_or(MachineBranchError::NoCycle)?;
        let equations = MachineEquations::new((machine, family.clone()), ring, cycle.sizes, 0.25 * (high - low));
        let up = if direction == Direction::Up { 1.0 } else { -1.0 };
        let problem = MachineProblem { equations, range: (low, high) };
        let w = MachineEquations::join(machine, &problem.equations.ring, value);
        let tracer = begun(problem, &w, value, up, options).ok_or(MachineBranchError::NoCycle)?;
        let first = Self::point(&tracer.here, None).ok_or(MachineBranchError::NoCycle)?;
        let begin = Some(tracer.here.clone());
        Ok(Self { options, tracer, begin, passed: Vec::new(), count: 1, pending: VecDeque::from([first]), over: false })
    }

    fn point(at: &MachineSolution, event: Option<MachineBranchEvent>) -> Option<MachinePoint> {
        let cycle = at.known.cycle.clone()?;
        Some(MachinePoint { value: last(&at.w), cycle, event })
    }

    /// Adds a point. An ordinary one with which the largest number is reached ends the branch.
    fn add(&mut self, at: &MachineSolution, event: Option<MachineBranchEvent>) {
        let last_one = event.is_none() && self.count + 1 >= self.options.points;
        let event = if last_one { Some(MachineBranchEvent::StepLimit) } else { event };
        self.over |= last_one;
        // at an event rounding can make a solution inadmissible: the cycle of the last point stands for it
        let cycle = at.known.cycle.clone().or_else(|| self.tracer.here.known.cycle.clone());
        if let Some(cycle) = cycle {
            self.pending.push_back(MachinePoint { value: last(&at.w), cycle, event });
            self.count += 1;
        }
    }

    fn end(&mut self, at: &MachineSolution, event: MachineBranchEvent) {
        self.add(at, Some(event));
        self.over = true;
    }

    fn advance(&mut self) {
        let here = self.tracer.here.clone();
        if self.count >= self.options.points {
            return self.end(&here, MachineBranchEvent::StepLimit);
        }
        match self.tracer.step() {
            Some(step) => self.go_through(step),
            None => {
                // the events change so close by that no step ends before
                let (at, found) = meeting(&self.tracer).unwrap_or((here, Difference::Other { place: None }));
                match replayed(&self.tracer, &at, (&self.options, &found)) {
                    Some(next) => self.go_on(&at, found.event(false), (next, None)),
                    None => match across(&self.tracer, &at, &self.options) {
                        Some(next) => self.jump(&at, &found, Some(next)),
                        None => self.end(&at, MachineBranchEvent::NoConvergence),
                    },
                }
            }
        }
    }

    /// Reports the events of a step in order, up to one that changes the signature or ends the branch.
    fn go_through(&mut self, step: Step<Judged>) {
        // where the derivative is infinite between two admissible solutions, there are inadmissible ones
        let at = |test: usize| step.crossed.iter().find(|(_, what)| *what == Some(test)).map(|(s, _)| *s);
        let pole = at(PLUS_ONE).zip(at(MINUS_ONE)).is_some_and(|(a, b)| (a - b).abs() < 1e-9);
        let outside =
            if step.there.known.physical() { pole.then(|| self.hidden(&step)).flatten() } else { Some(step.length) };
        let edge = outside.and_then(|outside| self.edge(&step, outside));
        if !step.there.known.physical() && edge.is_none() {
            let here = self.tracer.here.clone();
            return self.end(&here, MachineBranchEvent::NoConvergence);
        }
        // at a grazing impact a multiplier is without limit, and its test functions change sign without a zero
        let until = edge.as_ref().map_or(f64::INFINITY, |(s, ..)| s - ASIDE * step.length);
        let mut crossed: Vec<Crossing> = step.crossed.iter().copied().filter(|(s, _)| *s < until).collect();
        if edge.is_some()
            && until > 0.0
            && let Some(inside) = self.tracer.between(&step, until).and_then(|w| self.tracer.solution(w))
        {
            crossed.extend(self.tracer.hidden(&[PLUS_ONE, MINUS_ONE, TORUS], &crossed, (until, &inside)));
            sort_by(&mut crossed, |a, b| a.0.total_cmp(&b.0));
        }
        for (s, what) in &crossed {
            let event = match what {
                None => {
                    let (low, high) = self.tracer.problem.range;
                    let end = if last(&step.there.w) > high { high } else { low };
                    let guess = self.tracer.between(&step, *s);
                    let at = guess.and_then(|w| self.tracer.on_end(&w, end)).and_then(|(w, _)| self.tracer.solution(w));
                    let at = at.unwrap_or_else(|| self.tracer.here.clone());
                    return self.end(&at, MachineBranchEvent::EndOfRange);
                }
                Some(PACE) if at(PLUS_ONE).is_some() => continue,
                Some(PACE) => {
                    if let Some(at) = self.halving(&step, *s) {
                        return self.end(&at, MachineBranchEvent::Halving);
                    }
                    continue;
                }
                Some(PLUS_ONE) if at(PACE).is_some() => MachineBranchEvent::Fold,
                Some(PLUS_ONE) => MachineBranchEvent::BranchPoint,
                Some(MINUS_ONE) => MachineBranchEvent::Flip,
                Some(_) => MachineBranchEvent::Torus,
            };
            // where another curve of solutions crosses, the equations are singular, and rounding decides whether they can be
            // solved there; then the event is reported beside its place
            let s = if event == MachineBranchEvent::BranchPoint { self.branch_point(&step, *s) } else { *s };
            let beside = |share: f64| self.tracer.between(&step, (s + share * step.length).clamp(0.0, step.length));
            let solved = |share: f64| {
                let one = beside(share)?;
                let along = self.tracer.tangent_at(&one).unwrap_or_else(|| self.tracer.here.tangent.clone());
                // half way between the solutions on both sides
                let other = if share == 0.0 { None } else { beside(-share) };
                let middle = |other: Vec<f64>| {
                    let w = one.iter().zip(&other).map(|(a, b)| 0.5 * (a + b)).collect();
                    self.tracer.solution_along(w, along.clone())
                };
                other.and_then(middle).or_else(|| self.tracer.solution_along(one, along))
            };
            let shares = if event == MachineBranchEvent::BranchPoint { &BESIDE[SINGULAR..] } else { &BESIDE };
            let Some(at) = shares.iter().copied().find_map(solved) else { continue };
            let any = |test: &dyn Fn(&Multiplier) -> bool| at.known.multipliers.iter().any(test);
            let near = |value: f64| any(&|m| (m.re - value).abs() + m.im.abs() < NEARBY);
            let real = match event {
                // two real multipliers whose product is 1 are no torus bifurcation
                MachineBranchEvent::Torus => any(&|m| m.im.abs() > 1e-6 && (m.modulus() - 1.0).abs() < 1e-6),
                // beside a grazing contact one multiplier is so large that rounding decides the sign of the determinants
                MachineBranchEvent::BranchPoint => near(1.0),
                MachineBranchEvent::Flip => near(-1.0),
                _ => true,
            };
            if real {
                self.add(&at, Some(event));
            }
        }
        if let Some((_, at, found)) = edge {
            return self.pass(&at, &found);
        }
        if step.on_end {
            return self.end(&step.there, MachineBranchEvent::EndOfRange);
        }
        let closed = self.count > 3 && self.begin.as_ref().is_some_and(|begin| self.tracer.closes(begin, &step.there));
        self.add(&step.there, closed.then_some(MachineBranchEvent::Closed));
        self.tracer.take(step.there);
        self.over |= closed;
        self.adapt();
    }

    /// The distance along a step of a branch point close to `s`. Around it the equations are nearly singular, so that it was only
    /// located within a small distance; to both sides of this the test function is linear to about its square.
    fn branch_point(&self, step: &Step<Judged>, s: f64) -> f64 {
        let by = 1e-4 * step.length;
        let test = |s: f64| self.tracer.problem.test(PLUS_ONE, &self.tracer.between(step, s)?, || None);
        match (test(s - by), test(s + by)) {
            (Some(a), Some(b)) if a * b < 0.0 => s + by * (a + b) / (a - b),
            _ => s,
        }
    }

    /// The solution at which the number turns back and a cycle repeats itself after half its period.
    fn halving(&self, step: &Step<Judged>, s: f64) -> Option<MachineSolution> {
        let w = self.tracer.between(step, s).unwrap_or_else(|| {
            let share = s / step.length;
            self.tracer.here.w.iter().zip(&step.there.w).map(|(a, b)| a + (b - a) * share).collect()
        });
        halved(&self.tracer.problem, &self.tracer.here, &w)
    }

    /// An inadmissible solution within a step.
    fn hidden(&self, step: &Step<Judged>) -> Option<f64> {
        (1..32).map(|k| step.length * f64::from(k) / 32.0).find(|s| {
            let at = self.tracer.between(step, *s).and_then(|w| self.tracer.solution(w));
            at.is_none_or(|solution| !solution.known.physical())
        })
    }

    /// The last admissible solution before an inadmissible one on a step: its distance, the solution, and how the events
    /// differ beyond it.
    fn edge(&self, step: &Step<Judged>, outside: f64) -> Option<(f64, MachineSolution, Difference)> {
        let (s, inside, beyond) = edge(&self.tracer, step, outside, Judged::physical)?;
        let ring = &self.tracer.problem.equations.ring;
        let found = difference(ring, &beyond);
        if let Some(place) = self.ceases(&inside, &beyond) {
            return Some((s, inside, Difference::Rest { place, joint: true, begins: false }));
        }
        if let Some((at, found)) = at_rest(&self.tracer, &inside, &found) {
            return Some((s, at, found));
        }
        let found = match found {
            // one more impact of a chatter before it is summed is no other event
            Difference::Rest { place, .. } => additional(ring, &beyond)
                .filter(|more| !matches!(*more, Difference::Appears { stop, .. } if stop == place && sums(ring, stop)))
                .unwrap_or(found),
            _ => found,
        };
        let found = grazing(&self.tracer, &inside, found);
        let found = of_chatter(&self.tracer, &inside, found);
        if let Some((at, found)) = self.interrupted(&inside, &found) {
            return Some((s, at, found));
        }
        let (s, at) = touching(&self.tracer, step, (s, &inside), &found).unwrap_or((s, inside));
        Some((s, at, found))
    }

    /// The joint of a hold that lasts for some time and is missing beyond, because the velocity of its joint only touches zero at
    /// its beginning. Then it slips on only if its static limit exceeds its sliding force: otherwise a hold begins
    /// and ends with no length.
    fn ceases(&self, inside: &MachineSolution, beyond: &Judged) -> Option<usize> {
        let ring = &self.tracer.problem.equations.ring;
        let event = beyond.rising.or_else(|| missing_hold(ring, beyond))?;
        let RingEvent { guard: GuardKind::Sliding(joint), after, back, .. } = &ring.events[event] else { return None };
        let place = back.len() + joint;
        let (machine, _) = self.tracer.problem.equations.split(&inside.w)?;
        let sticks = &machine.joints()[*joint];
        let holds = after[place].constrains() && sticks.limit > sticks.sliding;
        (holds && ring.theta(event + 1) - ring.theta(event) > SHORT).then_some(place)
    }

    /// The solution at which a rest or a hold begins or ends, if this explains a change of the events that shows elsewhere:
    /// a hold that is interrupted changes all that follows.
    fn interrupted(&self, inside: &MachineSolution, found: &Difference) -> Option<(MachineSolution, Difference)> {
        matches!(found, Difference::Other { .. }).then_some(())?;
        let equations = &self.tracer.problem.equations;
        let machine = equations.family.at(last(&inside.w))?;
        let stops = machine.stops().len();
        let here = |at: &MachineSolution| (last(&at.w) - last(&inside.w)).abs() <= HERE * equations.scale;
        (0..stops + machine.joints().len()).find_map(|place| {
            let rest = Difference::Rest { place, joint: place >= stops, begins: false };
            at_rest(&self.tracer, inside, &rest).filter(|(at, _)| here(at))
        })
    }

    /// The stop of the only impact of a cycle, if this impact disappears.
    fn lost(&self, at: &MachineSolution, found: &Difference) -> Option<usize> {
        let Difference::Disappears { stop, .. } = *found else { return None };
        let single = at.known.cycle.as_ref().is_some_and(|cycle| cycle.counts.iter().sum::<u32>() == 1);
        (single && self.tracer.problem.equations.ring.len() <= 2).then_some(stop)
    }

    /// Reports the change of the events at `at` and goes on with the events beyond.
    fn pass(&mut self, at: &MachineSolution, found: &Difference) {
        if let Some(stop) = self.lost(at, found) {
            return self.end(at, MachineBranchEvent::LossOfContact { stop });
        }
        // how many impacts of a chatter are followed is no property of the cycle
        if matches!(found, Difference::Rest { joint: false, .. } | Difference::Other { .. })
            && let Some(next) = same_beyond(&self.tracer, at, &self.options)
        {
            self.tracer = next;
            self.begin = None;
            return;
        }
        let Some(next) = beyond(&self.tracer, at, found, &self.options) else {
            let next = across(&self.tracer, at, &self.options);
            return self.jump(at, found, next);
        };
        let turns = last(&next.here.tangent) * last(&at.tangent) < 0.0;
        let (ring, other) = (&self.tracer.problem.equations.ring, &next.problem.equations.ring);
        // a chatter that is complete on one side only
        let chatters = |ring: &MachineRing, stop| Chatter::all(ring).iter().filter(|own| own.stop == stop).count();
        let event = match *found {
            Difference::Rest { place, joint: false, .. }
                if chatters(ring, place) > 0 && chatters(ring, place) == chatters(other, place) =>
            {
                MachineBranchEvent::Change { place: Some(place) }
            }
            Difference::Other { .. } => opened(ring, other)
                .map_or(found.event(turns), |(stop, appears)| MachineBranchEvent::Grazing { stop, appears, turns }),
            _ => found.event(turns),
        };
        let complete = (0..ring.events.first().map_or(0, |event| event.back.len())).find_map(|stop| {
            let (here, there) = (chatters(ring, stop), chatters(other, stop));
            let begins = here < there;
            let (equations, complete) =
                if begins { (&next.problem.equations, &next.here) } else { (&self.tracer.problem.equations, at) };
            let value = (here != there).then(|| CompleteChatter::value_of_number(equations, complete, stop))??;
            let mut at = at.clone();
            *at.w.last_mut()? = value;
            Some((at, MachineBranchEvent::Sticking { stop, begins }))
        });
        let (at, event) = complete.unwrap_or_else(|| (at.clone(), event));
        self.go_on(&at, event, (next, None));
    }

    /// Changes the number of impacts of chatters in the signature where too much of them is left out, or too little.
    fn adapt(&mut self) {
        let other = |tracer: &Tracer<MachineProblem>| {
            let (machine, mut ring) = tracer.problem.equations.split(&tracer.here.w)?;
            Chatter::adapt(&MachineFrame::new(&machine), &mut ring)?;
            let problem = with_ring(tracer, &machine, ring, tracer.here.known.cycle.as_ref()?.sizes);
            let number = last(&tracer.here.w);
            let w = MachineEquations::join(&machine, &problem.equations.ring, number);
            let mut next = begun(problem, &w, number, last(&tracer.here.tangent).signum(), self.options)?;
            next.step = tracer.step;
            next.here.known.physical().then_some(next)
        };
        for _ in 0..ADAPTED {
            let Some(next) = other(&self.tracer) else { break };
            self.tracer = next;
        }
    }

    /// Reports an event and goes on with the cycles beyond, which may not continue those before.
    fn jump(&mut self, at: &MachineSolution, found: &Difference, next: Option<(Tracer<MachineProblem>, bool)>) {
        let Some((next, continues)) = next else {
            self.add(at, Some(found.event(false)));
            let end = match found {
                Difference::Rest { joint: true, .. } => MachineBranchEvent::Discontinuity,
                _ => MachineBranchEvent::NoConvergence,
            };
            return self.end(at, end);
        };
        let event = found.event(last(&next.here.tangent) * last(&at.tangent) < 0.0);
        self.go_on(at, event, (next, (!continues).then_some(MachineBranchEvent::Jump)));
    }

    /// Reports an event and goes on with another tracer. The branch is closed if the same event was there before.
    fn go_on(
        &mut self,
        at: &MachineSolution,
        event: MachineBranchEvent,
        (next, landing): (Tracer<MachineProblem>, Option<MachineBranchEvent>),
    ) {
        let here = (last(&at.w), at.w.len(), last(&at.tangent) > 0.0, event);
        let near = 1e-9 * self.tracer.problem.equations.scale;
        let before = |known: &(f64, usize, bool, MachineBranchEvent)| {
            (known.0 - here.0).abs() < near && (known.1, known.2, known.3) == (here.1, here.2, here.3)
        };
        if self.passed.iter().any(before) {
            return self.end(at, MachineBranchEvent::Closed);
        }
        self.passed.push(here);
        self.add(at, Some(event));
        self.tracer = next;
        self.begin = None;
        let here = self.tracer.here.clone();
        self.add(&here, landing);
    }
}

/// The stop, if the only difference of two signatures is that a closed stop opens and closes again in one of them, and whether it does
/// in the second one. At the event between both it only loses its force.
fn opened(ring: &MachineRing, other: &MachineRing) -> Option<(usize, bool)> {
    let guards = |ring: &MachineRing| ring.events.iter().map(|event| event.guard).collect::<Vec<_>>();
    let (few, many) = (guards(ring), guards(other));
    let (appears, few, many) = if few.len() < many.len() { (true, few, many) } else { (false, many, few) };
    let m = many.len();
    if few.len() + 2 != m {
        return None;
    }
    (0..m).find_map(|k| {
        let (GuardKind::Depth(stop) | GuardKind::Force(stop)) = many[k] else { return None };
        let rest: Vec<GuardKind> = (2..m).map(|i| many[(k + i) % m]).collect();
        let same = (0..few.len()).any(|shift| (0..few.len()).all(|i| few[(i + shift) % few.len()] == rest[i]));
        (many[(k + 1) % m] == GuardKind::Gap(stop) && same).then_some((stop, appears))
    })
}

/// How far from 1 or -1 a multiplier is at most at a bifurcation, which is located to rounding.
const NEARBY: f64 = 0.1;
/// Values of the number that differ by less, in its scale, are those of one event.
const HERE: f64 = 1e-7;
/// The distance, in parts of a step, from a grazing solution to that at which the signs of test functions are compared
/// with those at the beginning.
const ASIDE: f64 = 1e-6;
/// Parts of a step by which an event may be moved where its equations are singular.
const BESIDE: [f64; 7] = [0.0, 1e-8, -1e-8, 1e-6, -1e-6, 1e-4, -1e-4];
/// The place in this list from which solutions at branch points are accurate: the error of a solution is a rounding error over the
/// distance, that of the middle of two the square of the distance.
const SINGULAR: usize = 5;

impl Iterator for MachineBranch {
    type Item = MachinePoint;

    fn next(&mut self) -> Option<MachinePoint> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}
