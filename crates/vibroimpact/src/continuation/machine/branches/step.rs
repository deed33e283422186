//! The events of a step of a branch of a machine, in order.

use super::at_rest::at_rest;
use super::branch::EventBranch;
use super::change::{Difference, additional, difference, missing_hold};
use super::edge::edge;
use super::halving::halved;
use super::joined::SHORT;
use super::problem::{Judged, MINUS_ONE, MachineSolution, PACE, PLUS_ONE, TORUS};
use super::summed::{of_chatter, sums};
use super::test_functions::TestFunction;
use crate::continuation::event::BranchEvent;
use crate::continuation::trace::equations::Equations;
use crate::continuation::trace::tracer::{Crossing, Problem, Step, last};
use crate::math::{Multiplier, root};
use crate::orbit::RingEvent;
use crate::regime::GuardKind;

impl EventBranch {
    /// Reports the events of a step in order, up to one that changes the signature or ends the branch.
    pub(super) fn go_through(&mut self, step: Step<Judged>) {
        let mut step = self.to_inadmissible(step);
        let mut grazing = self.grazing(&step);
        let mut edge = match &grazing {
            Some(Grazing { before, .. }) => before.and_then(|outside| self.edge(&step, outside)),
            None if step.there.known.physical() => None,
            None => self.edge(&step, step.length),
        };
        // a function that has to be positive can be so again at the end of the step
        if grazing.is_none()
            && let Some((s, ..)) = edge
            && let Some(part) = self.tracer.part(&step, (s + JUST * step.length).min(step.length))
            && let found @ Some(Grazing { before: None, .. }) = self.grazing(&part)
        {
            (step, grazing, edge) = (part, found, None);
        }
        if grazing.is_none() && !step.there.known.physical() && edge.is_none() {
            let here = self.tracer.here.clone();
            if !self.rests(&here) {
                self.finish(BranchEvent::NoConvergence);
            }
            return;
        }
        let crossed = match (&edge, &grazing) {
            // where the derivative is infinite, its test functions change sign without a zero
            (Some((s, ..)), _) => {
                self.tracer.part(&step, s - ASIDE * step.length).map_or_else(Vec::new, |part| part.crossed)
            }
            (None, Some(grazing)) => {
                let until = grazing.s - ASIDE * step.length;
                step.crossed.iter().copied().filter(|(s, _)| *s < until).collect()
            }
            (None, None) => step.crossed.clone(),
        };
        let points = self.points_so_far();
        for crossing in crossed {
            if !self.report(&step, crossing) {
                return;
            }
        }
        if let Some((_, at, found)) = edge {
            return self.pass(&at, &found, None);
        }
        if let Some(Grazing { at, zeros, .. }) = grazing {
            return self.graze(&at, &zeros);
        }
        if self.points_so_far() == points {
            self.pass_together(&step);
        }
        if step.on_end {
            return self.end(&step.there, BranchEvent::EndOfRange);
        }
        self.take(step.there);
        self.adapt();
    }

    /// A step up to the first inadmissible solution that is known on it. Where the derivative is infinite between two admissible
    /// solutions, there are inadmissible ones between them.
    fn to_inadmissible(&self, step: Step<Judged>) -> Step<Judged> {
        let pole = match (crossing(&step, PLUS_ONE), crossing(&step, MINUS_ONE)) {
            (Some(plus), Some(minus)) => step.there.known.physical() && (plus - minus).abs() < TOGETHER,
            _ => false,
        };
        let places = (1..32).map(|k| step.length * f64::from(k) / 32.0);
        let parts = places.filter(|_| pole).filter_map(|s| self.tracer.part(&step, s));
        parts.into_iter().find(|part| !part.there.known.physical()).unwrap_or(step)
    }

    /// The first zero on a step of a function that has to be positive, if solutions beyond it are not admissible.
    fn grazing(&self, step: &Step<Judged>) -> Option<Grazing> {
        let needed = |(_, what): &&Crossing| {
            what.is_some_and(|j| self.tracer.problem.tests[j].needed() && self.tracer.signs[j] == Some(true))
        };
        let &(s, first) = step.crossed.iter().find(needed)?;
        let near = |by: f64| {
            let place = s + by * step.length;
            (0.0 < place && place < step.length).then(|| Some((place, self.tracer.at(step, place)?))).flatten()
        };
        let admissible = |at: &MachineSolution| at.known.physical();
        if near(APART).map_or_else(|| admissible(&step.there), |(_, at)| admissible(&at)) {
            return None;
        }
        let before = near(-APART).filter(|(_, at)| !admissible(at)).map(|(before, _)| before);
        let together = step.crossed.iter().filter(needed).filter(|(other, _)| other - s < TOGETHER);
        let zeros = together.filter_map(|(_, what)| what.map(|j| self.tracer.problem.tests[j])).collect();
        // at the zero itself the equations can be singular to rounding
        let w = CLOSE.into_iter().find_map(|by| self.tracer.between(step, s + by * step.length))?;
        // where an event is at the least gap, rounding decides whether a flight has that gap, and its function changes its sign by a jump
        let is_zero = |j: usize| self.tracer.problem.test(j, &w, || None).is_none_or(|value| value.abs() < ZERO);
        let beside = |j: usize, by: f64| {
            let w = self.tracer.between(step, s + by * step.length)?;
            self.tracer.problem.test(j, &w, || None)
        };
        let jumps = |j: usize| [-CLOSE_BY, CLOSE_BY].iter().any(|by| beside(j, *by).is_some_and(f64::is_infinite));
        if !first.is_none_or(|j| is_zero(j) && !jumps(j)) {
            return None;
        }
        // rounding decides which events the motion has here, and the number can turn: a solution just before stands for it
        let last = self.just_before(step, s).unwrap_or_else(|| self.tracer.here.clone());
        let at = MachineSolution { w, ..last };
        Some(Grazing { s, at, zeros, before })
    }

    /// An admissible solution before a zero at the distance `s` on a step, not farther than twice as far as rounding demands.
    fn just_before(&self, step: &Step<Judged>, s: f64) -> Option<MachineSolution> {
        let (mut found, [mut admissible, mut rounded]) = (None, HALVINGS);
        while rounded - admissible > 1 {
            let halvings = i32::midpoint(admissible, rounded);
            let place = s - libm::ldexp(step.length, -halvings);
            let at = (place > 0.0).then(|| self.tracer.at(step, place)).flatten();
            match at.filter(|at| at.known.physical()) {
                Some(at) => (found, admissible) = (Some(at), halvings),
                None if place > 0.0 => rounded = halvings,
                None => admissible = halvings,
            }
        }
        found
    }

    /// The determinant of the equations with the tangent: where it changes its sign, another curve of solutions crosses.
    fn orientation(&self, at: &MachineSolution) -> Option<f64> {
        let equations = &self.tracer.problem.equations;
        let (_, mut rows) = equations.at(&at.w)?;
        let length = at.w.len();
        rows[length * (length - 1)..].copy_from_slice(&equations.row(&at.tangent));
        Some(equations.factors(rows)?.determinant())
    }

    /// The distance along a step at which another curve of solutions crosses, near `s`; `None` if none does.
    fn crosses(&self, step: &Step<Judged>, s: f64) -> Option<f64> {
        let (here, there) = (self.orientation(&self.tracer.here)?, self.orientation(&step.there)?);
        if here * there >= 0.0 {
            return None;
        }
        let value = |s: f64| self.orientation(&self.tracer.at(step, s)?);
        Some(root::between(value, (0.0, here), (step.length, there), FINE * step.length).unwrap_or(s))
    }

    /// Reports the event at a crossing, if it is one; returns whether the branch goes on.
    fn report(&mut self, step: &Step<Judged>, (s, what): Crossing) -> bool {
        let event = match what {
            None => {
                let at = self.on_end(step, s).unwrap_or_else(|| self.tracer.here.clone());
                self.end(&at, BranchEvent::EndOfRange);
                return false;
            }
            Some(PACE) if crossing(step, PLUS_ONE).is_some() => return true,
            Some(PACE) => {
                if let Some(at) = self.halving(step, s) {
                    self.end(&at, BranchEvent::Halving);
                    return false;
                }
                // a branch of cycles without a symmetry turns back where that of symmetric ones crosses it
                if let Some(s) = self.crosses(step, s) {
                    if let Some(at) = self.located(step, s, BranchEvent::BranchPoint)
                        && off_circle(&at.known.multipliers, BranchEvent::BranchPoint) < NEARBY
                    {
                        self.add(&at, Some(BranchEvent::BranchPoint));
                    }
                    return true;
                }
                // of a machine twice beside itself two multipliers pass 1, and their product does not change its sign
                match self.located(step, s, BranchEvent::Fold) {
                    Some(at) if off_circle(&at.known.multipliers, BranchEvent::Fold) < NEARBY => {
                        self.add(&at, Some(BranchEvent::Fold));
                    }
                    _ => {}
                }
                return true;
            }
            Some(PLUS_ONE) if self.crosses(step, s).is_none() => BranchEvent::Fold,
            Some(PLUS_ONE) => BranchEvent::BranchPoint,
            Some(MINUS_ONE) => BranchEvent::Flip,
            Some(TORUS) => BranchEvent::Torus,
            Some(_) => return true,
        };
        if let Some(at) = self.located(step, s, event)
            && is_at(&at.known.multipliers, event)
        {
            self.add(&at, Some(event));
        }
        true
    }

    /// The solution on the end of the range that is crossed near the distance `s` on a step.
    fn on_end(&self, step: &Step<Judged>, s: f64) -> Option<MachineSolution> {
        let (low, high) = self.tracer.problem.range;
        let end = if last(&step.there.w) > high { high } else { low };
        let (w, _) = self.tracer.on_end(&self.tracer.between(step, s)?, end)?;
        self.tracer.solution(w)
    }

    /// The solution at an event near the distance `s` on a step. Where another curve of solutions crosses, the equations are
    /// singular, and rounding decides whether they can be solved there; then it is one beside its place.
    fn located(&self, step: &Step<Judged>, s: f64, event: BranchEvent) -> Option<MachineSolution> {
        let singular = event == BranchEvent::BranchPoint;
        let s = if singular { self.branch_point(step, s) } else { s };
        let beside = |share: f64| self.tracer.between(step, (s + share * step.length).clamp(0.0, step.length));
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
        let shares = if singular { &BESIDE[SINGULAR..] } else { &BESIDE };
        shares.iter().copied().find_map(solved)
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
        let w = self.tracer.between(step, s).unwrap_or_else(|| self.tracer.chord(&step.there, s / step.length));
        halved(&self.tracer.problem, &self.tracer.here, &w)
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
        let found = of_chatter(&self.tracer, &inside, found);
        if let Some((at, found)) = self.interrupted(&inside, &found) {
            return Some((s, at, found));
        }
        Some((s, inside, found))
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
        let here = |at: &MachineSolution| (last(&at.w) - last(&inside.w)).abs() <= HERE * equations.scales[0];
        (0..stops + machine.joints().len()).find_map(|place| {
            let rest = Difference::Rest { place, joint: place >= stops, begins: false };
            at_rest(&self.tracer, inside, &rest).filter(|(at, _)| here(at))
        })
    }
}

/// A zero on a step of functions that have to be positive.
struct Grazing {
    /// The distance along the step.
    s: f64,
    at: MachineSolution,
    /// The functions that are zero there.
    zeros: Vec<TestFunction>,
    /// An inadmissible solution before it.
    before: Option<f64>,
}

/// The distance, in parts of a step, from such a zero of the solutions that are compared.
const APART: f64 = 1e-2;
/// Distances, in parts of a step, at which a solution stands for one at such a zero.
const CLOSE: [f64; 5] = [0.0, 1e-12, -1e-12, 1e-10, -1e-10];
/// Halvings of a step to the distances from such a zero between which the least one is that rounding allows.
const HALVINGS: [i32; 2] = [6, 48];
/// A function that has to be positive is zero below this, unless it jumps to infinity so close by, in parts of a step.
const ZERO: f64 = 1e-7;
const CLOSE_BY: f64 = 1e-8;
/// The distance, in parts of a step, of a solution just beyond the last admissible one.
const JUST: f64 = 1e-4;
/// The resolution, in parts of a step, to which it is known where another curve crosses.
const FINE: f64 = 1e-7;
/// Zeros not farther apart than this along the step are one event.
const TOGETHER: f64 = 1e-9;

/// The distance along a step at which a test function is zero.
fn crossing(step: &Step<Judged>, test: usize) -> Option<f64> {
    step.crossed.iter().find(|(_, what)| *what == Some(test)).map(|(s, _)| *s)
}

/// How far the multiplier of a bifurcation is from its place on the unit circle; infinite for other events.
pub(super) fn off_circle(multipliers: &[Multiplier], event: BranchEvent) -> f64 {
    let off = |m: &Multiplier| match event {
        BranchEvent::Fold | BranchEvent::BranchPoint | BranchEvent::Halving => (m.re - 1.0).abs() + m.im.abs(),
        BranchEvent::Flip => (m.re + 1.0).abs() + m.im.abs(),
        BranchEvent::Torus if m.im != 0.0 => (m.modulus() - 1.0).abs(),
        _ => f64::INFINITY,
    };
    multipliers.iter().map(off).fold(f64::INFINITY, f64::min)
}

/// Whether the multipliers are those of an event that its test function shows.
fn is_at(multipliers: &[Multiplier], event: BranchEvent) -> bool {
    match event {
        BranchEvent::Torus => multipliers.iter().any(|m| m.is_on_circle()),
        // beside a grazing contact one multiplier is so large that rounding decides the sign of the determinants
        BranchEvent::BranchPoint | BranchEvent::Flip => off_circle(multipliers, event) < NEARBY,
        _ => true,
    }
}

/// How far from 1 or -1 a multiplier is at most at a bifurcation, which is located to rounding.
pub(super) const NEARBY: f64 = 0.1;
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
