//! Chatters on branches: how many of their impacts are followed before the rest is no property of a cycle.

use super::change::Difference;
use super::closest::closest;
use super::problem::{MachineProblem, MachineSolution};
use super::touch::speed_before;
use crate::continuation::trace::tracer::Tracer;
use crate::orbit::{MachineFrame, MachineRing, RingEvent};
use crate::regime::GuardKind;

/// Whether impact `k` belongs to a chatter on its stop that is summed after this impact or a later one.
fn is_summed(ring: &MachineRing, k: usize) -> bool {
    let m = ring.len();
    let stop = ring.events[k].struck();
    let mut own = (k..k + m).map(|i| &ring.events[i % m]).take_while(|event| stop.is_some() && event.struck() == stop);
    own.any(|event| event.pushed[0].1)
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

/// The rest after a chatter at the beginning of a list of events: its place, and the stop.
fn rest_in<'a>(events: impl Iterator<Item = &'a RingEvent>) -> Option<(usize, usize)> {
    let mut own = None;
    for (i, event) in events.enumerate() {
        let stop = event.struck().filter(|stop| own.is_none_or(|own| own == *stop))?;
        if event.rests_on().is_some() {
            return Some((i, stop));
        }
        own = Some(stop);
    }
    None
}

/// The longest flight, as a phase, between impacts that are left out.
const SOON: f64 = 0.05;

/// The events of a motion, where a chatter has as many impacts as in the signature if it has all those before the rest of the
/// signature begins. Events are given with their phases since the beginning of the motion.
pub(crate) fn matched(wanted: &[(f64, &RingEvent)], seen: &[(f64, RingEvent)]) -> Vec<RingEvent> {
    let mut events: Vec<RingEvent> = Vec::with_capacity(seen.len());
    let (mut i, mut j) = (0, 0);
    while j < seen.len() {
        let own = wanted.get(i..).and_then(|wanted| rest_in(wanted.iter().map(|(_, event)| *event)));
        let other = rest_in(seen[j..].iter().map(|(_, event)| event));
        match (own, other) {
            (Some((impacts, stop)), Some((followed, same))) if stop == same => {
                let rest = i + impacts;
                let before = if rest > 0 { wanted[rest - 1].0 } else { 0.0 };
                let until = 0.5 * (before + wanted[rest].0);
                let early = seen[j..j + followed].iter().filter(|(phase, _)| *phase < until).count();
                let soon = seen[j + early..=j + followed].windows(2).all(|pair| pair[1].0 - pair[0].0 < SOON);
                // the motion itself can have gone over to its rest before
                if early == impacts && soon || followed < impacts && seen[j + followed].0 < until {
                    events.extend(wanted[i..=rest].iter().map(|(_, event)| (*event).clone()));
                } else {
                    let own = j..j + if early == impacts { followed } else { early };
                    events.extend(seen[own].iter().map(|(_, event)| event.clone()));
                    events.push(seen[j + followed].1.clone());
                }
                (i, j) = (rest + 1, j + followed + 1);
            }
            _ => {
                events.push(seen[j].1.clone());
                (i, j) = (i + 1, j + 1);
            }
        }
    }
    events
}

/// A gap or a speed that is larger, relative to the motion, is not that of a grazing contact; and an impact that grazes is slower
/// by this factor than the next one. The last impacts of a chatter are as slow, but not much slower than those after them.
const NEAR: f64 = 1e-8;
const SLOWER: f64 = 1e-3;

/// The grazing contact of a cycle with a chatter on `stop`: a flight that touches the stop, or an impact of speed zero, which is
/// slower than the next one. `sizes` are those of its coordinates and velocities.
fn grazes(frame: &MachineFrame<'_>, ring: &MachineRing, stop: usize, sizes: (f64, f64)) -> Option<Difference> {
    let m = ring.len();
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
