//! Where a flight of a cycle comes closest to a guard: to a stop, to the velocity of a belt, or to the limit of a reaction.

use crate::events::{EventLaw, Place};
use crate::orbit::{MachineFrame, MachineRing};
use crate::regime::GuardKind;

/// The number of equal parts of a flight in which one minimum of the guard is looked for. The first is divided further, each
/// part shorter than the next, because after an impact of a chatter the stop is close by soon.
const PARTS: u32 = 400;
const EARLY: usize = 60;
const SHORTER: f64 = 1.25;

/// The smallest of the minima of a guard on the flight after event `leg`, and the state there, with a phase that continues
/// those of the ring. The gap of a stop whose surface stands back is that of the surface. `None` if the guard has no
/// minimum, or belongs to another regime.
pub(crate) fn closest(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (leg, kind): (usize, GuardKind),
) -> Option<(f64, Place)> {
    let mut from = ring.place(leg);
    frame.constrain(&mut from)?;
    let structure = frame.structure(&from.states)?;
    let guard = structure.guards.iter().position(|guard| guard.kind == kind)?;
    let law = EventLaw { structure: &structure, guards: &[guard], pushed: &[], rounds: &[] };
    let time = ring.time(leg, frame.machine);
    let at = |s: f64| {
        let place = frame.moved(&from, &structure, s);
        let (value, rate) = law.value_and_rate(&frame.normal, &place);
        (value, rate, place)
    };
    let part = time / f64::from(PARTS);
    let mut early: Vec<f64> = core::iter::successors(Some(part), |s| Some(s / SHORTER)).take(EARLY).collect();
    early.reverse();
    let times = core::iter::once(0.0).chain(early).chain((2..=PARTS).map(|k| part * f64::from(k)));
    let steps: Vec<(f64, f64)> = times.map(|s| (s, at(s).1)).collect();
    // at an event of the same contact, or in contact with a surface that stands back, the guard begins at zero
    let stops = frame.machine.stops().len();
    let own = kind.place(stops);
    let standing = own < stops && from.surfaces[own].is_some();
    let begun = usize::from(standing || ring.events[leg].guard.place(stops) == own);
    let turning = steps.windows(2).skip(begun).filter(|pair| pair[0].1 < 0.0 && pair[1].1 >= 0.0);
    let lowest = turning
        .map(|pair| {
            let (mut low, mut high) = (pair[0].0, pair[1].0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if at(middle).1 < 0.0 { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        })
        .min_by(|a, b| at(*a).0.total_cmp(&at(*b).0))?;
    let (value, _, mut place) = at(lowest);
    place.phase = ring.theta(leg) + ring.frequency(frame.machine) * lowest;
    Some((value, place))
}
