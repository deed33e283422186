//! Where a cycle grazes a stop, to rounding.
//!
//! The motion is followed to decide which solutions are admissible, and it takes an impact of a very small speed for a
//! grazing contact, and a very small gap for a contact. So the last admissible solution lies a little before or beyond the
//! grazing one. There the smallest gap of the flight is zero, or the speed of the impact.

use super::change::Difference;
use super::closest::closest;
use super::joined::SHORT;
use super::problem::{Judged, MachineProblem, MachineSolution};
use crate::continuation::trace::tracer::{Solution, Step, Tracer};
use crate::events::Place;
use crate::orbit::{MachineFrame, MachineRing};
use crate::regime::GuardKind;

/// The first distance of the secant method, and the largest one from the last admissible solution, in parts of the step.
const FIRST: f64 = 1e-6;
const MOST: f64 = 0.1;
/// A gap that is larger, relative to the largest coordinate, is not that of a grazing contact.
const NEAR: f64 = 1e-3;
/// An impact of a lower speed, relative to the largest velocity, grazes.
const SLOW: f64 = 1e-3;
/// The largest number of its steps.
const STEPS: u32 = 12;

/// The same difference with the event that grazes. If several impacts in a row are on the same stop, their order does not
/// tell which of them is missing, or on which flight there is a new one: it is that with the lowest speed, or with the
/// smallest gap. An impact that grazes in one of several parts of a cycle that are nearly equal can happen in another part
/// beyond, so two events have changed their order which do not happen at the same time. Where no flight comes close to the
/// stop of a new closing, the motion has changed before.
pub(super) fn grazing(tracer: &Tracer<MachineProblem>, at: &MachineSolution, found: Difference) -> Difference {
    let Some((machine, ring)) = tracer.problem.equations.split(&at.w) else { return found };
    let (frame, m) = (MachineFrame::new(&machine), ring.len());
    let lowest = |sizes: &mut dyn Iterator<Item = (usize, f64)>| sizes.min_by(|a, b| a.1.total_cmp(&b.1));
    let stops = machine.stops().len();
    let of = |k: usize| ring.events[k % m].guard.place(stops);
    let speed = |k: usize| (k, speed_before(&frame, &ring, k, of(k)).abs());
    let slow = SLOW * at.known.cycle.as_ref().map_or(0.0, |cycle| cycle.sizes.1);
    // the slowest of these impacts disappears, if it grazes
    let slowest = |struck: &dyn Fn(usize) -> bool| {
        let impacts = (0..m).filter(|k| matches!(ring.events[*k].guard, GuardKind::Gap(stop) if struck(stop)));
        let grazes = lowest(&mut impacts.map(speed)).filter(|(_, speed)| *speed < slow);
        grazes.map_or(found, |(at, _)| Difference::Disappears { at, stop: of(at) })
    };
    match found {
        // beside a grazing contact rounding decides how a motion returns that has the events of the cycle
        Difference::Other { place: None } => slowest(&|_| true),
        Difference::Disappears { stop, .. } => {
            let of_stop = (0..m).filter(|k| ring.events[*k].guard == GuardKind::Gap(stop));
            let weakest = lowest(&mut of_stop.map(speed));
            weakest.map_or(found, |(at, _)| Difference::Disappears { at, stop })
        }
        Difference::Appears { stop, .. } => {
            let flights = (0..m).filter_map(|leg| Some((leg, closest(&frame, &ring, (leg, GuardKind::Gap(stop)))?.0)));
            let nearest = lowest(&mut flights.into_iter());
            let size = NEAR * at.known.cycle.as_ref().map_or(f64::INFINITY, |cycle| cycle.sizes.0);
            nearest.map_or(found, |(leg, gap)| {
                if gap.abs() > size {
                    Difference::Other { place: Some(stop) }
                } else {
                    Difference::Appears { at: (leg + 1) % m, stop }
                }
            })
        }
        Difference::Corner { first, second } if first != second => {
            let both = |k: usize| [(first, second), (second, first)].contains(&(of(k), of(k + 1)));
            if (0..m).any(|k| both(k) && ring.theta(k + 1) - ring.theta(k) < SHORT) {
                return found;
            }
            slowest(&|stop| stop == first || stop == second)
        }
        other => other,
    }
}

/// The speed towards a stop, or towards its surface if that stands back, before an event; infinite if there is no flight before
/// it.
pub(super) fn speed_before(frame: &MachineFrame<'_>, ring: &MachineRing, event: usize, stop: usize) -> f64 {
    let before = (event + ring.len() - 1) % ring.len();
    let moved = |mut from: Place| {
        frame.constrain(&mut from)?;
        let structure = frame.structure(&from.states)?;
        Some(frame.moved(&from, &structure, ring.time(before, frame.machine)))
    };
    moved(ring.place(before)).map_or(f64::INFINITY, |at| {
        let rate = at.gap(&frame.normal, &at.turns(&frame.normal), stop).1;
        at.surfaces[stop].map_or(0.0, |surface| surface.rate * surface.size) - rate
    })
}

/// The grazing solution near the last admissible one `inside` at the distance `s` along a step, beyond which the events
/// differ as `found`: its distance, and the solution with what is known of `inside`. `None` if the difference is another
/// one, or no solution grazes close by.
pub(super) fn touching(
    tracer: &Tracer<MachineProblem>,
    step: &Step<Judged>,
    (s, inside): (f64, &MachineSolution),
    found: &Difference,
) -> Option<(f64, MachineSolution)> {
    let value = |s: f64| {
        let w = tracer.between(step, s)?;
        let (machine, ring) = tracer.problem.equations.split(&w)?;
        let (frame, m) = (MachineFrame::new(&machine), ring.len());
        match *found {
            Difference::Appears { at, stop } => {
                Some(closest(&frame, &ring, ((at + m - 1) % m, GuardKind::Gap(stop)))?.0)
            }
            Difference::Disappears { at, stop } => Some(speed_before(&frame, &ring, at, stop)),
            _ => None,
        }
    };
    let (mut last, mut at_last) = (s, value(s)?);
    let beyond = s + FIRST * step.length;
    let mut here = if beyond > step.length { s - FIRST * step.length } else { beyond };
    for step_number in 0..STEPS {
        let at_here = value(here)?;
        if at_here == 0.0 || (step_number > 0 && at_here == at_last) {
            break;
        }
        let next = here - at_here * (here - last) / (at_here - at_last);
        if !((next - s).abs() <= MOST * step.length && (0.0..=step.length).contains(&next)) {
            return None;
        }
        let moved = (next - here).abs();
        (last, at_last, here) = (here, at_here, next);
        if moved <= 2.0 * f64::EPSILON * step.length {
            break;
        }
    }
    let w = tracer.between(step, here)?;
    let tangent = tracer.tangent_at(&w).unwrap_or_else(|| inside.tangent.clone());
    Some((here, Solution { w, tangent, values: inside.values.clone(), known: inside.known.clone() }))
}
