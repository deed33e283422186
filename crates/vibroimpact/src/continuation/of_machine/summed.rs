//! Chatters on branches: a change of the number of impacts that are followed before the rest of a chatter is summed is no
//! event, and the value at which the number of impacts becomes infinite.

use super::change::Difference;
use super::closest::closest;
use super::problem::{MachineProblem, MachineSolution};
use super::touch::speed_before;
use crate::continuation::trace::tracer::Tracer;
use crate::orbit::{MachineFrame, MachineRing, RingEvent};
use crate::regime::GuardKind;

/// The stop of an impact on this stop alone.
fn struck(event: &RingEvent) -> Option<usize> {
    match (event.guard, &event.pushed[..]) {
        (GuardKind::Gap(stop), [(pushed, _)]) if *pushed == stop => Some(stop),
        _ => None,
    }
}

/// Whether impact `k` belongs to a chatter on its stop that is summed after this impact or a later one.
fn is_summed(ring: &MachineRing, k: usize) -> bool {
    let m = ring.len();
    let stop = struck(&ring.events[k]);
    let mut own = (k..k + m).map(|i| &ring.events[i % m]).take_while(|event| stop.is_some() && struck(event) == stop);
    own.any(|event| event.pushed[0].1)
}

/// Whether a chatter on this stop is summed.
pub(super) fn sums(ring: &MachineRing, stop: usize) -> bool {
    ring.events.iter().any(|event| struck(event) == Some(stop) && event.pushed[0].1)
}

/// The signature with one impact for each chatter.
fn collapsed(ring: &MachineRing) -> Vec<&RingEvent> {
    let m = ring.len();
    let goes_on = |k: usize| {
        is_summed(ring, k)
            && !ring.events[k].pushed[0].1
            && struck(&ring.events[k]) == struck(&ring.events[(k + 1) % m])
    };
    (0..m).filter(|k| !goes_on(*k)).map(|k| &ring.events[k]).collect()
}

/// Whether two lists are the same in cyclic order.
pub(super) fn same_in_turn<T: PartialEq>(a: &[T], b: &[T]) -> bool {
    let m = a.len();
    m == b.len() && (0..m).any(|shift| (0..m).all(|k| a[k] == b[(k + shift) % m]))
}

/// Whether two signatures differ only in how many impacts of chatters are followed.
pub(super) fn same_but_for_sums(a: &MachineRing, b: &MachineRing) -> bool {
    same_in_turn(&collapsed(a), &collapsed(b))
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
    let own = |k: usize| struck(&ring.events[k]) == Some(stop);
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

/// The largest ratio of successive distances from which a limit is extrapolated.
const SLOWEST: f64 = 0.95;

/// The limit of a sequence whose distances to it decrease by a nearly constant factor, by Aitken's transformation, repeated for
/// the sequence of limits (A. C. Aitken, Proc. Roy. Soc. Edinburgh 46 (1927) 289-305). `None` if they do not decrease so.
pub(super) fn limit(mut values: Vec<f64>) -> Option<f64> {
    let mut last = None;
    while values.len() >= 3 {
        let next = |of: &[f64]| {
            let ratio = (of[2] - of[1]) / (of[1] - of[0]);
            (0.0..SLOWEST).contains(&ratio).then(|| of[2] + (of[2] - of[1]) * ratio / (1.0 - ratio))
        };
        let Some(limits) = values.windows(3).map(next).collect::<Option<Vec<f64>>>() else { break };
        last = limits.last().copied();
        values = limits;
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_of_sums() {
        let values =
            |count: i32| (1..=count).map(|k| 1.0 - 0.5_f64.powi(k) + 0.1 * 0.2_f64.powi(k)).collect::<Vec<f64>>();
        let error = |count| (limit(values(count)).unwrap() - 1.0).abs();
        // the second factor is left after the first transformation
        assert!(error(3) < 1e-2 && error(5) < 1e-4, "{} {}", error(3), error(5));
        assert_eq!(limit(vec![1.0, 2.0]), None);
        assert_eq!(limit(vec![1.0, 2.0, 4.0]), None);
    }
}
