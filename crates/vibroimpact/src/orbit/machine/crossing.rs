//! Where a motion of a machine passes the states of a cycle: at their phase, or without forcing in the plane across the flow there.

use super::cycle::Cycle;
use super::frame::MachineFrame;
use super::lap::MachineLap;
use crate::events::Place;
use crate::system::phase;

/// The largest number of steps of Newton's method to the plane.
const CROSSING_STEPS: u32 = 20;

/// The next state of the motion from `place` where it passes those of a cycle, with the nearest of these and their distance.
pub(crate) fn passing<'c>(
    frame: &MachineFrame<'_>,
    place: &Place,
    cycle: &'c Cycle,
) -> Option<(Place, &'c Place, f64)> {
    let real = match frame.machine.parts().frequency {
        Some(frequency) => {
            let first = cycle.strobes.first()?;
            let ahead = phase::wrap(first.phase - place.phase) / frequency;
            let mut real = MachineLap::replay(frame, place, ahead)?.end;
            real.phase = first.phase;
            real
        }
        None => crossing(frame, place, cycle)?,
    };
    let apart = |strobe: &Place| frame.distance(strobe, &real, cycle.sizes);
    let nearest = cycle.strobes.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    let distance = apart(nearest);
    Some((real, nearest, distance))
}

/// The state in which the motion from `place` crosses the plane across the flow at the state of a cycle, within a period of
/// that, nearest to that state.
pub(crate) fn crossing(frame: &MachineFrame<'_>, place: &Place, cycle: &Cycle) -> Option<Place> {
    let (state, period) = (cycle.strobes.first()?, cycle.period);
    let ((size, speed), n) = (cycle.sizes, frame.shape.n);
    // products of differences relative to the sizes of coordinates and velocities
    let scale = |i: usize| if (n..2 * n).contains(&i) { 1.0 / (speed * speed) } else { 1.0 / (size * size) };
    let flow = frame.flow(state)?;
    let along = |of: &[f64]| flow.iter().zip(of).enumerate().map(|(i, (f, x))| f * x * scale(i)).sum::<f64>();
    let lap = MachineLap::replay(frame, place, period)?;
    let flights = lap.steps.iter().filter(|(_, begin, _)| begin.states == state.states);
    let crossings = flights.filter_map(|(_, begin, passage)| {
        let whole = passage.duration.min(period);
        let mut s = 0.5 * whole;
        // Newton's method for the distance from the plane, whose rate is the flow across it
        for _ in 0..CROSSING_STEPS {
            let there = frame.moved(begin, &passage.structure, s);
            let change = along(&frame.apart(&there, state)) / along(&frame.flow(&there)?);
            let next = (s - change).clamp(0.0, whole);
            let moved = (next - s).abs();
            s = next;
            if moved <= f64::EPSILON * whole {
                break;
            }
        }
        Some(frame.moved(begin, &passage.structure, s))
    });
    let apart = |of: &Place| frame.distance(of, state, cycle.sizes);
    crossings.min_by(|a, b| apart(a).total_cmp(&apart(b)))
}
