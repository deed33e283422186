//! How the events of a cycle with a complete chatter change.

use super::change::Difference;
use super::closest::closest;
use super::problem::{MachineProblem, MachineSolution};
use crate::continuation::trace::tracer::Tracer;
use crate::events::Place;
use crate::orbit::{Chatter, MachineFrame, MachineRing};
use crate::regime::GuardKind;

/// Whether impact `k` belongs to a chatter on its stop that is summed after this impact or a later one.
fn is_summed(ring: &MachineRing, k: usize) -> bool {
    Chatter::all(ring).iter().any(|chatter| chatter.rest == k || chatter.impacts(ring).contains(&k))
}

/// Whether a chatter on this stop is summed.
pub(super) fn sums(ring: &MachineRing, stop: usize) -> bool {
    ring.events.iter().any(|event| event.rests_on() == Some(stop))
}

/// Whether two lists are the same in cyclic order.
pub(super) fn same_in_turn<T: PartialEq>(a: &[T], b: &[T]) -> bool {
    let m = a.len();
    m == b.len() && (0..m).any(|shift| (0..m).all(|k| a[k] == b[(k + shift) % m]))
}

/// The speed towards a stop, or towards its surface if that stands back, before an event; infinite if there is no flight before
/// it.
fn speed_before(frame: &MachineFrame<'_>, ring: &MachineRing, event: usize, stop: usize) -> f64 {
    let before = (event + ring.len() - 1) % ring.len();
    let moved = |mut from: Place| {
        frame.constrain(&mut from)?;
        let structure = frame.structure(&from.states)?;
        Some(frame.moved(&from, &structure, ring.time(before, frame.machine)))
    };
    moved(ring.place(before)).map_or(f64::INFINITY, |at| {
        let rate = frame.gap(&at, stop).1;
        at.surfaces[stop].map_or(0.0, |surface| surface.rate * surface.size) - rate
    })
}

/// A gap or a speed that is larger, relative to the motion, is not that of a grazing contact; and an impact that grazes is slower
/// by this factor than the next one. The last impacts of a chatter are as slow, but not much slower than those after them.
const NEAR: f64 = 1e-8;
const SLOWER: f64 = 1e-3;

/// The grazing contact of a cycle with a chatter on `stop`: a flight that touches the stop, or an impact of speed zero, which is
/// slower than the next one. `sizes` are those of its coordinates and velocities.
fn grazes(frame: &MachineFrame<'_>, ring: &MachineRing, stop: usize, sizes: (f64, f64)) -> Option<Difference> {
    let (m, sizes) = (ring.len(), frame.normal.along(stop, sizes));
    let near = |leg: &usize| {
        closest(frame, ring, (*leg, GuardKind::Gap(stop))).is_some_and(|(gap, _)| gap.abs() < NEAR * sizes.0)
    };
    let speed = |k: usize| speed_before(frame, ring, k, stop);
    let own = |k: usize| ring.events[k].struck() == Some(stop);
    let slow = |k: &usize| {
        let next = (k + 1) % m;
        own(*k) && own(next) && speed(*k).abs() < (NEAR * sizes.1).min(SLOWER * speed(next))
    };
    let flight = (0..m).find(near).map(|leg| Difference::Appears { at: (leg + 1) % m, stop });
    flight.or_else(|| (0..m).find(slow).map(|at| Difference::Disappears { at, stop }))
}

/// The same difference, but for chatters: a grazing contact that changes the number of their impacts, or a change only of the
/// number of those that are followed before the sum.
pub(super) fn of_chatter(tracer: &Tracer<MachineProblem>, inside: &MachineSolution, found: Difference) -> Difference {
    let (Difference::Rest { place: stop, joint: false, .. } | Difference::Disappears { stop, .. }) = found else {
        return found;
    };
    let Some((machine, ring)) = tracer.problem.equations.split(&inside.w) else { return found };
    let Some(cycle) = inside.known.cycle.as_ref().filter(|_| sums(&ring, stop)) else { return found };
    grazes(&MachineFrame::new(&machine), &ring, stop, cycle.sizes).unwrap_or(match found {
        // the last impacts of a chatter are so slow that rounding decides which of them happen
        Difference::Disappears { at, .. } if is_summed(&ring, at) => {
            Difference::Rest { place: stop, joint: false, begins: false }
        }
        _ => found,
    })
}
