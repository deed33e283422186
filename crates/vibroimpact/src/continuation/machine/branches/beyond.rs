//! The branch beyond a change of the events of its cycle, found from the motion there.
//!
//! At most changes the motion is continuous, and the cycle beyond is found by Newton's method from the last one at a number a little
//! beyond, or before if the branch turns back. Else the cycles with the events beyond are followed, although they are not admissible
//! here, until they are.

use super::beginning::{begun, traced};
use super::change::Difference;
use super::equations::MachineEquations;
use super::explained::{closings, same_events};
use super::problem::{MachineProblem, MachineSolution};
use super::summed::same_in_turn;
use super::through::{first_step, forward, with_ring};
use crate::continuation::branches::BranchOptions;
use crate::continuation::trace::equations::{Equations, correct, tangent, unit};
use crate::continuation::trace::tracer::{Problem as _, Tracer, last};
use crate::events::Place;
use crate::machine::Machine;
use crate::math::root;
use crate::orbit::{Chatter, MachineFrame, MachineRing, machine::Cycle, passing};

/// How far beyond a change the motion is followed, in the scale of the number: little, so that no other event lies between.
const BESIDE: [f64; 5] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2];
/// From here on another cycle can be as near as the one that goes on.
const FAR_BESIDE: f64 = 1e-3;
/// The number of these at which events can have come apart at the beginning of a branch.
const APART: usize = 3;
/// The same where a rest on a stop begins or ends: the numbers at which a chatter gets one more impact accumulate there.
const BESIDE_REST: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-2];
/// The same where a joint begins or ceases to hold: just before an impact appears or disappears, this is close to it.
const BESIDE_HOLD: [f64; 6] = [1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2];

/// The cycle a little beyond, from the last one, and whether it continues the motion. Beyond a corner its events may be the same in
/// cyclic order. One that is `passed` before is left out.
pub(super) fn replayed(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (options, found): (&BranchOptions, &Difference),
    passed: impl Fn(&Tracer<MachineProblem>) -> bool,
) -> Option<(Tracer<MachineProblem>, bool)> {
    let (ring, forward) = (&tracer.problem.equations.ring, forward(at));
    let beside: &[f64] = match found {
        Difference::Rest { joint: false, .. } => &BESIDE_REST,
        Difference::Rest { .. } => &BESIDE_HOLD,
        _ => &BESIDE,
    };
    let mut motion = LastMotion::of(tracer, at)?;
    if let Difference::Rest { place, joint: true, .. } = *found {
        let machine = tracer.problem.equations.family.at(motion.number)?;
        let joint = &machine.joints()[place - machine.stops().len()];
        // the force of a joint that holds no more falls at once from the static limit: a motion that changes little is another one
        if joint.limit > joint.sliding {
            (motion.alike, motion.bend) = (NO_STEP, 0.0);
        }
    }
    let other = |next: &MachineRing| !same_in_turn(&next.events, &ring.events);
    if let Difference::Corner { first, second } = *found {
        // the order of two events, or the way in which one contact ends, does not change how many contacts there are; the number can
        // turn back. Close to a grazing contact a cycle without it is near, which this one does not become
        let as_many = |next: &MachineRing| closings(next) == closings(ring);
        let swapped = beside.iter().flat_map(|by| [forward * by, -forward * by]).filter_map(|by| {
            let found =
                motion.beside(tracer, (by, options), |next| (by * forward > 0.0 || other(next)) && as_many(next));
            found.filter(|(next, _)| !passed(next))
        });
        if let Some(next) = swapped.into_iter().find(|(_, continues)| *continues) {
            return Some(next);
        }
        if first == second {
            return None;
        }
    }
    let steps = [forward, -forward].into_iter().flat_map(|up| beside.iter().map(move |by| up * by));
    // where a joint begins or ceases to hold no impact appears, but close by one can, which turns the joint back
    let joint = matches!(found, Difference::Rest { joint: true, .. });
    let found = steps.into_iter().filter_map(|by| {
        let (next, continues) = motion.beside(tracer, (by, options), other).filter(|(next, _)| !passed(next))?;
        let becomes = !joint || by.abs() < FAR_BESIDE || closings(&next.problem.equations.ring) == closings(ring);
        Some((next, continues && becomes))
    });
    first_continuing(found)
}

/// The cycle a little beyond the beginning of a branch where events that happen together there come apart, as the impacts of equal
/// parts of which only one changes.
pub(super) fn apart(
    tracer: &Tracer<MachineProblem>,
    up: f64,
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let (at, ring) = (&tracer.here, &tracer.problem.equations.ring);
    if ring.events.iter().all(|event| event.with.is_empty()) {
        return None;
    }
    let motion = LastMotion::of(tracer, at)?;
    let other = |next: &MachineRing| !same_in_turn(&next.events, &ring.events);
    let steps = BESIDE.into_iter().take(APART);
    steps
        .filter_map(|by| motion.beside(tracer, (by * up, options), other))
        .find_map(|(next, continues)| continues.then_some(next))
}

/// The first that continues the motion, or else the first.
fn first_continuing<T>(mut found: impl Iterator<Item = (T, bool)>) -> Option<(T, bool)> {
    let first = found.next()?;
    if first.1 { Some(first) } else { found.find(|(_, continues)| *continues).or(Some(first)) }
}

/// How far beyond a change the motion is followed for its events only.
const A_LITTLE: [f64; 3] = [1e-7, 1e-5, 1e-3];
/// The most steps along cycles that are not admissible, and the largest change of the number on them, in its scale.
const INADMISSIBLE: usize = 200;
const FAR: f64 = 0.4;
/// Cycles whose unknowns differ by less from the motion beside the change continue it.
const CONTINUOUS: f64 = 1e-4;

/// The cycle with the events of the motion a little beyond, which may exist elsewhere only, and whether it continues the motion.
/// It is followed to where it becomes admissible.
pub(super) fn across(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    options: &BranchOptions,
) -> Option<(Tracer<MachineProblem>, bool)> {
    let MachineEquations { ring, scales: [scale], family, .. } = &tracer.problem.equations;
    let (low, high) = tracer.problem.range;
    let motion = LastMotion::of(tracer, at)?;
    let sizes = at.known.cycle.as_ref()?.sizes;
    let beside = A_LITTLE.into_iter().map(|by| motion.number + by * forward(at) * scale);
    beside.filter(|there| (low..=high).contains(there)).find_map(|there| {
        let machine = family.at(there)?;
        let frame = MachineFrame::new(&machine);
        let next = MachineRing::of(&frame, &motion.begin, (motion.periods, motion.period))?;
        (!same_in_turn(&next.events, &ring.events)).then_some(())?;
        let problem = with_ring(tracer, &machine, next, sizes);
        let guess = MachineEquations::join(&machine, &problem.equations.ring, [there]);
        // at this number, or where one of the new events is where it was first
        let events = &problem.equations.ring.events;
        let width = frame.shape.size() + 1;
        let new = (0..events.len()).filter(|k| !ring.events.contains(&events[*k])).map(|k| k * width);
        let solved = core::iter::once(guess.len() - 1).chain(new).find_map(|fixed| {
            let row = unit(guess.len(), fixed, 1.0);
            let (w, _) = correct(&problem.equations, &guess, &row, guess[fixed])?;
            Some((tangent(&problem.equations, &w, &row)?, w))
        });
        let (along, w) = solved?;
        let moved: Vec<f64> = w.iter().zip(&guess).map(|(w, guess)| w - guess).collect();
        let continues = problem.equations.length(&moved) < CONTINUOUS;
        let back = along.iter().map(|t| -t).collect();
        let onward = if last(&along) * forward(at) < 0.0 { [back, along] } else { [along, back] };
        let ways = onward.into_iter().filter_map(|along| {
            let begun = traced(problem.clone(), w.clone(), along.clone(), *options)?;
            // right at the change the cycle can be admissible: one way leads back through it
            if begun.here.known.physical() {
                return first_step(&problem, &w, &along, options);
            }
            admissible(begun)
        });
        let far = |next: &Tracer<MachineProblem>| (last(&next.here.w) - motion.number).abs();
        let next = ways.min_by(|a, b| far(a).total_cmp(&far(b)))?;
        Some((next, continues))
    })
}

/// Cycles that were found a little beyond a number, from there or from where they begin to exist: how far beyond they were looked for says
/// nothing of them. As they are if they do not go on to it.
pub(super) fn from_first(next: Tracer<MachineProblem>, number: f64, options: &BranchOptions) -> Tracer<MachineProblem> {
    let found = last(&next.here.w);
    let near = 2.0 * BESIDE[BESIDE.len() - 1] * next.problem.equations.scales[0];
    let solution = |value: f64| next.on_end(&next.here.w, value).map(|(w, _)| w);
    let exists =
        |value: f64| solution(value).and_then(|w| next.problem.known(&w)).is_some_and(|known| known.physical());
    let first = || {
        let value = if exists(number) { number } else { root::border(found, number, exists).0 };
        begun(next.problem.clone(), &solution(value)?, value, last(&next.here.tangent).signum(), *options)
    };
    let first = if (found - number).abs() <= near { first() } else { None };
    first.filter(|first| first.here.known.physical()).unwrap_or(next)
}

/// Follows cycles that are not admissible to the first one that is.
fn admissible(mut tracer: Tracer<MachineProblem>) -> Option<Tracer<MachineProblem>> {
    let begin = last(&tracer.here.w);
    for _ in 0..INADMISSIBLE {
        if tracer.here.known.physical() {
            return Some(tracer);
        }
        let step = tracer.step()?;
        if (last(&step.there.w) - begin).abs() > FAR * tracer.problem.equations.scales[0] {
            return None;
        }
        let mut there = step.there.clone();
        if there.known.physical() {
            let (mut low, mut high) = (0.0, step.length);
            while high - low > 1e-12 * step.length {
                let middle = 0.5 * (low + high);
                match tracer.at(&step, middle) {
                    Some(at) if at.known.physical() => (high, there) = (middle, at),
                    _ => low = middle,
                }
            }
        } else if step.on_end {
            return None;
        }
        tracer.take(there);
    }
    None
}

/// A cycle beside a solution that differs, in its size, by less continues it,
const NO_JUMP: f64 = 5e-4;
/// or by less than this where a force is not continuous.
const NO_STEP: f64 = 1e-7;
/// Another one does if the difference falls to less than the last part at each of some numbers that are nearer by this factor.
const NEARER: f64 = 0.0625;
const NEARER_TIMES: u32 = 6;
const LIMIT: f64 = 0.6;
/// Where there is none nearer it does if the difference is less than this times the root of the distance of their numbers: beyond a
/// grazing contact a cycle changes as fast as the root.
const BEND: f64 = 0.5;

/// How far beyond a solution its cycle with a complete chatter is looked for, and by how much it may differ there.
const SAME: f64 = 1e-7;
const ALIKE: f64 = 1e-4;

/// The same cycle with a complete chatter right beyond a solution, where the signature has other impacts before the rest begins.
pub(super) fn same_beyond(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let ring = &tracer.problem.equations.ring;
    let cycle = at.known.cycle.as_ref()?;
    (!Chatter::all(ring).is_empty()).then_some(())?;
    let other = |next: &MachineRing| next.events != ring.events && same_events(next, ring);
    let (next, _) = LastMotion::of(tracer, at)?.beside(tracer, (SAME * forward(at), options), other)?;
    next.here.known.cycle.as_ref().is_some_and(|next| next.same_as(cycle, ALIKE)).then_some(next)
}

/// The motion at the last solution.
pub(super) struct LastMotion {
    pub(super) number: f64,
    /// A state between two events.
    pub(super) begin: Place,
    periods: u32,
    pub(super) period: f64,
    /// A cycle beside it that differs, in its size, by less continues it,
    alike: f64,
    /// and where there is none nearer one that differs by less than this times the root of the distance of their numbers, in the scale
    /// of the number.
    bend: f64,
}

impl LastMotion {
    pub(super) fn of(tracer: &Tracer<MachineProblem>, at: &MachineSolution) -> Option<Self> {
        let (machine, ring) = tracer.problem.equations.split(&at.w)?;
        let frame = MachineFrame::new(&machine);
        let begin = ring.middle(&frame)?.1;
        Some(Self {
            number: last(&at.w),
            begin,
            periods: ring.periods,
            period: ring.period(&frame),
            alike: NO_JUMP,
            bend: BEND,
        })
    }

    /// The cycle close to it at a number that differs by `by` in its scale, with the machine there and its events, and how far it is
    /// from the motion in its size.
    fn cycle(&self, tracer: &Tracer<MachineProblem>, by: f64) -> Option<(Machine, MachineRing, Cycle, f64)> {
        let (low, high) = tracer.problem.range;
        let there = self.number + by * tracer.problem.equations.scales[0];
        (low..=high).contains(&there).then_some(())?;
        let machine = tracer.problem.equations.family.at(there)?;
        let frame = MachineFrame::new(&machine);
        let cycle = Cycle::lasting(&frame, &self.begin, (self.periods, self.period))?;
        let apart = passing(&frame, &self.begin, &cycle).map_or(f64::INFINITY, |(.., apart)| apart);
        let ring = MachineRing::of(&frame, cycle.strobes.first()?, (self.periods, cycle.period))?;
        Some((machine, ring, cycle, apart))
    }

    /// Whether the `wanted` cycles come to the motion where the number does, when that at the distance `by` is so far `apart`.
    fn is_limit(
        &self,
        tracer: &Tracer<MachineProblem>,
        (mut by, mut apart): (f64, f64),
        wanted: &impl Fn(&MachineRing) -> bool,
    ) -> bool {
        for _ in 0..NEARER_TIMES {
            if apart < self.alike {
                return true;
            }
            let bend = self.bend * by.abs().sqrt();
            by *= NEARER;
            match self.cycle(tracer, by).filter(|(_, next, ..)| wanted(next)) {
                None => return apart < bend,
                Some((.., nearer)) if nearer > LIMIT * apart => return false,
                Some((.., nearer)) => apart = nearer,
            }
        }
        true
    }

    /// The cycle close to it at a number that differs by `by` in its scale, and whether it continues the motion; `None` if it is not
    /// `wanted`.
    fn beside(
        &self,
        tracer: &Tracer<MachineProblem>,
        (by, options): (f64, &BranchOptions),
        wanted: impl Fn(&MachineRing) -> bool,
    ) -> Option<(Tracer<MachineProblem>, bool)> {
        let (machine, next, cycle, apart) = self.cycle(tracer, by).filter(|(_, next, ..)| wanted(next))?;
        let there = self.number + by * tracer.problem.equations.scales[0];
        let w = MachineEquations::join(&machine, &next, [there]);
        let problem = with_ring(tracer, &machine, next, cycle.sizes);
        let next = begun(problem, &w, there, by.signum(), *options)?;
        next.here.known.physical().then(|| (next, self.is_limit(tracer, (by, apart), &wanted)))
    }
}
