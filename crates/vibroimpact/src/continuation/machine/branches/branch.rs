//! The branch of a cycle of a machine in one of its numbers.

use super::beginning::begun;
use super::beyond::{across, apart, from_first, replayed, same_beyond};
use super::change::Difference;
use super::complete_chatter::{ADAPTED, CompleteChatter};
use super::equations::MachineEquations;
use super::explained::{explained, same_events};
use super::family::Family;
use super::joined::SHORT;
use super::meeting::meeting;
use super::point::{SolutionPoint, without_speed};
use super::problem::{Judged, MachineProblem, MachineSolution};
use super::rest_for_ever::rest_for_ever;
use super::step::{NEARBY, off_circle};
use super::struck::struck;
use super::test_functions::TestFunction;
use super::through::{through_ending, through_grazing, through_hold, through_turn, with_ring};
use crate::continuation::branches::{BranchError, BranchOptions, Direction, scale};
use crate::continuation::event::BranchEvent;
use crate::continuation::trace::driver::{Driver, Path};
use crate::continuation::trace::tracer::{Step, Tracer, last};
use crate::machine::StopLaw;
use crate::math::dot;
use crate::orbit::{Chatter, MachineFrame, MachineRing, Push, RingEvent, machine::Cycle};
use crate::regime::{Normal, independent};
use core::ops::RangeInclusive;

/// A branch by the equations of the machine.
#[derive(Clone, Debug)]
pub(crate) struct UnreducedBranch(EventBranch);

/// What a branch keeps beside its tracer.
#[derive(Clone, Debug)]
pub(super) struct EventPath {
    options: BranchOptions,
    /// The changes of the events so far. At the second one of a kind the branch is closed.
    passed: Vec<Passed>,
    /// Whether a jump led to where the branch is now: it can lead to where it was before.
    jumped: bool,
}

pub(super) type EventBranch = Driver<EventPath>;

/// A change of the events on a branch.
#[derive(Clone, Debug)]
struct Passed {
    number: f64,
    /// The signature before it.
    ring: MachineRing,
    unknowns: usize,
    rises: bool,
    event: BranchEvent,
}

impl Path for EventPath {
    type Problem = MachineProblem;
    type Event = BranchEvent;
    type Point = SolutionPoint;

    const EXACT: bool = true;

    /// At an event rounding can make a solution inadmissible: the cycle of the last point stands for it.
    fn point(branch: &EventBranch, at: &MachineSolution, event: Option<BranchEvent>) -> Option<SolutionPoint> {
        let mut cycle = at.known.cycle.clone().or_else(|| branch.tracer.here.known.cycle.clone())?;
        // at a bifurcation a multiplier is on the unit circle, to the error of the place where it was located
        let off = event.map_or(f64::INFINITY, |event| off_circle(&cycle.multipliers, event));
        if off < NEARBY {
            cycle.rounding = cycle.rounding.max(off);
        }
        let (machine, ring) = event.and_then(|_| branch.tracer.problem.equations.split(&at.w)).unzip();
        let event = event.map(|event| match (&machine, &ring) {
            (Some(machine), Some(ring)) => event.on(machine, ring, cycle.sizes.1),
            _ => event,
        });
        Some(SolutionPoint { value: last(&at.w), cycle, event, ring })
    }

    fn go_through(branch: &mut EventBranch, step: Step<Judged>) {
        branch.go_through(step);
    }

    /// The events change so close by that no step ends before.
    fn stop(branch: &mut EventBranch) {
        let here = || (branch.tracer.here.clone(), Difference::Other { place: None });
        let (at, found) = meeting(&branch.tracer).unwrap_or_else(here);
        if branch.rests(&at) {
            return;
        }
        if let Some((next, continues)) =
            replayed(&branch.tracer, &at, (&branch.path.options, &found), |next| branch.undoes(&at, next))
        {
            return branch.go_on(&at, found.event(false), (next, landing(continues)));
        }
        match across(&branch.tracer, &at, &branch.path.options) {
            Some(next) => branch.jump(&at, &found, Some(next)),
            None => branch.end(&at, BranchEvent::NoConvergence),
        }
    }
}

impl UnreducedBranch {
    /// The branch of `cycle`, a cycle of the machine of `family` at `value`, over `range`, beginning in `direction`. In the
    /// options the largest number of impacts is not used.
    ///
    /// # Errors
    /// [`BranchError`] if the branch cannot begin.
    pub(crate) fn new(
        (family, value): (&Family, f64),
        cycle: &Cycle,
        range: &RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let scale = scale(range, value)?;
        let begin = || {
            let machine = &family.at(value)?;
            let times = (cycle.label.periods, cycle.period);
            let frame = MachineFrame::new(machine);
            let ring = MachineRing::of(&frame, cycle.strobes.first()?, times)?;
            let w = MachineEquations::join(machine, &ring, [value]);
            let equations = MachineEquations::new((machine, family.clone()), ring, cycle.sizes, [scale]);
            let problem = MachineProblem::new(&frame, equations, (*range.start(), *range.end()), cycle.sizes);
            let up = if direction == Direction::Up { 1.0 } else { -1.0 };
            let tracer = begun(problem, &w, value, up, options)?;
            let next = apart(&tracer, up, &options);
            let mut driver =
                Driver::new(EventPath { options, passed: Vec::new(), jumped: false }, tracer, options.points)?;
            if let Some(next) = next {
                driver.exchange(next);
            }
            Some(driver)
        };
        begin().map(Self).ok_or(BranchError::NoCycle)
    }
}

impl Iterator for UnreducedBranch {
    type Item = SolutionPoint;

    fn next(&mut self) -> Option<SolutionPoint> {
        self.0.next()
    }
}

impl EventBranch {
    /// The stop of the only impact of a cycle, if this impact disappears; of several that have no speed there, as of equal parts or on
    /// both sides, the first stop.
    fn lost(&self, at: &MachineSolution, found: &Difference) -> Option<usize> {
        let Difference::Disappears { at: event, .. } = *found else { return None };
        let (machine, ring) = self.tracer.problem.equations.split(&at.w)?;
        let cycle = at.known.cycle.as_ref()?;
        let mut gone = without_speed(&machine, &ring, cycle.sizes.1);
        gone.retain(|k| *k != event);
        gone.push(event);
        let impacts = gone.iter().map(|k| ring.events.get(*k).map_or(0, |event| event.pushed.len().max(1)));
        let closings = cycle.counts.iter().sum::<u32>();
        // a contact has two events, its beginning and its end
        let all = closings as usize == impacts.sum::<usize>() && ring.len() <= 2 * gone.len();
        let stop = |k: &usize| Some(ring.events.get(*k)?.guard.place(machine.stops().len()));
        gone.iter().filter_map(stop).filter(|_| all).min()
    }

    /// The joint of the only hold of a cycle without other events, if it ends because it takes no time any more: the machine swings on without
    /// events, and a cycle of the equations has some.
    fn fades(&self, at: &MachineSolution, found: &Difference) -> Option<usize> {
        let Difference::Rest { place, joint: true, begins: false } = *found else { return None };
        let (machine, ring) = self.tracer.problem.equations.split(&at.w)?;
        let own = ring.events.iter().all(|event| event.guard.place(machine.stops().len()) == place);
        let mut holds = (0..ring.len()).filter(|k| ring.events[*k].after[place].constrains());
        let (hold, others) = (holds.next()?, holds.next());
        let brief = ring.theta(hold + 1) - ring.theta(hold) < SHORT;
        (own && ring.len() == 2 && others.is_none() && brief).then_some(place)
    }

    /// The corner that it is if an impact appears at the time of another one and no cycle with it exists close by: a contact without
    /// speed would have one.
    fn at_one_time(&self, at: &MachineSolution, found: &Difference) -> Option<Difference> {
        let Difference::Appears { at: event, stop } = *found else { return None };
        let (machine, ring) = self.tracer.problem.equations.split(&at.w)?;
        let (normal, place, sizes) = (Normal::new(&machine), ring.place(event), at.known.cycle.as_ref()?.sizes);
        let second = ring.events[event].guard.place(machine.stops().len());
        let gap = place.gap(&normal, &place.turns(&normal), stop).0;
        let corner = Difference::Corner { first: stop, second };
        (gap.abs() < AT_ONCE * normal.along(stop, sizes).0 && self.order_matters(at, (stop, second))).then_some(corner)
    }

    /// Whether it is a corner of two impacts that lead elsewhere in the other order: both stops are rigid, an impact on one changes
    /// the speed at the other, and they are not at one place.
    fn order_matters(&self, at: &MachineSolution, (first, second): (usize, usize)) -> bool {
        let Some((machine, _)) = self.tracer.problem.equations.split(&at.w) else { return false };
        let rigid =
            |stop: usize| matches!(machine.stops().get(stop).map(|stop| &stop.law), Some(StopLaw::Rigid { .. }));
        let normal = Normal::new(&machine);
        let both = [first, second];
        both.into_iter().all(rigid) && {
            let [one, other] = both.map(|stop| normal.directions[stop].as_slice());
            dot(one, other) != 0.0 && independent([one, other].into_iter()).len() == both.len()
        }
    }

    /// What a branch ends with at this event if it does not go on: the motion is not continuous where two impacts come to one time that
    /// lead elsewhere in the other order.
    fn ends(&self, at: &MachineSolution, event: BranchEvent) -> BranchEvent {
        match event {
            BranchEvent::Corner { first, second } if self.order_matters(at, (first, second)) => {
                BranchEvent::Discontinuity
            }
            _ => BranchEvent::NoConvergence,
        }
    }

    /// Whether the two stops of a corner are struck in turn until both are at rest: then what changes can be how many of these impacts are
    /// followed, which is no event.
    fn accumulates(&self, event: BranchEvent) -> bool {
        let BranchEvent::Corner { first, second } = event else { return false };
        let summed = |stop: usize, event: &RingEvent| event.pushed.contains(&(stop, Push::Summed));
        let events = &self.tracer.problem.equations.ring.events;
        first != second && events.iter().any(|event| summed(first, event) && summed(second, event))
    }

    /// Ends the branch if the structure rests for ever right beyond; returns whether it does.
    pub(super) fn rests(&mut self, at: &MachineSolution) -> bool {
        let found = rest_for_ever(&self.tracer, at);
        if let Some((limit, stop)) = &found {
            self.end(limit, BranchEvent::RestForEver { stop: *stop });
        }
        found.is_some()
    }

    /// Reports that these test functions are zero at `at` and goes on with the events beyond.
    pub(super) fn graze(&mut self, at: &MachineSolution, zeros: &[TestFunction]) {
        let ring = &self.tracer.problem.equations.ring;
        // of several at once what disappears comes first, and then the order of the stops, which rounding does not change
        let order = |zero: &&TestFunction| zero.order(ring);
        let zero = zeros.iter().min_by_key(order).and_then(|zero| zero.difference(ring));
        let found = zero.unwrap_or(Difference::Other { place: None });
        let next = through_grazing(&self.tracer, at, zeros, &self.path.options);
        self.pass(at, &found, next);
    }

    /// Reports the change of the events at `at` and goes on with the events beyond: with `next`, if that is known.
    pub(super) fn pass(&mut self, at: &MachineSolution, found: &Difference, next: Option<Tracer<MachineProblem>>) {
        if let Some(stop) = self.lost(at, found).or_else(|| self.fades(at, found)) {
            return self.end(at, BranchEvent::LossOfContact { stop, detail: None });
        }
        if matches!(found, Difference::Rest { .. } | Difference::Other { .. }) && self.rests(at) {
            return;
        }
        let of_rest = matches!(found, Difference::Rest { joint: false, .. } | Difference::Other { .. });
        // how many impacts of a chatter are followed is no property of the cycle
        if of_rest && let Some(next) = same_beyond(&self.tracer, at, &self.path.options) {
            return self.exchange(next);
        }
        let changed = (found, &self.path.options);
        let next = next.or_else(|| through_ending(&self.tracer, at, changed));
        let next = next.or_else(|| through_turn(&self.tracer, at, changed));
        let next = next.or_else(|| through_hold(&self.tracer, at, changed));
        let contact = if next.is_none() { struck(&self.tracer, at, &self.path.options) } else { None };
        let (there, with_contact) = contact.unzip();
        let (at, next) = (there.as_ref().unwrap_or(at), next.or(with_contact));
        // where the motion is not continuous, a cycle a little beyond is another one by chance
        let jumps =
            || self.ends(at, self.at_one_time(at, found).unwrap_or(*found).event(false)) == BranchEvent::Discontinuity;
        let own = |(_, continues): &(_, bool)| *continues || !jumps();
        let back = |next: &Tracer<MachineProblem>| self.undoes(at, next);
        let beyond = || replayed(&self.tracer, at, (&self.path.options, found), back).filter(own);
        let Some((next, continues)) = next.map(|next| (next, true)).or_else(beyond) else {
            let next = across(&self.tracer, at, &self.path.options);
            return self.jump(at, found, next);
        };
        let event = found.event(turns_back(at, &next));
        self.go_on(at, event, (next, landing(continues)));
    }

    /// Where a chatter is complete on one side only, as far as `next` goes on with the cycles beyond: the value at which it is just
    /// complete.
    fn completes(&self, at: &MachineSolution, next: &Tracer<MachineProblem>) -> Option<(MachineSolution, BranchEvent)> {
        let (ring, other) = (&self.tracer.problem.equations.ring, &next.problem.equations.ring);
        (0..ring.events.first()?.back.len()).find_map(|stop| {
            let (here, there) = (Chatter::count(ring, stop), Chatter::count(other, stop));
            let begins = here < there;
            let (equations, complete) =
                if begins { (&next.problem.equations, &next.here) } else { (&self.tracer.problem.equations, at) };
            let value = (here != there).then(|| CompleteChatter::value_of_number(equations, complete, stop))??;
            let mut at = at.clone();
            *at.w.last_mut()? = value;
            Some((at, BranchEvent::Sticking { stop, begins, detail: None }))
        })
    }

    /// Changes the number of impacts of chatters in the signature where too much of them is left out, or too little.
    pub(super) fn adapt(&mut self) {
        let other = |tracer: &Tracer<MachineProblem>| {
            // most cycles have no chatter
            if Chatter::all(&tracer.problem.equations.ring).is_empty() {
                return None;
            }
            let (machine, mut ring) = tracer.problem.equations.split(&tracer.here.w)?;
            Chatter::adapt(&MachineFrame::new(&machine), &mut ring)?;
            let problem = with_ring(tracer, &machine, ring, tracer.here.known.cycle.as_ref()?.sizes);
            let number = last(&tracer.here.w);
            let w = MachineEquations::join(&machine, &problem.equations.ring, [number]);
            let mut next = begun(problem, &w, number, last(&tracer.here.tangent).signum(), self.path.options)?;
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
            let event = self.at_one_time(at, found).unwrap_or(*found).event(false);
            if self.accumulates(event) {
                return self.end(at, BranchEvent::NoConvergence);
            }
            self.add(at, Some(event));
            // as that of a joint whose static limit exceeds its sliding force
            let holds = matches!(event, BranchEvent::Holding { .. });
            return self.end(at, if holds { BranchEvent::Discontinuity } else { self.ends(at, event) });
        };
        let event = found.event(turns_back(at, &next));
        self.go_on(at, event, (next, landing(continues)));
    }

    /// Reports an event and goes on with another tracer. The branch is closed if the same event was there before.
    fn go_on(
        &mut self,
        at: &MachineSolution,
        event: BranchEvent,
        (next, landing): (Tracer<MachineProblem>, Option<BranchEvent>),
    ) {
        let complete = self.completes(at, &next).unzip();
        let (at, event) = (complete.0.as_ref().unwrap_or(at), complete.1.unwrap_or(event));
        let turns = turns_back(at, &next);
        let rings = self.tracer.problem.equations.split(&at.w).zip(next.problem.equations.split(&next.here.w));
        let explained = rings.map_or(Some(event), |((_, ring), (_, other))| explained(event, (&ring, &other), turns));
        let event = match explained {
            None if landing.is_none() => return self.exchange(next),
            explained => explained.unwrap_or(event),
        };
        let ring = self.tracer.problem.equations.ring.clone();
        let (number, unknowns, rises) = (last(&at.w), at.w.len(), last(&at.tangent) > 0.0);
        let now = Passed { number, ring, unknowns, rises, event };
        let near = 1e-9 * self.tracer.problem.equations.scales[0];
        let same = |other: &Passed| {
            (other.number - now.number).abs() < near
                && (other.unknowns, other.rises, other.event) == (now.unknowns, now.rises, now.event)
        };
        if self.path.passed.iter().any(same) {
            return self.end(at, BranchEvent::Closed);
        }
        self.path.passed.push(now);
        self.add(at, Some(event));
        if self.goes_back(&next, number, event) {
            return self.end(at, if self.path.jumped { BranchEvent::Closed } else { self.ends(at, event) });
        }
        self.path.jumped |= landing.is_some();
        let next = if landing.is_some() { from_first(next, number, &self.path.options) } else { next };
        self.exchange(next);
        self.add(&self.tracer.here.clone(), landing);
    }

    /// Whether another tracer is on the way that led here, before the last event.
    fn undoes(&self, at: &MachineSolution, next: &Tracer<MachineProblem>) -> bool {
        let (number, there) = (last(&at.w), last(&next.here.w));
        self.path.passed.last().is_some_and(|passed| {
            let between = (passed.number - there) * (number - passed.number) > 0.0;
            let back = passed.rises != (last(&next.here.tangent) > 0.0);
            between && back && same_events(&passed.ring, &next.problem.equations.ring)
        })
    }

    /// Whether another tracer goes back along what has been followed: with events that were left at the same number, in the other
    /// direction.
    fn goes_back(&self, next: &Tracer<MachineProblem>, number: f64, event: BranchEvent) -> bool {
        let (ring, rises) = (&next.problem.equations.ring, last(&next.here.tangent) > 0.0);
        let near = AGAIN * self.tracer.problem.equations.scales[0];
        let same = |passed: &&Passed| {
            passed.rises != rises && (passed.number - number).abs() < near && same_events(&passed.ring, ring)
        };
        // where an impact of a chatter appears and the number turns, what is told is the same, and the cycle is another one
        let (last, others) = self.path.passed.split_last().unzip();
        let turned = last.filter(same).is_some_and(|last: &Passed| last.ring.len() == ring.len());
        turned || others.into_iter().flatten().any(|passed| same(&passed) && undone(passed.event, event))
    }
}

/// Whether the second event can be the first one on the way back: what appeared or began then disappears or ends. Impacts that a
/// chatter gains one after another at folds are closer to each other than events are located otherwise.
const fn undone(first: BranchEvent, second: BranchEvent) -> bool {
    use BranchEvent::{Grazing, Holding, Sticking};
    match (first, second) {
        (Grazing { appears: one, .. }, Grazing { appears: other, .. })
        | (Sticking { begins: one, .. }, Sticking { begins: other, .. })
        | (Holding { begins: one, .. }, Holding { begins: other, .. }) => one != other,
        _ => true,
    }
}

/// A stop is struck at the time of another event if its gap there is less than this part of the largest coordinate.
const AT_ONCE: f64 = 1e-8;
/// Numbers that differ by less, in their scale, are those of one change of the events.
const AGAIN: f64 = 1e-6;

/// The event where the branch goes on, if the motion there does not continue the one before.
fn landing(continues: bool) -> Option<BranchEvent> {
    (!continues).then_some(BranchEvent::Jump)
}

/// Whether the number changes in the other direction on a branch that goes on with `next`.
fn turns_back(at: &MachineSolution, next: &Tracer<MachineProblem>) -> bool {
    last(&next.here.tangent) * last(&at.tangent) < 0.0
}
