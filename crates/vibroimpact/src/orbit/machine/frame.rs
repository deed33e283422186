//! A machine together with what its motions need again and again: mass-normalised coordinates and the structures of its
//! regimes.

use crate::arc::{MachineFlight, Modes};
use crate::events::{Limits, Metric, Motion, Place, StateShape, Structures};
use crate::machine::Machine;
use crate::math::{Matrix, add_scaled, dot};
use crate::orbit::rounding;
use crate::regime::{ContactState, Normal, Structure, Translations};
use crate::system::phase;
use core::cell::RefCell;
use std::sync::Arc;

/// A machine and the structures of its regimes.
#[derive(Clone, Debug)]
pub(crate) struct MachineFrame<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) normal: Normal,
    pub(crate) shape: StateShape,
    structures: RefCell<Structures>,
}

/// The largest difference of two states but for a translation, relative to the sizes of coordinates and velocities; infinite
/// in different regimes.
pub(crate) fn distance(free: &Translations, (a, b): (&Place, &Place), (size, speed): (f64, f64)) -> f64 {
    if a.states != b.states {
        return f64::INFINITY;
    }
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    // along a free translation all places are the same motion
    let x = if free.is_empty() {
        apart(&a.x, &b.x)
    } else {
        let mut x: Vec<f64> = a.x.iter().zip(&b.x).map(|(a, b)| a - b).collect();
        free.remove(&mut x);
        x.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    // two zeros are not apart, also where the size is zero
    let part = |apart: f64, size: f64| if apart == 0.0 { 0.0 } else { apart / size };
    let (x, v) = (part(x, size), part(apart(&a.v, &b.v), speed));
    x.max(v).max(phase::difference(a.phase, b.phase).abs())
}

impl<'a> MachineFrame<'a> {
    pub(crate) fn new(machine: &'a Machine) -> Self {
        let (normal, shape) = (Normal::new(machine), StateShape::of(machine));
        Self { machine, normal, shape, structures: RefCell::default() }
    }

    /// Limits of motions that do not depend on the unit of time: the longest flight is that in which the forcing, or without forcing the
    /// slowest mode with all stops open, turns by as many radians as the default one has units of time. Of free bodies they are the
    /// default ones.
    pub(crate) fn limits(&self) -> Limits {
        let limits = Limits::default();
        let rate = self.machine.parts().frequency.or_else(|| self.open().and_then(|open| open.slowest()));
        rate.map_or(limits, |rate| Limits { time: limits.time / rate, ..limits })
    }

    /// The structure with all stops open, and all joints sliding.
    pub(crate) fn open(&self) -> Option<Arc<Structure>> {
        let (stops, joints) = (self.machine.stops().len(), self.machine.joints().len());
        self.structure(&[vec![ContactState::Open; stops], vec![ContactState::Forward; joints]].concat())
    }

    /// The gap of a stop at a state, and its rate.
    pub(crate) fn gap(&self, place: &Place, stop: usize) -> (f64, f64) {
        let (gap, rate, ..) = place.gap(&self.normal, &place.turns(&self.normal), stop);
        (gap, rate)
    }

    /// The motion from a state.
    pub(crate) fn resume(&self, place: Place) -> Motion<'a> {
        Motion::resumed(self.machine, self.normal.clone(), self.structures.borrow().clone(), place)
    }

    /// Keeps the structures that a motion has built.
    pub(crate) fn keep(&self, motion: &Motion<'_>) {
        self.structures.borrow_mut().join(motion.structures());
    }

    /// Does something with the structures.
    pub(crate) fn with<T>(&self, of: impl FnOnce(&mut Structures) -> T) -> T {
        of(&mut self.structures.borrow_mut())
    }

    /// The structure with these states of stops and joints.
    pub(crate) fn structure(&self, states: &[ContactState]) -> Option<Arc<Structure>> {
        self.structures.borrow_mut().get(self.machine, &self.normal, states)
    }

    /// The state a time `s` later in the regime of `structure`.
    pub(crate) fn moved(&self, place: &Place, structure: &Arc<Structure>, s: f64) -> Place {
        self.moved_in(&place.unguarded_flight(&self.normal, structure.clone()), place, s)
    }

    /// The same, in the flight that begins at this state.
    pub(crate) fn moved_in(&self, flight: &MachineFlight, place: &Place, s: f64) -> Place {
        let mut moved = place.clone();
        let mut modes = Modes::default();
        flight.at(s, &mut modes);
        moved.move_along(flight, (&modes, s), self.machine.parts().frequency);
        moved
    }

    /// Moves a state onto the stops on which it rests, and gives joints that hold the velocity of their belt.
    pub(crate) fn constrain(&self, place: &mut Place) -> Option<()> {
        if !place.states.iter().any(|state| state.constrains()) {
            return Some(());
        }
        let structure = self.structure(&place.states)?;
        let turns = place.turns(&self.normal);
        let stops = self.machine.stops().len();
        // all gaps are read at the same state, before any of them is closed
        let (mut x, mut v) = (place.x.clone(), place.v.clone());
        for (held, across) in structure.held.iter().zip(&structure.across) {
            if *held < stops {
                let (gap, rate, ..) = place.gap(&self.normal, &turns, *held);
                add_scaled(&mut x, gap, across);
                add_scaled(&mut v, rate, across);
            } else {
                add_scaled(&mut v, -place.sliding(self.machine, &self.normal, held - stops).0, across);
            }
        }
        (place.x, place.v) = (x, v);
        Some(())
    }

    /// The largest sizes of coordinates and velocities. Of coordinates that can be translated the way counts that the
    /// velocity goes in a radian of the forcing, because their own size depends on how far they have come.
    pub(crate) fn sizes(&self, place: &Place) -> (f64, f64) {
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let free = &self.normal.translations;
        let speed = largest(&place.v);
        if free.is_empty() {
            return (largest(&place.x), speed);
        }
        let mut x = place.x.clone();
        free.remove(&mut x);
        // the way in a radian of the forcing
        (largest(&x).max(self.machine.parts().frequency.map_or(0.0, |frequency| speed / frequency)), speed)
    }

    /// The distance of two states, but for a translation.
    pub(crate) fn distance(&self, a: &Place, b: &Place, sizes: (f64, f64)) -> f64 {
        distance(&self.normal.translations, (a, b), sizes)
    }

    /// The components of a state less those of another, but for a translation.
    pub(crate) fn apart(&self, a: &Place, b: &Place) -> Vec<f64> {
        let mut apart: Vec<f64> = self.shape.values(a).iter().zip(self.shape.values(b)).map(|(a, b)| a - b).collect();
        self.normal.translations.remove(&mut apart);
        apart
    }

    /// The rounding error of a derivative of states by states over so many steps, in units of the sizes of coordinates and
    /// velocities. Without some directions it has other coordinates, and is taken as it is.
    pub(crate) fn rounding(&self, derivative: &Matrix, steps: usize, (size, speed): (f64, f64)) -> f64 {
        let (n, complete) = (self.shape.n, derivative.rows() == self.shape.size());
        // in units of the sizes, so that displacements and velocities can be added up
        let unit = |i: usize| if complete && (n..2 * n).contains(&i) { speed / size } else { 1.0 };
        let mut sum = 0.0;
        for i in 0..derivative.rows() {
            for j in 0..derivative.rows() {
                let share = derivative[(i, j)] * unit(j) / unit(i);
                if share.is_finite() {
                    sum += share * share;
                }
            }
        }
        rounding(steps, sum.sqrt())
    }

    /// Moves a state by a translation, so that it has no part along one.
    pub(crate) fn centre(&self, place: &mut Place) {
        self.normal.translations.remove(&mut place.x);
    }

    /// A derivative of states by states from which translations are removed before and after: it has as many rows less.
    pub(crate) fn without_translations(&self, derivative: Matrix) -> Matrix {
        let free = &self.normal.translations;
        if free.is_empty() {
            return derivative;
        }
        let others = free.others(self.shape.size());
        others.transposed().times(&derivative.times(&others))
    }

    /// A derivative of states by states of which translations are no part, as many rows and columns as before.
    pub(crate) fn within_shapes(&self, derivative: Matrix) -> Matrix {
        let free = &self.normal.translations;
        if free.is_empty() {
            return derivative;
        }
        let others = free.others(self.shape.size());
        others.times(&self.without_translations(derivative).times(&others.transposed()))
    }

    /// Whether motions have no phase: then each is a motion again at any later time.
    pub(crate) const fn unforced(&self) -> bool {
        self.machine.parts().frequency.is_none()
    }

    /// Whether nothing drives the machine: no forcing, no belt that moves, and no constant force along a free translation.
    pub(crate) fn gains_no_energy(&self) -> bool {
        self.unforced()
            && self.normal.translations.is_empty()
            && self.machine.joints().iter().all(|joint| joint.belt == 0.0)
    }

    /// The lengths of differences of states.
    pub(crate) fn metric(&self) -> Metric {
        let fastest = self.open().map_or(0.0, |open| open.fastest());
        Metric::of(&self.shape, self.machine, &self.normal, fastest)
    }

    /// The time of so many forcing periods; without forcing the time `otherwise`.
    pub(crate) fn time(&self, periods: u32, otherwise: f64) -> f64 {
        self.machine.period().map_or(otherwise, |period| period * f64::from(periods))
    }

    /// The rate of a state, but for a translation; `None` if its regime has no structure.
    pub(crate) fn flow(&self, place: &Place) -> Option<Vec<f64>> {
        let structure = self.structure(&place.states)?;
        let mut flow = self.shape.flow(&structure, &self.normal, place);
        self.normal.translations.remove(&mut flow);
        Some(flow)
    }

    /// The derivative of the state of a cycle over its period, for differences that are neither translations nor, without
    /// forcing, along the motion: those say nothing of it.
    pub(crate) fn across_cycles(&self, derivative: Matrix, at: &Place) -> Matrix {
        let reduced = self.without_translations(derivative);
        // with forcing the phase tells the states along a motion apart, and nothing is divided out
        let Some(flow) = self.unforced().then(|| self.flow(at)).flatten() else { return reduced };
        let free = &self.normal.translations;
        let flow = if free.is_empty() { flow } else { free.others(self.shape.size()).transposed().apply(&flow) };
        // the eigenvalue of the direction of the flow is 1, so the others are those of the quotient by it
        let Some(across) = complement(&flow) else { return reduced };
        across.transposed().times(&reduced.times(&across))
    }

    /// The same with as many rows and columns as before, where those differences are 0.
    pub(crate) fn within_cycles(&self, derivative: Matrix, at: &Place) -> Matrix {
        let within = self.within_shapes(derivative);
        let flow = self.unforced().then(|| self.flow(at)).flatten();
        let Some(across) = flow.and_then(|flow| complement(&flow)) else { return within };
        let reduced = across.transposed().times(&within.times(&across));
        across.times(&reduced.times(&across.transposed()))
    }

    /// The number of multipliers of a cycle: two for each coordinate, less one for each translation, and one less without
    /// forcing.
    pub(crate) const fn multipliers(&self) -> usize {
        2 * self.shape.n - self.normal.translations.count() - if self.unforced() { 1 } else { 0 }
    }
}

/// Orthonormal directions that are perpendicular to a vector, as columns: those of a reflection that takes the vector to
/// its largest component. `None` for a vector of zeros.
fn complement(vector: &[f64]) -> Option<Matrix> {
    let size = vector.len();
    let length = dot(vector, vector).sqrt();
    let pivot = (0..size).max_by(|i, j| vector[*i].abs().total_cmp(&vector[*j].abs()))?;
    if length == 0.0 || !length.is_finite() {
        return None;
    }
    let mut normal: Vec<f64> = vector.iter().map(|x| x / length).collect();
    // the sign for which nothing cancels
    normal[pivot] += normal[pivot].signum();
    let half = 0.5 * dot(&normal, &normal);
    let mut columns = Matrix::zeros(size, size - 1);
    // the reflection takes the pivot's direction to the vector itself: the other columns are perpendicular to it
    for (k, j) in (0..size).filter(|j| *j != pivot).enumerate() {
        for i in 0..size {
            let unit = if i == j { 1.0 } else { 0.0 };
            columns[(i, k)] = unit - normal[i] * normal[j] / half;
        }
    }
    Some(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_across_a_vector() {
        for vector in [vec![3.0, -4.0], vec![1e-9, 2.0, -1e3, 5.0], vec![0.0, 0.0, -1.0]] {
            let across = complement(&vector).unwrap();
            let (products, along) = (across.transposed().times(&across), across.transposed().apply(&vector));
            for i in 0..vector.len() - 1 {
                assert!(along[i].abs() < 1e-12 * dot(&vector, &vector).sqrt());
                for j in 0..vector.len() - 1 {
                    let unit = if i == j { 1.0 } else { 0.0 };
                    assert!((products[(i, j)] - unit).abs() < 1e-14);
                }
            }
        }
        assert!(complement(&[0.0, 0.0]).is_none());
    }
}
