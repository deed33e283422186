//! The branch beyond a grazing contact at the time of another event: where friction acts beside the stop, the velocity of its joint
//! is zero when the gap is least.
//!
//! With a contact that lasts for no time the equations are singular there: the events in it are at its beginning and at its end.
//! So the contact is followed from a little before the least gap, with the stop moved into the way, and the events that it really has
//! are those of the ring.

use super::at_rest::zero_near;
use super::beginning::traced;
use super::equations::MachineEquations;
use super::problem::{MachineProblem, MachineSolution};
use super::through::{grows, with_ring};
use crate::continuation::branches::BranchOptions;
use crate::continuation::trace::equations::{correct, tangent};
use crate::continuation::trace::tracer::{Tracer, last};
use crate::events::Place;
use crate::math::{add_scaled, dot};
use crate::orbit::{MachineFrame, MachineLap, MachineRing, RingEvent, events_of};
use crate::regime::ContactState;

/// The gap at the other event, relative to the motion, if it is the least one and zero.
const TOUCHING: f64 = 1e-6;
/// By how much more than this, relative to the motion, the gap is larger a little before and after.
const LEAST: f64 = 1e-11;
/// Events of the contact whose phases differ by less are one.
const AT_ONCE: f64 = 1e-9;
/// The largest distance to the solution at which the gap is zero.
const FAR: f64 = 1e-2;
/// How long before the least gap the contact begins, as a phase.
const EARLY: [f64; 3] = [1e-4, 1e-3, 1e-5];
/// How long the contact is followed, in this time.
const LONG: [f64; 4] = [4.0, 8.0, 16.0, 32.0];

/// The solution at which the least gap of a stop is zero, if this is at an event of another contact close to `at`, and the tracer with
/// a short contact with the stop; of equal parts, with all stops whose gaps are zero there.
pub(super) fn struck(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    options: &BranchOptions,
) -> Option<(MachineSolution, Tracer<MachineProblem>)> {
    let (machine, ring) = tracer.problem.equations.split(&at.w)?;
    let (machine, ring, frame) = (&machine, &ring, MachineFrame::new(&machine));
    let sizes = at.known.cycle.as_ref()?.sizes;
    let m = ring.len();
    let touches = |k: usize, stop: usize| {
        let event = &ring.events[k];
        let own = event.guards().any(|guard| guard.place(event.back.len()) == stop);
        let open = [k, (k + m - 1) % m].iter().all(|k| ring.events[*k].after[stop] == ContactState::Open);
        if own || !open {
            return false;
        }
        let beside = |leg: usize, time: f64| {
            let place = ring.place(leg);
            Some(frame.gap(&frame.moved(&place, &frame.structure(&place.states)?, time), stop).0)
        };
        // among the impacts of a chatter a gap is as small, but the largest one, and during a hold it does not change
        let (least, _) = frame.gap(&ring.place(k), stop);
        let (before, short) = ((k + m - 1) % m, EARLY[0] / ring.frequency(machine));
        let (size, _) = frame.normal.along(stop, sizes);
        let rises = |to: Option<f64>| to.is_some_and(|to| to > least + LEAST * size);
        least.abs() < TOUCHING * size
            && rises(beside(k, short))
            && rises(beside(before, ring.time(before, machine) - short))
    };
    let stops = 0..machine.stops().len();
    let touched = |k: usize| stops.clone().filter(|stop| touches(k, *stop)).collect::<Vec<_>>();
    let (k, stops) = (0..m).map(|k| (k, touched(k))).find(|(_, stops)| !stops.is_empty())?;
    let gap = |frame: &MachineFrame<'_>, ring: &MachineRing| Some(frame.gap(&ring.place(k), stops[0]).0);
    let equations = &tracer.problem.equations;
    let w = zero_near(equations, &at.w, FAR, gap)?;
    let (machine, ring) = equations.split(&w)?;
    let (machine, ring, frame) = (&machine, &ring, MachineFrame::new(&machine));
    let at = MachineSolution { w, ..at.clone() };
    let least = ring.theta(k);
    EARLY
        .into_iter()
        .find_map(|early| {
            let (next, count) =
                LONG.into_iter().find_map(|long| with_contact(&frame, ring, (&stops, least), (early, long)))?;
            let problem = with_ring(tracer, machine, next, sizes);
            let guess = MachineEquations::join(machine, &problem.equations.ring, [last(&at.w)]);
            let mut row = vec![0.0; guess.len()];
            stops.iter().for_each(|stop| grows(&frame, &mut row, (1, count), *stop));
            let (w, _) = correct(&problem.equations, &guess, &row, dot(&row, &guess))?;
            let along = tangent(&problem.equations, &w, &row)?;
            traced(problem, w, along, *options).filter(|tracer| tracer.here.known.physical())
        })
        .map(|tracer| (at.clone(), tracer))
}

/// The ring with the events of a contact that begins so `early` before the least gap, after its first event, and their number;
/// `None` if after `long` times as much the states are not those of the ring.
fn with_contact(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (stops, least): (&[usize], f64),
    (early, long): (f64, f64),
) -> Option<(MachineRing, usize)> {
    let frequency = ring.frequency(frame.machine);
    // the flight on which the contact begins is the first one
    let begin = (least - early - ring.theta(0)).rem_euclid(ring.angle()) + ring.theta(0);
    let leg = (0..ring.len()).rev().find(|k| ring.theta(*k) <= begin)?;
    let mut next = ring.clone().beginning_at(leg);
    let begin = begin - ring.theta(leg) + next.theta(0);
    let from = Place { known: Vec::new(), ..next.place(0) };
    let mut place = frame.moved(&from, &frame.structure(&from.states)?, (begin - next.theta(0)) / frequency);
    for stop in stops {
        let direction = &frame.normal.directions[*stop];
        let (gap, _) = frame.gap(&place, *stop);
        add_scaled(&mut place.x, gap / dot(direction, direction), direction);
    }
    let lap = MachineLap::replay(frame, &place, long * early / frequency)?;
    let gone = (1..next.len()).take_while(|k| next.theta(*k) < begin + long * early).count();
    if lap.end.states != next.events[gone].after {
        return None;
    }
    (0..gone).for_each(|_| next.remove(1));
    let mut contact: Vec<(f64, RingEvent, Place)> = Vec::new();
    for (time, event, place) in events_of(&lap) {
        match contact.last_mut() {
            // what equal parts do at one time is one event
            Some((before, first, last)) if (time - *before) * frequency < AT_ONCE => {
                first.with.extend(event.guards());
                first.pushed.extend(event.pushed);
                (first.after, first.back) = (event.after, event.back);
                *last = place;
            }
            _ => contact.push((time, event, place)),
        }
    }
    let count = contact.len();
    for (k, (time, event, mut place)) in contact.into_iter().enumerate() {
        place.phase = begin + frequency * time;
        next.insert(1 + k, event, place);
    }
    for stop in stops {
        next.set_surface(frame, *stop)?;
    }
    (count > 0).then_some((next, count))
}
