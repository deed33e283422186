//! Guesses of the cycles of a machine without forcing: where a motion comes close to an earlier state.
//!
//! A motion passes near unstable cycles on its way, so its returns are compared at several times: soon after the start, where
//! it may follow a cycle that it leaves later, and late, where it has settled.

use super::frame::MachineFrame;
use super::ring::RingEvent;
use crate::events::{Motion, Place};
use crate::math::sort_by;
use crate::orbit::Count;

/// The events of a motion after which its returns are looked for.
const AFTER: [usize; 7] = [0, 2, 6, 20, 60, 200, 600];
/// The largest number of events until a return.
const LONGEST: usize = 200;
/// The number of returns, the nearest ones, that are guesses.
const NEAREST: usize = 3;

/// An event of a motion.
struct Passed {
    event: RingEvent,
    place: Place,
    time: f64,
    /// The closings and the complete chatters so far.
    closings: usize,
    chatters: usize,
}

/// States of a motion with the time after which it comes close to them again, the same event having happened and so many
/// closings, but any number after the last of these states.
pub(crate) fn near_returns(frame: &MachineFrame<'_>, motion: Motion<'_>, impacts: Count) -> Vec<(Place, f64)> {
    let passed = events(motion);
    let mut guesses = Vec::new();
    let last = AFTER.into_iter().rfind(|k| k + 1 < passed.len());
    for (k, from) in AFTER.into_iter().filter_map(|k| Some((k, passed.get(k)?))) {
        let returns = |to: &&Passed| {
            let closed = match impacts {
                Count::Finite(m) => to.chatters == from.chatters && to.closings - from.closings == m as usize,
                Count::Infinite => to.chatters > from.chatters,
            };
            (closed || Some(k) == last) && to.event == from.event
        };
        let window = &passed[k + 1..passed.len().min(k + 1 + LONGEST)];
        let sizes = window
            .iter()
            .map(|to| frame.sizes(&to.place))
            .fold((0.0, 0.0), |(x, v): (f64, f64), own| (x.max(own.0), v.max(own.1)));
        let mut nearest: Vec<(f64, &Passed)> =
            window.iter().filter(returns).map(|to| (frame.distance(&from.place, &to.place, sizes), to)).collect();
        sort_by(&mut nearest, |a, b| a.0.total_cmp(&b.0));
        guesses.extend(nearest.iter().take(NEAREST).map(|(_, to)| (from.place.clone(), to.time - from.time)));
    }
    guesses
}

/// The events of a motion, as many as are compared.
fn events(mut motion: Motion<'_>) -> Vec<Passed> {
    let mut passed: Vec<Passed> = Vec::new();
    let (mut closings, mut chatters) = (0, 0);
    let most = AFTER.iter().max().map_or(0, |last| last + LONGEST);
    while passed.len() <= most
        && let Some(passage) = motion.step()
    {
        closings += motion.take_events().iter().filter(|event| event.closes()).count();
        chatters += usize::from(passage.rest.is_some());
        let Some(event) = RingEvent::of(&passage) else { break };
        passed.push(Passed { event, place: motion.place().clone(), time: motion.time(), closings, chatters });
    }
    passed
}
