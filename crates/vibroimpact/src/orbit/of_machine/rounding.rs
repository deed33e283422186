//! Whether rounding errors decide the period of a motion that comes to rest.
//!
//! A rest forgets what was before, so a motion that returns to a release has the same state again, whatever happened on the way.
//! That it closes is no evidence of the way. There each event adds rounding errors, and the derivatives of flights and
//! events carry them on: with the covariance $`E`$ of the errors and the derivative $`A`$ of a step,
//! $`E_+ = AEA' + D`$, where $`D`$ is that of new errors. Where the errors become as large as the differences between motions that
//! end otherwise, numbers of these digits do not know how many periods pass until the next rest.
//!
//! The linear law does not see a contact that is nearly missed or nearly made, nor that a chatter forgets errors at its end. If the
//! errors grow noticeably, neighbours at the distance of a few roundings are followed from the release on: all must come
//! back.

use super::frame::MachineFrame;
use super::lap::MachineLap;
use crate::events::{Passage, Place, step_derivative};
use crate::math::Matrix;

/// New errors of each step, relative to the sizes of coordinates and velocities.
const NEW: f64 = 2.0 * f64::EPSILON;
/// Errors above this are noticeable: neighbours are followed.
const NOTICEABLE: f64 = 1e-9;
/// The distance of these neighbours, their number, and how near they must come back.
const BESIDE: f64 = 8.0 * f64::EPSILON;
const NEIGHBOURS: usize = 4;
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
    error.is_nan() || error > NOTICEABLE && neighbours_part(frame, lap, (first, most)).unwrap_or(true)
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
    let end = MachineLap::fly(frame, &middle, lap.time)?.end;
    let (size, speed) = lap.sizes;
    let n = frame.shape.n;
    for neighbour in 0..NEIGHBOURS {
        let mut values = frame.shape.values(&middle);
        for (i, value) in values.iter_mut().enumerate() {
            let scale = if (n..2 * n).contains(&i) { speed } else { size };
            // each neighbour on another side
            let sign = if ((neighbour + 1) >> (i % 2)) & 1 == usize::from(i / 2 % 2 == 1) { -1.0 } else { 1.0 };
            *value += sign * BESIDE * scale;
        }
        let mut beside = frame.shape.with_values(&middle, &values);
        frame.constrain(&mut beside)?;
        let other = MachineLap::fly(frame, &beside, lap.time)?;
        if frame.distance(&end, &other.end, lap.sizes) > BACK {
            return Some(true);
        }
    }
    Some(false)
}
