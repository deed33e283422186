//! Whether rounding errors decide the period of a motion of a machine that comes to rest, by the rule of
//! [`error_growth`].

use super::frame::MachineFrame;
use super::lap::MachineLap;
use crate::events::{Passage, Place, step_derivative};
use crate::math::Matrix;
use crate::orbit::error_growth::{self, NEIGHBOURS, NEW};

/// How near, relative to the motion, neighbours must come back.
const BACK: f64 = 1e-6;

type LapStep = (f64, Place, Passage);

/// The number of constraints in a step.
fn held((_, from, _): &LapStep) -> usize {
    from.states.iter().filter(|state| state.constrains()).count()
}

/// Whether rounding errors decide how the motion over a lap, which returns to its beginning, goes on after its longest rest.
/// `false` for a motion that rests nowhere: that it closes is evidence then.
pub(crate) fn rounding_decides(frame: &MachineFrame<'_>, lap: &MachineLap) -> bool {
    let Some(most) = lap.steps.iter().map(held).max().filter(|most| *most > 0) else { return false };
    let count = lap.steps.len();
    let Some(first) = (0..count).find(|k| held(&lap.steps[*k]) == most) else { return false };
    // the largest error after any step, if it is that of new errors at the rest
    let Some(error) = largest_error(frame, lap, (0..count).map(|k| (first + k) % count)) else { return false };
    error_growth::decide(error, || neighbours_part(frame, lap, (first, most)))
}

/// The largest error, relative to the sizes of coordinates and velocities, on the way through these steps of a lap. `None` where a
/// derivative is infinite.
fn largest_error(frame: &MachineFrame<'_>, lap: &MachineLap, steps: impl Iterator<Item = usize>) -> Option<f64> {
    let (shape, normal) = (&frame.shape, &frame.normal);
    let (n, (size, speed)) = (shape.n, lap.sizes);
    let scale = |i: usize| if (n..2 * n).contains(&i) { speed } else { size };
    let mut errors = Matrix::zeros(shape.size(), shape.size());
    let mut largest = 0.0_f64;
    for k in steps {
        let (begin, from, passage) = &lap.steps[k];
        let left = lap.time - begin;
        let derivative = if left <= passage.duration {
            shape.transition(&passage.structure, normal, from, left)
        } else {
            frame.with(|structures| step_derivative(shape, frame.machine, normal, structures, from, passage))?
        };
        // the errors so far, carried through the step, and new ones
        errors = derivative.times(&errors).times(&derivative.transposed());
        for i in 0..shape.size() {
            let new = NEW * scale(i);
            errors[(i, i)] += new * new;
            if scale(i) > 0.0 {
                largest = largest.max(errors[(i, i)].sqrt() / scale(i));
            }
        }
        if !errors.values().iter().all(|error| error.is_finite()) {
            return Some(f64::INFINITY);
        }
    }
    Some(largest)
}

/// Whether neighbours of the motion at the distance of a few roundings, in the middle of the first flight after its rest with the
/// most constraints, which begins with a step, do not come back to where it comes back.
fn neighbours_part(frame: &MachineFrame<'_>, lap: &MachineLap, (rest, most): (usize, usize)) -> Option<bool> {
    let count = lap.steps.len();
    let mut after = (0..count).map(|k| &lap.steps[(rest + k) % count]);
    let (_, from, passage) = after.find(|step| held(step) < most && step.2.duration > 0.0)?;
    let middle = frame.moved(from, &passage.structure, 0.5 * passage.duration.min(lap.time));
    let end = MachineLap::replay(frame, &middle, lap.time)?.end;
    let (size, speed) = lap.sizes;
    let n = frame.shape.n;
    for neighbour in 0..NEIGHBOURS {
        let mut values = frame.shape.values(&middle);
        for (i, value) in values.iter_mut().enumerate() {
            let scale = if (n..2 * n).contains(&i) { speed } else { size };
            *value += error_growth::beside(neighbour, i) * scale;
        }
        let mut beside = frame.shape.with_values(&middle, &values);
        frame.constrain(&mut beside)?;
        let other = MachineLap::replay(frame, &beside, lap.time)?;
        if frame.distance(&end, &other.end, lap.sizes) > BACK {
            return Some(true);
        }
    }
    Some(false)
}
