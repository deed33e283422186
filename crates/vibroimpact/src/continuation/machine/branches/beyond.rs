//! The branch beyond a change of the events of its cycle.
//!
//! Where a stop is grazed, the cycle with an impact of speed zero, or with a contact that lasts for no time, and the cycle
//! without it are the same motion and solve both systems of equations; the branch goes on along the curve of the other one, in
//! the direction in which the impact gains speed, the contact lasts longer or the gap opens. At most other changes the motion is
//! continuous, and the cycle beyond is found by Newton's method from the last one at a number a little beyond, or before if the
//! branch turns back. Else the cycles with the events beyond are followed, although they are not admissible here, until they are.

use super::beginning::{begun, traced};
use super::change::Difference;
use super::closest::closest;
use super::equations::MachineEquations;
use super::explained::{closings, same_events};
use super::joined::join;
use super::problem::{MachineProblem, MachineSolution};
use super::summed::same_in_turn;
use super::test_functions::TestFunction;
use crate::continuation::branches::BranchOptions;
use crate::continuation::trace::equations::{Equations, correct, tangent, unit};
use crate::continuation::trace::tracer::{Tracer, last};
use crate::events::Place;
use crate::machine::{Machine, Opening, StopLaw};
use crate::math::sort_by;
use crate::orbit::{Chatter, MachineFrame, MachineRing, Push, RingEvent, machine::Cycle, passing};
use crate::regime::{ContactState, GuardKind, compliant, independent};

/// The tracer beyond a point where these test functions of gaps are zero; `None` if none is found.
pub(super) fn through_grazing(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    zeros: &[TestFunction],
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let (machine, ring) = tracer.problem.equations.split(&at.w)?;
    // without a rebound too an impact of speed zero changes nothing, unless a rest begins with it
    let opens = |k: usize, stop: usize| !ring.events[k].after[stop].constrains();
    let (mut gone, mut new): (Vec<usize>, Vec<(usize, usize)>) = Default::default();
    for zero in zeros {
        match *zero {
            TestFunction::Rate(k) if matches!(ring.events[k].guard, GuardKind::Gap(stop) if opens(k, stop)) => {
                gone.push(k);
            }
            TestFunction::Clearance(leg, GuardKind::Gap(stop)) => new.push((leg, stop)),
            _ => {}
        }
    }
    // a flight that grazes where an impact disappears belongs to another part of the cycle
    if !gone.is_empty() {
        disappearing(tracer, at, (&machine, &ring), gone, options)
    } else if !new.is_empty() {
        appearing(tracer, at, (&machine, &ring), &new, options)
    } else {
        None
    }
}

/// The problem with another ring at the same machine.
pub(super) fn with_ring(
    tracer: &Tracer<MachineProblem>,
    machine: &Machine,
    ring: MachineRing,
    sizes: (f64, f64),
) -> MachineProblem {
    let old = &tracer.problem;
    let frame = MachineFrame::new(machine);
    let ring = ring.centred(&frame.normal.translations);
    let equations = MachineEquations::new((machine, old.equations.family.clone()), ring, sizes, old.equations.scales);
    MachineProblem::new(&frame, equations, old.range, sizes)
}

/// Lengths of the first step beyond a grazing contact. It is short, because a multiplier that is infinite there can pass -1 and 1
/// close by; the second one is taken where the replay cannot tell an impact of so low a speed from a touch.
const AHEAD: [f64; 2] = [1e-6, 1e-5];

/// The solution a first step away in a direction, if it is admissible.
fn first_step(
    problem: &MachineProblem,
    w: &[f64],
    along: &[f64],
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let row = problem.equations.row(along);
    AHEAD.into_iter().find_map(|ahead| {
        let guess: Vec<f64> = w.iter().zip(along).map(|(w, t)| w + ahead * t).collect();
        let level = problem.equations.dot(along, w) + ahead;
        let (next, _) = correct(&problem.equations, &guess, &row, level)?;
        let along = tangent(&problem.equations, &next, &row)?;
        traced(problem.clone(), next, along, *options).filter(|tracer| tracer.here.known.physical())
    })
}

/// Adds to a row of unknowns the direction in which a contact with a stop from event `first` to event `end` grows: it lasts longer, or,
/// where both are one impact, its velocity away from the stop is larger. Without a rebound this velocity is 0: then it is the
/// direction in which the impact comes earlier, which may be the other one.
pub(super) fn grows(frame: &MachineFrame<'_>, row: &mut [f64], (first, end): (usize, usize), stop: usize) {
    let width = frame.shape.size() + 1;
    if end > first {
        row[first * width] -= 1.0;
        row[end * width] += 1.0;
        return;
    }
    if matches!(frame.machine.stops()[stop].law, StopLaw::Rigid { restitution: 0.0 }) {
        row[first * width] -= 1.0;
        return;
    }
    for (i, direction) in frame.normal.directions[stop].iter().enumerate() {
        row[first * width + 1 + frame.shape.n + i] -= direction;
    }
}

/// New impacts whose phases differ by less are at one time.
const AT_ONCE: f64 = 1e-7;
/// The phase of a contact that lasts for no time, to rounding: its equation is divided by its duration.
const INSTANT: f64 = 1e-6;

/// With a new impact of speed zero, or a contact that lasts for no time, on each of these flights with these stops.
fn appearing(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (machine, ring): (&Machine, &MachineRing),
    flights: &[(usize, usize)],
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let frame = MachineFrame::new(machine);
    let mut new: Vec<(usize, usize, Place)> = Vec::new();
    for (leg, stop) in flights {
        new.push((*leg, *stop, closest(&frame, ring, (*leg, GuardKind::Gap(*stop)))?.1));
    }
    // from the last to the first, so that the places of earlier events stay valid
    sort_by(&mut new, |a, b| b.2.phase.total_cmp(&a.2.phase));
    let mut next = ring.clone();
    let rigid = |stop: usize| matches!(machine.stops()[stop].law, StopLaw::Rigid { .. });
    let at_once = |one: &(usize, usize, Place), other: &(usize, usize, Place)| {
        one.0 == other.0 && (one.2.phase - other.2.phase).abs() < AT_ONCE && rigid(one.1) && rigid(other.1)
    };
    for group in new.chunk_by(at_once) {
        let (leg, _, place) = &group[0];
        let mut stops: Vec<usize> = group.iter().map(|(_, stop, _)| *stop).collect();
        stops.sort_unstable();
        insert_contact(&frame, &mut next, (leg + 1, &stops), place)?;
    }
    for (_, stop, _) in &new {
        next.set_surface(&frame, *stop)?;
    }
    let sizes = at.known.cycle.as_ref()?.sizes;
    let problem = with_ring(tracer, machine, next, sizes);
    let ring = &problem.equations.ring;
    let w = MachineEquations::join(machine, ring, [last(&at.w)]);
    let mut row = vec![0.0; w.len()];
    for (_, stop, place) in &new {
        let index = (0..ring.len()).find(|k| (ring.places[*k].phase - place.phase).abs() < AT_ONCE)?;
        let end = index + usize::from(ring.contact(index).is_some());
        grows(&frame, &mut row, (index, end), *stop);
    }
    let along = tangent(&problem.equations, &w, &row)?;
    let back: Vec<f64> = along.iter().map(|t| -t).collect();
    [along, back].iter().find_map(|along| first_step(&problem, &w, along, options))
}

/// Inserts an impact of speed zero on these rigid stops at once, or a contact with a compliant one that lasts for no time, as event
/// `index` at a state on the flight before.
fn insert_contact(
    frame: &MachineFrame<'_>,
    ring: &mut MachineRing,
    (index, stops): (usize, &[usize]),
    place: &Place,
) -> Option<()> {
    let (machine, open) = (frame.machine, &place.states);
    let back: Vec<bool> = place.surfaces.iter().map(Option::is_some).collect();
    let (&stop, others) = stops.split_first()?;
    let StopLaw::Compliant { opening, damping, preload, .. } = machine.stops()[stop].law else {
        let event = RingEvent::touch(GuardKind::Gap(stop), open, back);
        let with = others.iter().map(|other| GuardKind::Gap(*other)).collect();
        // of several stops at one place only the first one pushes
        let directions = stops.iter().map(|stop| frame.normal.directions[*stop].as_slice());
        let pushed = independent(directions).into_iter().map(|k| (stops[k], Push::Rebounds)).collect();
        ring.insert(index, RingEvent { with, pushed, ..event }, place.clone());
        return Some(());
    };
    let by_position = opening == Opening::Position || damping == 0.0 || preload > 0.0 && !back[stop];
    let mut closed = Place { known: Vec::new(), gaps: Vec::new(), ..place.clone() };
    closed.states[stop] = ContactState::Closed;
    closed.surfaces[stop] = None;
    let mut end = frame.moved(&closed, &frame.structure(&closed.states)?, INSTANT / ring.frequency(machine));
    end.phase = closed.phase + INSTANT;
    end.states.clone_from(open);
    let guard = if by_position { GuardKind::Depth(stop) } else { GuardKind::Force(stop) };
    ring.insert(index, RingEvent::touch(guard, open, back.clone()), end);
    ring.insert(index, RingEvent::touch(GuardKind::Gap(stop), &closed.states, back), closed);
    Some(())
}

/// The tracer beyond a corner at which the force and the depth of a stop are zero at once at the end of a contact: the same motion solves
/// the equations in which this contact ends in the other way.
pub(super) fn through_ending(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (found, options): (&Difference, &BranchOptions),
) -> Option<Tracer<MachineProblem>> {
    let Difference::Corner { first: stop, second } = *found else { return None };
    let (machine, ring) = tracer.problem.equations.split(&at.w)?;
    let (stiffness, damping, preload) = compliant(&machine.stops().get(stop).filter(|_| stop == second)?.law)?;
    let frame = MachineFrame::new(&machine);
    let ends = |k: &usize| matches!(ring.events[*k].guard, GuardKind::Force(of) | GuardKind::Depth(of) if of == stop);
    let off = |k: &usize| {
        let (gap, rate) = frame.gap(&ring.place(*k), stop);
        gap.abs() + (preload - stiffness * gap - damping * rate).abs() / stiffness
    };
    let k = (0..ring.len()).filter(ends).min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let next = ring.ending_otherwise(&frame, k, stop)?;
    let problem = with_ring(tracer, &machine, next, at.known.cycle.as_ref()?.sizes);
    let w = MachineEquations::join(&machine, &problem.equations.ring, [last(&at.w)]);
    let along = tangent(&problem.equations, &w, &problem.equations.row(&at.tangent))?;
    let back: Vec<f64> = along.iter().map(|t| -t).collect();
    [along, back].iter().find_map(|along| first_step(&problem, &w, along, options))
}

/// The tracer beyond the end of a hold that takes no time: the motion is that of the cycle in which the joint turns back instead.
pub(super) fn through_turn(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (found, options): (&Difference, &BranchOptions),
) -> Option<Tracer<MachineProblem>> {
    let Difference::Rest { place, joint: true, .. } = *found else { return None };
    let (machine, mut ring) = tracer.problem.equations.split(&at.w)?;
    join(&MachineFrame::new(&machine), &mut ring, place).then_some(())?;
    let problem = with_ring(tracer, &machine, ring, at.known.cycle.as_ref()?.sizes);
    let w = MachineEquations::join(&machine, &problem.equations.ring, [last(&at.w)]);
    let row = unit(w.len(), w.len() - 1, forward(at));
    let along = tangent(&problem.equations, &w, &row)?;
    let back: Vec<f64> = along.iter().map(|t| -t).collect();
    [along, back].iter().find_map(|along| first_step(&problem, &w, along, options))
}

/// Without the impacts or contacts `gone`, whose speed is zero. What is left can be several times a shorter cycle.
fn disappearing(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (machine, ring): (&Machine, &MachineRing),
    mut gone: Vec<usize>,
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let sizes = at.known.cycle.as_ref()?.sizes;
    let frame = MachineFrame::new(machine);
    let m = ring.len();
    let stops: Vec<usize> = gone.iter().filter_map(|k| ring.contact(*k)).collect();
    let openings: Vec<usize> = gone.iter().filter(|k| ring.contact(**k).is_some()).map(|k| (k + 1) % m).collect();
    gone.extend(openings);
    gone.sort_unstable();
    if gone.len() >= m {
        return None;
    }
    let mut next = ring.clone();
    gone.iter().rev().for_each(|k| next.remove(*k));
    for stop in stops {
        next.set_surface(&frame, stop)?;
    }
    let next = next.shortest(&frame, sizes);
    let problem = with_ring(tracer, machine, next, sizes);
    let w = MachineEquations::join(machine, &problem.equations.ring, [last(&at.w)]);
    let row = unit(w.len(), w.len() - 1, forward(at));
    let along = tangent(&problem.equations, &w, &row)?;
    let back: Vec<f64> = along.iter().map(|t| -t).collect();
    [along, back].iter().find_map(|along| first_step(&problem, &w, along, options))
}

/// How far beyond a change the motion is followed, in the scale of the number: little, so that no other event lies between.
const BESIDE: [f64; 5] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2];
/// The number of these at which events can have come apart at the beginning of a branch.
const APART: usize = 3;
/// The same where a rest on a stop begins or ends: the numbers at which a chatter gets one more impact accumulate there.
const BESIDE_REST: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-2];

/// The cycle a little beyond, from the last one, and whether it continues the motion. Beyond a corner its events may be the same in
/// cyclic order.
pub(super) fn replayed(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (options, found): (&BranchOptions, &Difference),
) -> Option<(Tracer<MachineProblem>, bool)> {
    let (ring, forward) = (&tracer.problem.equations.ring, forward(at));
    let beside = if matches!(found, Difference::Rest { joint: false, .. }) { BESIDE_REST } else { BESIDE };
    let motion = LastMotion::of(tracer, at)?;
    let other = |next: &MachineRing| !same_in_turn(&next.events, &ring.events);
    if let Difference::Corner { first, second } = *found {
        // the order of two events, or the way in which one contact ends, does not change how many contacts there are; the number can
        // turn back. Close to a grazing contact a cycle without it is near, which this one does not become
        let as_many = |next: &MachineRing| closings(next) == closings(ring);
        let swapped = beside.into_iter().flat_map(|by| [forward * by, -forward * by]).filter_map(|by| {
            motion.beside(tracer, (by, options), |next| (by * forward > 0.0 || other(next)) && as_many(next))
        });
        if let Some(next) = swapped.into_iter().find(|(_, continues)| *continues) {
            return Some(next);
        }
        if first == second {
            return None;
        }
    }
    let steps = [forward, -forward].into_iter().flat_map(|up| beside.map(|by| up * by));
    // where a joint begins or ceases to hold no impact appears
    let joint = matches!(found, Difference::Rest { joint: true, .. });
    let becomes = |next: &Tracer<MachineProblem>| !joint || closings(&next.problem.equations.ring) == closings(ring);
    let found = steps.into_iter().filter_map(|by| {
        let (next, continues) = motion.beside(tracer, (by, options), other)?;
        let continues = continues && becomes(&next);
        Some((next, continues))
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
            let begun = traced(problem.clone(), w.clone(), along, *options)?;
            admissible(begun)
        });
        let far = |next: &Tracer<MachineProblem>| (last(&next.here.w) - motion.number).abs();
        let next = ways.min_by(|a, b| far(a).total_cmp(&far(b)))?;
        Some((next, continues))
    })
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

/// A cycle beside a solution that differs, in its size, by less continues it.
const NO_JUMP: f64 = 5e-4;
/// Another one does if the difference falls to less than the last part at each of some numbers that are nearer by this factor.
const NEARER: f64 = 0.0625;
const NEARER_TIMES: u32 = 6;
const LIMIT: f64 = 0.6;
/// Where there is none nearer it does if the difference is less than this times the root of the distance of their numbers in the
/// scale of the number: beyond a grazing contact a cycle changes as fast as the root.
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

/// The direction of the number along the branch.
fn forward(at: &MachineSolution) -> f64 {
    if last(&at.tangent) < 0.0 { -1.0 } else { 1.0 }
}

/// The motion at the last solution.
pub(super) struct LastMotion {
    pub(super) number: f64,
    /// A state between two events.
    pub(super) begin: Place,
    periods: u32,
    pub(super) period: f64,
}

impl LastMotion {
    pub(super) fn of(tracer: &Tracer<MachineProblem>, at: &MachineSolution) -> Option<Self> {
        let (machine, ring) = tracer.problem.equations.split(&at.w)?;
        let frame = MachineFrame::new(&machine);
        let begin = ring.middle(&frame)?.1;
        Some(Self { number: last(&at.w), begin, periods: ring.periods, period: ring.period(&frame) })
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
            if apart < NO_JUMP {
                return true;
            }
            let bend = BEND * by.abs().sqrt();
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
