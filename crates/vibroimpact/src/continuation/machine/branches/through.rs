//! The branch through an event at which the same motion solves the equations of the cycles before and of those beyond.
//!
//! Where a stop is grazed, the cycle with an impact of speed zero, or with a contact that lasts for no time, and the cycle
//! without it are the same motion; the branch goes on along the curve of the other one, in the direction in which the impact
//! gains speed, the contact lasts longer or the gap opens. The same holds where the force and the depth of a contact are zero at once,
//! and where a hold takes no time.

use super::beginning::traced;
use super::change::Difference;
use super::closest::closest;
use super::equations::MachineEquations;
use super::joined::join;
use super::problem::{MachineProblem, MachineSolution};
use super::rest::{Limit, limits};
use super::test_functions::TestFunction;
use crate::continuation::branches::BranchOptions;
use crate::continuation::trace::equations::{Equations, correct, tangent, unit};
use crate::continuation::trace::tracer::{Tracer, last};
use crate::events::Place;
use crate::machine::{Machine, Opening, StopLaw};
use crate::math::sort_by;
use crate::orbit::{MachineFrame, MachineRing, Push, RingEvent};
use crate::regime::{ContactState, GuardKind, compliant, compliant_force, independent};

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
pub(super) fn first_step(
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

/// The same from a tangent, which has a positive product with a row of unknowns, in its direction or else in the other one.
fn first_step_either_way(
    problem: &MachineProblem,
    w: &[f64],
    row: &[f64],
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let along = tangent(&problem.equations, w, row)?;
    let back: Vec<f64> = along.iter().map(|t| -t).collect();
    [along, back].iter().find_map(|along| first_step(problem, w, along, options))
}

/// The same with another ring that the motion at a solution solves, first in the direction of the number along the branch.
fn with_the_same_motion(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (machine, ring): (&Machine, MachineRing),
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let problem = with_ring(tracer, machine, ring, at.known.cycle.as_ref()?.sizes);
    let w = MachineEquations::join(machine, &problem.equations.ring, [last(&at.w)]);
    first_step_either_way(&problem, &w, &unit(w.len(), w.len() - 1, forward(at)), options)
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
    first_step_either_way(&problem, &w, &row, options)
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
    let law = machine.stops().get(stop).filter(|_| stop == second)?.law;
    let (stiffness, ..) = compliant(&law)?;
    let frame = MachineFrame::new(&machine);
    let ends = |k: &usize| matches!(ring.events[*k].guard, GuardKind::Force(of) | GuardKind::Depth(of) if of == stop);
    let off = |k: &usize| {
        let (gap, rate) = frame.gap(&ring.place(*k), stop);
        gap.abs() + compliant_force(&law, gap, rate).map_or(0.0, f64::abs) / stiffness
    };
    let k = (0..ring.len()).filter(ends).min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let next = ring.ending_otherwise(&frame, k, stop)?;
    let problem = with_ring(tracer, &machine, next, at.known.cycle.as_ref()?.sizes);
    let w = MachineEquations::join(&machine, &problem.equations.ring, [last(&at.w)]);
    first_step_either_way(&problem, &w, &problem.equations.row(&at.tangent), options)
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
    with_the_same_motion(tracer, at, (&machine, ring), options)
}

/// A limit of a joint below this part of its terms is zero.
const AT_LIMIT: f64 = 1e-6;

/// The tracer beyond the beginning of a hold: where the joint turns back its limit is zero, so the motion is also that of a cycle whose joint
/// holds there and slips again at once. The branch goes on where the hold lasts, which can be back along the number.
pub(super) fn through_hold(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (found, options): (&Difference, &BranchOptions),
) -> Option<Tracer<MachineProblem>> {
    let Difference::Rest { place: joint, joint: true, .. } = *found else { return None };
    let (machine, ring) = tracer.problem.equations.split(&at.w)?;
    let frame = MachineFrame::new(&machine);
    let m = ring.len();
    let turns = |k: usize| {
        let (before, event) = (&ring.events[(k + m - 1) % m], &ring.events[k]);
        matches!(event.guard, GuardKind::Sliding(of) if machine.stops().len() + of == joint)
            && !before.after[joint].constrains()
            && !event.after[joint].constrains()
            && before.after[joint] != event.after[joint]
    };
    let zero = |(value, limit): &(f64, Limit)| value.abs() < AT_LIMIT && turns(limit.at);
    let mut zeros: Vec<Limit> = limits(&frame, &ring, joint).into_iter().filter(zero).map(|(_, limit)| limit).collect();
    // from the last to the first, so that the places of earlier events stay valid
    sort_by(&mut zeros, |a, b| b.at.cmp(&a.at));
    zeros.dedup_by_key(|limit| limit.at);
    if zeros.is_empty() {
        return None;
    }
    let mut next = ring.clone();
    for Limit { at, states, guard } in &zeros {
        let (event, state) = (&ring.events[*at], &ring.places[*at]);
        next.insert(at + 1, RingEvent::touch(*guard, &event.after, event.back.clone()), state.clone());
        next.events[*at].after.clone_from(states);
        next.places[*at].states.clone_from(states);
    }
    let problem = with_ring(tracer, &machine, next, at.known.cycle.as_ref()?.sizes);
    let w = MachineEquations::join(&machine, &problem.equations.ring, [last(&at.w)]);
    let width = frame.shape.size() + 1;
    let mut row = vec![0.0; w.len()];
    for (more, Limit { at, .. }) in zeros.iter().rev().enumerate() {
        row[(at + more) * width] -= 1.0;
        row[(at + more + 1) * width] += 1.0;
    }
    first_step_either_way(&problem, &w, &row, options)
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
    with_the_same_motion(tracer, at, (machine, next.shortest(&frame, sizes)), options)
}

/// The direction of the number along the branch.
pub(super) fn forward(at: &MachineSolution) -> f64 {
    if last(&at.tangent) < 0.0 { -1.0 } else { 1.0 }
}
