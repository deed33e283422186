//! The equations of a cycle of a machine with two of its numbers among the unknowns, and one condition.

use super::borders::Borders;
use super::condition::{Condition, turned};
use super::plane::MachinePlane;
use crate::continuation::of_machine::{linearised, weigh, weights};
use crate::continuation::trace::equations::Equations;
use crate::events::StateShape;
use crate::machine::Machine;
use crate::orbit::{MachineFrame, MachineRing};

/// The equations of a curve. The unknowns are phases and states of the events and, last, the two numbers.
#[derive(Clone, Debug)]
pub(super) struct CurveEquations {
    pub(super) plane: MachinePlane,
    ring: MachineRing,
    weights: Vec<f64>,
    pub(super) condition: Condition,
}

/// Half the width of a difference, relative to the size of the unknown.
const DIFFERENCE: f64 = 1e-6;

impl CurveEquations {
    /// The equations for the signature of `ring`; `sizes` are the largest coordinates and velocities.
    pub(super) fn new(
        (machine, plane): (&Machine, MachinePlane),
        ring: MachineRing,
        sizes: (f64, f64),
        condition: Condition,
    ) -> Self {
        let mut weights = weights(machine, &ring, sizes);
        let scales = plane.scales();
        weights.extend([1.0 / (scales.0 * scales.0), 1.0 / (scales.1 * scales.1)]);
        Self { plane, ring, weights, condition }
    }

    /// The same with the condition that a multiplier is `turn`, with borders at the cycle itself.
    pub(super) fn singular(mut self, machine: &Machine, turn: f64) -> Option<Self> {
        let matrix = turned(&MachineFrame::new(machine), &self.ring, turn)?;
        let columns = self.sizes(matrix.rows());
        self.condition = Condition::Singular { turn, borders: Borders::new(&matrix, columns, None)? };
        Some(self)
    }

    /// Adapts the weights to a solution; whether they can have changed.
    pub(super) fn weigh(&mut self, w: &[f64]) -> bool {
        let count = self.weights.len() - 2;
        weigh(&mut self.weights[..count], &self.ring, w)
    }

    /// The sizes of the first unknowns.
    fn sizes(&self, count: usize) -> Vec<f64> {
        self.weights[..count].iter().map(|weight| 1.0 / weight.sqrt()).collect()
    }

    /// The values of the two numbers.
    pub(super) fn values(w: &[f64]) -> (f64, f64) {
        (w[w.len() - 2], w[w.len() - 1])
    }

    /// The vector of unknowns of a ring and two values.
    pub(super) fn join(machine: &Machine, ring: &MachineRing, (p, q): (f64, f64)) -> Vec<f64> {
        let mut w = ring.unknowns(&StateShape::of(machine));
        w.extend([p, q]);
        w
    }

    /// The machine and the ring that belong to these unknowns; `None` if the numbers are not allowed.
    pub(super) fn split(&self, w: &[f64]) -> Option<(Machine, MachineRing)> {
        let machine = self.plane.at(Self::values(w))?;
        let ring = self.ring.with(&machine, &w[..w.len() - 2]);
        Some((machine, ring))
    }

    /// The ring of the first unknowns.
    pub(super) fn ring(&self, machine: &Machine, unknowns: &[f64]) -> MachineRing {
        self.ring.with(machine, unknowns)
    }

    /// The signature, with the unknowns at which the curve begins.
    pub(super) const fn signature(&self) -> &MachineRing {
        &self.ring
    }

    /// The change of the two numbers along a tangent, divided by the scales.
    pub(super) fn course(&self, tangent: &[f64]) -> (f64, f64) {
        let (scales, (p, q)) = (self.plane.scales(), Self::values(tangent));
        (p / scales.0, q / scales.1)
    }

    /// The gradient of the function of the condition, by central differences of its terms; one-sided at the end of the allowed
    /// numbers.
    fn gradient(&self, frame: &MachineFrame<'_>, w: &[f64], ring: &MachineRing) -> Option<Vec<f64>> {
        let count = w.len() - 2;
        let terms = |moved: &[f64], i: usize| {
            if i < count {
                self.condition.terms(frame, &self.ring(frame.machine, &moved[..count]))
            } else {
                let (machine, ring) = self.split(moved)?;
                self.condition.terms(&MachineFrame::new(&machine), &ring)
            }
        };
        let here = self.condition.terms(frame, ring)?;
        let by_terms = self.condition.by_terms(&here);
        let mut moved = w.to_vec();
        let mut row = vec![0.0; w.len()];
        let (events, width) = (self.condition.events(&self.ring), count / self.ring.len());
        let matters = |i: usize| i >= count || events.as_ref().is_none_or(|events| events.contains(&(i / width)));
        for (i, slope) in row.iter_mut().enumerate().filter(|(i, _)| matters(*i)) {
            let h = DIFFERENCE / self.weights[i].sqrt();
            let mut at = |x: f64| {
                moved[i] = x;
                let terms = terms(&moved, i);
                moved[i] = w[i];
                terms
            };
            let (up, down) = (at(w[i] + h), at(w[i] - h));
            let width = h * f64::from(u8::from(up.is_some()) + u8::from(down.is_some()));
            let (up, down) = (up.as_ref().unwrap_or(&here), down.as_ref().unwrap_or(&here));
            (width > 0.0).then_some(())?;
            *slope = by_terms.iter().zip(up.iter().zip(down)).map(|(by, (up, down))| by * (up - down) / width).sum();
        }
        Some(row)
    }

    /// How fast the condition changes in the direction in which the equations of a fold are singular: zero at a cusp.
    pub(super) fn bending(&self, w: &[f64]) -> Option<f64> {
        let Condition::Singular { turn, borders } = &self.condition else { return None };
        let (machine, ring) = self.split(w)?;
        let frame = MachineFrame::new(&machine);
        let (_, vector) = borders.test(&turned(&frame, &ring, *turn)?)?;
        let length = self.weights.iter().zip(&vector).map(|(w, v)| w * v * v).sum::<f64>().sqrt();
        let at = |h: f64| {
            let moved: Vec<f64> = w.iter().zip(&vector).map(|(w, v)| w + h / length * v).collect();
            self.condition.value(&frame, &self.ring(&machine, &moved))
        };
        Some((at(ALONG)? - at(-ALONG)?) / (2.0 * ALONG))
    }
}

/// Half the width of the difference along a null vector.
const ALONG: f64 = 1e-4;

impl Equations for CurveEquations {
    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let (machine, ring) = self.split(w)?;
        let frame = MachineFrame::new(&machine);
        let (mut miss, mut rows) = linearised(&frame, &ring, w)?;
        let length = w.len();
        for (column, rate) in [length - 2, length - 1].into_iter().zip(self.plane.rates(Self::values(w))?) {
            for (row, slope) in ring.by_number(&frame, &rate)?.into_iter().enumerate() {
                rows[row * length + column] = slope;
            }
        }
        let here = self.condition.value(&frame, &ring)?;
        let last = (length - 2) * length;
        rows[last..last + length].copy_from_slice(&self.gradient(&frame, w, &ring)?);
        miss.push(here);
        Some((miss, rows))
    }
}
