//! Where a flight of a cycle comes closest to a stop.

use crate::events::Place;
use crate::orbit::{MachineFrame, MachineRing};

/// The number of parts of a flight in which one minimum of the gap is looked for.
const PARTS: u32 = 400;

/// The smallest of the minima of the gap of `stop`, or of its surface that stands back, on the flight after event `leg`, and
/// the state there, with a phase that continues those of the ring; `None` if the gap has no minimum.
pub(crate) fn closest(
    frame: &MachineFrame<'_>,
    ring: &MachineRing,
    (leg, stop): (usize, usize),
) -> Option<(f64, Place)> {
    let frequency = frame.machine.parts().frequency?;
    let mut from = ring.place(leg);
    frame.constrain(&mut from)?;
    let structure = frame.structure(&from.states)?;
    let time = ring.time(leg, frequency);
    let gap = |s: f64| {
        let place = frame.moved(&from, &structure, s);
        let turns = place.turns(&frame.normal);
        let (mut gap, mut rate, ..) = place.gap(&frame.normal, &turns, stop);
        if let Some(surface) = place.surfaces[stop] {
            gap += surface.size - surface.offset;
            rate -= surface.rate * surface.size;
        }
        (gap, rate, place)
    };
    let steps: Vec<(f64, f64)> =
        (0..=PARTS).map(|k| time * f64::from(k) / f64::from(PARTS)).map(|s| (s, gap(s).1)).collect();
    // a surface that stands back begins in contact
    let begun = usize::from(from.surfaces[stop].is_some());
    let turning = steps.windows(2).skip(begun).filter(|pair| pair[0].1 < 0.0 && pair[1].1 >= 0.0);
    let lowest = turning
        .map(|pair| {
            let (mut low, mut high) = (pair[0].0, pair[1].0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if gap(middle).1 < 0.0 { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        })
        .min_by(|a, b| gap(*a).0.total_cmp(&gap(*b).0))?;
    let (gap, _, mut place) = gap(lowest);
    place.phase = ring.theta(leg) + frequency * lowest;
    Some((gap, place))
}
