//! Differences of neighbouring motions along a motion: an orthonormal frame of them, and how each is stretched.
//!
//! Lengths are those of a [`Metric`], because coordinates, velocities and surfaces have units of their own.
//!
//! A frame $`Q`$ becomes $`AQ = Q_+R`$ with the derivative $`A`$ of a flight or of an event. The elements of the diagonal of $`R`$
//! are the stretches. Those of a flight are found with the digits of all directions that decay (`graded_flight`), so a
//! stretch is no rounding error however small it is. It is 0 only where neighbouring motions become the same: where the structure
//! comes to rest, a joint holds or an impact is without restitution.

use super::passage::Passage;
use super::place::{Place, Structures};
use super::saltation::{EventDerivative, StateShape};
use crate::arc::combined;
use crate::machine::Machine;
use crate::math::{Graded, GradedFactors, Matrix, add_scaled, dot, ln};
use crate::regime::{Normal, Structure};
use std::sync::Arc;

/// Where neighbouring motions can become the same, a difference that becomes less than this part of what it can become has
/// vanished: it is a rounding error.
const VANISHED: f64 = 1e-12;
/// A change that differs by no more than this part of it from what others span depends on them.
const DEPENDENT: f64 = 1e-9;
/// A structure without modes is followed in parts of this time at the fastest rate of decay.
const PART: f64 = 4.0;

/// The squares of the weights of the components of a difference: its length is the root of their sum. Without weights all are 1.
#[derive(Clone, Debug, Default)]
pub(crate) struct Metric(Vec<f64>);

impl Metric {
    /// A velocity weighs as the way in the time in which the forcing, or without forcing the fastest mode with all stops open, goes on
    /// by a radian. A surface weighs as the coordinates that move the body by as much. So lengths do not depend on units of mass,
    /// length and time; of free bodies without forcing they depend on that of time.
    pub(crate) fn of(shape: &StateShape, machine: &Machine, normal: &Normal, fastest: f64) -> Self {
        let rate = machine.parts().frequency.unwrap_or(fastest);
        let velocity = if rate > 0.0 { 1.0 / (rate * rate) } else { 1.0 };
        let surfaces = shape.surfaces.iter().map(|j| 1.0 / normal.squares[*j]);
        let states = (0..2 * shape.n).map(|i| if i < shape.n { 1.0 } else { velocity });
        Self(states.chain(surfaces).collect())
    }

    pub(crate) fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        if self.0.is_empty() {
            return dot(a, b);
        }
        self.0.iter().zip(a.iter().zip(b)).map(|(weight, (a, b))| weight * (a * b)).sum()
    }

    /// The largest element of a matrix, relative to the weights of its row and column.
    fn largest(&self, of: &Matrix) -> f64 {
        if self.0.is_empty() {
            return of.largest();
        }
        let element = |i: usize, j: usize| of[(i, j)].abs() * (self.0[i] / self.0[j]).sqrt();
        (0..of.rows())
            .flat_map(|i| (0..of.columns()).map(move |j| (i, j)))
            .fold(0.0, |most, (i, j)| most.max(element(i, j)))
    }
}

/// A part of a motion, to first order.
#[derive(Clone, Debug)]
pub(crate) enum TangentStep {
    /// A flight in one regime from a state, over a time.
    Flight(Arc<Structure>, Box<Place>, f64),
    /// An event with its derivative, and whether neighbouring motions can become the same in it.
    Event(EventDerivative, bool),
}

/// How a frame has been stretched: $`R = L\,\mathrm{diag}(e^{s})\,U`$ with upper triangular factors, for the vectors of the
/// frame that have been kept.
#[derive(Clone, Debug)]
pub(crate) struct FrameChange {
    pub(crate) left: Matrix,
    pub(crate) scales: Vec<f64>,
    pub(crate) right: Matrix,
    /// The vectors of the frame before that have not vanished.
    pub(crate) kept: Vec<usize>,
}

impl FrameChange {
    /// The logarithm of the stretch of a vector that is kept.
    pub(crate) fn log(&self, k: usize) -> f64 {
        ln(self.left[(k, k)].abs()) + self.scales[k] + ln(self.right[(k, k)].abs())
    }
}

/// The parts of a step from `begin`; `None` where a guard is only touched.
pub(crate) fn tangent_steps(
    shape: &StateShape,
    machine: &Machine,
    normal: &Normal,
    structures: &mut Structures,
    (begin, passage): (&Place, &Passage),
) -> Option<Vec<TangentStep>> {
    let flight = |structure: &Arc<Structure>, from: &Place, time| {
        TangentStep::Flight(structure.clone(), Box::new(from.clone()), time)
    };
    let mut steps = vec![flight(&passage.structure, begin, passage.duration)];
    if passage.guards.is_empty() {
        return Some(steps);
    }
    let after = passage.after.as_ref()?;
    let event = EventDerivative::of(shape, machine, normal, structures, passage)?;
    // a contact that begins to constrain takes differences away
    let constrained = begin.states.iter().zip(&after.states).any(|(was, now)| now.constrains() && !was.constrains());
    // and so does an impact without rebound
    let forgets = constrained || passage.pushed.iter().any(|(_, restitution)| *restitution == 0.0);
    steps.push(TangentStep::Event(event, forgets));
    if let Some((rest, time)) = &passage.rest {
        steps.push(flight(rest, after, *time));
    }
    Some(steps)
}

impl TangentStep {
    /// Moves a frame, which is orthonormal again then by the metric, without the vectors that vanish. `remove` takes away what is no
    /// difference of motions.
    pub(crate) fn carry(
        &self,
        shape: &StateShape,
        normal: &Normal,
        frame: &mut Vec<Vec<f64>>,
        (metric, remove): (&Metric, &impl Fn(&mut Vec<f64>)),
    ) -> Vec<FrameChange> {
        match self {
            Self::Event(derivative, forgets) => {
                let (rows, back) = after_event(derivative, frame, (metric, remove));
                let vanished = if *forgets { VANISHED } else { 0.0 };
                vec![factored(frame, (rows.factors(frame.len(), vanished), &back), (metric, remove))]
            }
            Self::Flight(structure, from, time) => {
                if frame.is_empty() {
                    return Vec::new();
                }
                if let Some(stretch) = graded(shape, normal, (structure, from, *time), frame, (metric, remove)) {
                    return vec![stretch];
                }
                // in parts, in which the fastest decay stays above rounding errors
                let parts = (structure.contraction() * time / PART).ceil().max(1.0);
                let part = shape.transition(structure, normal, from, time / parts);
                let least = VANISHED * metric.largest(&part);
                let mut stretches = Vec::new();
                let mut k = 0.0;
                while k < parts {
                    let vectors = frame.iter().map(|vector| part.apply(vector)).collect();
                    // only the first part can find vectors that the constraints do not allow
                    stretches.push(orthonormal(frame, (vectors, remove), (metric, if k == 0.0 { least } else { 0.0 })));
                    k += 1.0;
                }
                stretches
            }
        }
    }
}

/// Moves a frame by a flight of a structure with modes.
fn graded(
    shape: &StateShape,
    normal: &Normal,
    (structure, from, time): (&Structure, &Place, f64),
    frame: &mut Vec<Vec<f64>>,
    (metric, remove): (&Metric, &impl Fn(&mut Vec<f64>)),
) -> Option<FrameChange> {
    let (mut rows, mut back) = structure.graded(normal, time, frame)?;
    let size = shape.size();
    back.iter_mut().for_each(|state| state.resize(size, 0.0));
    // a surface recovers by itself: a direction of its own, which decays at its rate
    for (k, j) in shape.surfaces.iter().enumerate() {
        if let Some(surface) = from.surfaces[*j] {
            let mut unit = vec![0.0; size];
            unit[2 * shape.n + k] = 1.0;
            rows.push(frame.iter().map(|vector| vector[2 * shape.n + k]).collect(), -surface.rate * time);
            back.push(unit);
        }
    }
    let factors = rows.factors(frame.len(), 0.0);
    Some(factored(frame, (factors, &back), (metric, remove)))
}

/// The frame after an event, as rows: what each vector has along the changes by which guards are late, which can be many powers of
/// ten larger than all else, and its components apart from these; with the states that belong to the rows.
fn after_event(
    EventDerivative { reset, late }: &EventDerivative,
    frame: &[Vec<f64>],
    (metric, remove): (&Metric, &impl Fn(&mut Vec<f64>)),
) -> (Graded, Vec<Vec<f64>>) {
    let mut images: Vec<Vec<f64>> = frame.iter().map(|vector| reset.apply(vector)).collect();
    let mut changes: Vec<Vec<f64>> = late.iter().map(|(late, _)| late.clone()).collect();
    images.iter_mut().chain(&mut changes).for_each(remove);
    let mut back: Vec<Vec<f64>> = Vec::new();
    for change in &changes {
        let mut left = change.clone();
        for other in back.iter().chain(&back) {
            let part = metric.product(other, &left);
            add_scaled(&mut left, -part, other);
        }
        let size = metric.product(&left, &left).sqrt();
        if size > DEPENDENT * metric.product(change, change).sqrt() {
            back.push(left.iter().map(|x| x / size).collect());
        }
    }
    let mut rows = Graded::default();
    for along in &back {
        let mut row: Vec<f64> = Vec::with_capacity(frame.len());
        for (image, vector) in images.iter_mut().zip(frame) {
            let own = metric.product(along, image);
            add_scaled(image, -own, along);
            let by_guards = changes.iter().zip(late);
            row.push(by_guards.fold(own, |sum, (change, (_, h))| sum + metric.product(along, change) * dot(h, vector)));
        }
        rows.push(row, 0.0);
    }
    for i in 0..reset.rows() {
        rows.push(images.iter().map(|image| image[i]).collect(), 0.0);
        let mut unit = vec![0.0; reset.rows()];
        unit[i] = 1.0;
        back.push(unit);
    }
    (rows, back)
}

/// Moves a frame to the vectors with these factors, by rows that belong to the states `back`.
fn factored(
    frame: &mut Vec<Vec<f64>>,
    (factors, back): (GradedFactors, &[Vec<f64>]),
    (metric, remove): (&Metric, &impl Fn(&mut Vec<f64>)),
) -> FrameChange {
    // the vectors with a scale: the others have vanished
    let there: Vec<usize> = (0..frame.len()).filter(|j| factors.scales[*j] > f64::NEG_INFINITY).collect();
    let vectors = there.iter().map(|j| combined(back, &factors.lower[*j])).collect();
    // the frame is made orthonormal once more: the triangular factors multiply
    let FrameChange { left, kept, .. } = orthonormal(frame, (vectors, remove), (metric, 0.0));
    let kept: Vec<usize> = kept.iter().map(|j| there[*j]).collect();
    let mut right = Matrix::zeros(kept.len(), kept.len());
    for (i, row) in kept.iter().enumerate() {
        for (j, column) in kept.iter().enumerate().skip(i) {
            right[(i, j)] = factors.upper[(*row, *column)];
        }
    }
    FrameChange { left, scales: kept.iter().map(|j| factors.scales[*j]).collect(), right, kept }
}

/// Makes vectors orthonormal, in the place of a frame. Those that are left with no more than `least` beside the ones before them
/// have vanished.
fn orthonormal(
    frame: &mut Vec<Vec<f64>>,
    (vectors, remove): (Vec<Vec<f64>>, &impl Fn(&mut Vec<f64>)),
    (metric, least): (&Metric, f64),
) -> FrameChange {
    frame.clear();
    let (mut rows, mut kept): (Vec<Vec<f64>>, Vec<usize>) = Default::default();
    for (j, mut vector) in vectors.into_iter().enumerate() {
        remove(&mut vector);
        let mut shares = vec![0.0; frame.len()];
        // twice, because once leaves rounding errors of the original length
        for _ in 0..2 {
            for (share, other) in shares.iter_mut().zip(frame.iter()) {
                let part = metric.product(other, &vector);
                add_scaled(&mut vector, -part, other);
                *share += part;
            }
        }
        let length = metric.product(&vector, &vector).sqrt();
        if length > least {
            vector.iter_mut().for_each(|x| *x /= length);
            shares.push(length);
            frame.push(vector);
            rows.push(shares);
            kept.push(j);
        }
    }
    let d = kept.len();
    let mut left = Matrix::zeros(d, d);
    for (j, column) in rows.iter().enumerate() {
        for (i, value) in column.iter().enumerate() {
            left[(i, j)] = *value;
        }
    }
    FrameChange { left, scales: vec![0.0; d], right: Matrix::identity(d), kept }
}

/// The logarithms of the stretches of a frame in a step, in the order of its vectors before: minus infinity for those that have
/// vanished.
pub(crate) fn stretched(
    shape: &StateShape,
    normal: &Normal,
    steps: &[TangentStep],
    frame: &mut Vec<Vec<f64>>,
    metric: &Metric,
) -> Vec<f64> {
    let mut logs = vec![0.0; frame.len()];
    let mut there: Vec<usize> = (0..frame.len()).collect();
    for step in steps {
        for stretch in step.carry(shape, normal, frame, (metric, &|_: &mut Vec<f64>| ())) {
            // the places in the frame with which the step began
            let kept: Vec<usize> = stretch.kept.iter().map(|k| there[*k]).collect();
            there.iter().filter(|k| !kept.contains(k)).for_each(|k| logs[*k] = f64::NEG_INFINITY);
            kept.iter().enumerate().for_each(|(k, place)| logs[*place] += stretch.log(k));
            there = kept;
        }
    }
    logs
}
