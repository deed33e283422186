//! Guesses of unstable orbits between two stable ones.
//!
//! Between two states that lead to different stable orbits is the border of their basins. A motion that begins on it stays on
//! it, and often comes close to an unstable orbit before rounding takes it to one of both sides (P. M. Battelino, C. Grebogi,
//! E. Ott, J. A. Yorke and E. D. Yorke, "Multiple coexisting attractors, basin boundaries and basic sets", Physica D 32 (1988)
//! 296-305).

use super::crossing::crossing;
use super::cycle::Cycle;
use super::frame::MachineFrame;
use super::lap::MachineLap;
use crate::events::Place;
use crate::system::phase;

/// The number of bisections of the way between two states.
const BISECTIONS: u32 = 44;
/// The largest number of laps until a motion has come close to one of the orbits.
const LAPS: u32 = 300;
/// A motion that is closer than this to a stable orbit, relative to its size, leads to it.
const NEAR: f64 = 1e-2;
/// The laps on the border after which the state is a guess.
const GUESSES: u32 = 16;

/// States on the border between two stable orbits of as many periods, as far as a motion from it stays there.
pub(super) fn on_border(frame: &MachineFrame<'_>, (a, b): (&Cycle, &Cycle), go_on: &dyn Fn() -> bool) -> Vec<Place> {
    find(frame, (a, b), go_on).unwrap_or_default()
}

fn find(frame: &MachineFrame<'_>, (a, b): (&Cycle, &Cycle), go_on: &dyn Fn() -> bool) -> Option<Vec<Place>> {
    let time = frame.time(a.label.periods.max(b.label.periods), a.period.max(b.period));
    let (from, other) = (a.strobes.first()?, b.strobes.first()?);
    // the states of the second orbit at the phase of the first one
    let ahead = frame.machine.parts().frequency.map(|frequency| phase::wrap(from.phase - other.phase) / frequency);
    let moved =
        |place: &Place| ahead.map_or_else(|| Some(place.clone()), |s| Some(MachineLap::replay(frame, place, s)?.end));
    let others: Vec<Place> = b.strobes.iter().map(moved).collect::<Option<_>>()?;
    let to = others.first()?;
    if from.states != to.states {
        return None;
    }
    let (x, y) = (frame.shape.values(from), frame.shape.values(to));
    let at = |part: f64| {
        let mixed: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x + part * (y - x)).collect();
        frame.shape.with_values(from, &mixed)
    };
    let close = |(cycle, strobes): (&Cycle, &[Place]), place: &Place| {
        // without forcing the motion passes the state of the orbit at any time
        let passing = frame.unforced().then(|| crossing(frame, place, cycle)).flatten();
        let place = passing.as_ref().unwrap_or(place);
        strobes.iter().any(|one| frame.distance(one, place, a.sizes) < NEAR)
    };
    // whether the motion leads to the first orbit
    let first = |mut place: Place| {
        for _ in 0..LAPS {
            if close((a, &a.strobes), &place) {
                return Some(true);
            }
            if close((b, &others), &place) || !go_on() {
                return Some(false);
            }
            place = MachineLap::replay(frame, &place, time)?.end;
        }
        None
    };
    // the border lies between a state that leads to the first orbit and one that does not
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if first(at(middle))? { low = middle } else { high = middle }
    }
    let mut place = at(low);
    let mut guesses = Vec::new();
    for _ in 0..GUESSES {
        guesses.push(place.clone());
        place = MachineLap::replay(frame, &place, time)?.end;
    }
    Some(guesses)
}
