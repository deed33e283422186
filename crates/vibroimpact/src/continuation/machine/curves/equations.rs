//! The equations of a cycle of a machine with two of its numbers among the unknowns, and one condition.

use super::borders::Borders;
use super::condition::{Condition, turned};
use crate::continuation::curves::Ranges;
use crate::continuation::machine::branches::MachineEquations;
use crate::continuation::trace::equations::Equations;
use crate::machine::Machine;
use crate::orbit::{MachineFrame, MachineRing};

/// The equations of a curve. The unknowns are phases and states of the events and, last, the two numbers.
#[derive(Clone, Debug)]
pub(super) struct CurveEquations {
    pub(super) events: MachineEquations<2>,
    /// The ranges of both numbers.
    pub(super) ranges: Ranges,
    pub(super) condition: Condition,
}

/// Half the width of a difference, relative to the size of the unknown.
const DIFFERENCE: f64 = 1e-6;

impl CurveEquations {
    /// The same with the condition that a multiplier is `turn`, with borders at the cycle itself.
    pub(super) fn singular(mut self, machine: &Machine, turn: f64) -> Option<Self> {
        let matrix = turned(&MachineFrame::new(machine), &self.events.ring, turn)?;
        let columns = self.weights()[..matrix.rows()].iter().map(|weight| 1.0 / weight.sqrt()).collect();
        self.condition = Condition::Singular { turn, borders: Borders::new(&matrix, columns, None)? };
        Some(self)
    }

    /// The values of the two numbers.
    pub(super) fn values(w: &[f64]) -> (f64, f64) {
        MachineEquations::<2>::numbers(w).into()
    }

    /// The machine and the ring that belong to these unknowns; `None` if the numbers are not allowed.
    pub(super) fn split(&self, w: &[f64]) -> Option<(Machine, MachineRing)> {
        self.events.split(w)
    }

    /// The change of the two numbers along a tangent, divided by the scales.
    pub(super) fn course(&self, tangent: &[f64]) -> (f64, f64) {
        let ([one, two], (p, q)) = (self.events.scales, Self::values(tangent));
        (p / one, q / two)
    }

    /// The gradient of the function of the condition, by central differences of its terms; one-sided at the end of the allowed
    /// numbers.
    fn gradient(&self, frame: &MachineFrame<'_>, w: &[f64], ring: &MachineRing) -> Option<Vec<f64>> {
        let count = w.len() - 2;
        let terms = |moved: &[f64], i: usize| {
            // another state needs no other machine: only the two numbers do
            if i < count {
                self.condition.terms(frame, &self.events.ring.with(frame.machine, &moved[..count]))
            } else {
                let (machine, ring) = self.split(moved)?;
                self.condition.terms(&MachineFrame::new(&machine), &ring)
            }
        };
        let here = self.condition.terms(frame, ring)?;
        let by_terms = self.condition.by_terms(&here);
        let mut moved = w.to_vec();
        let mut row = vec![0.0; w.len()];
        let signature = &self.events.ring;
        let (events, width) = (self.condition.events(signature), count / signature.len());
        let matters = |i: usize| i >= count || events.as_ref().is_none_or(|events| events.contains(&(i / width)));
        for (i, slope) in row.iter_mut().enumerate().filter(|(i, _)| matters(*i)) {
            let h = DIFFERENCE / self.weights()[i].sqrt();
            let mut at = |x: f64| {
                moved[i] = x;
                let terms = terms(&moved, i);
                moved[i] = w[i];
                terms
            };
            let (up, down) = (at(w[i] + h), at(w[i] - h));
            // one-sided where a solution has no value on one side
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
        let length = self.weights().iter().zip(&vector).map(|(w, v)| w * v * v).sum::<f64>().sqrt();
        let at = |h: f64| {
            let moved: Vec<f64> = w.iter().zip(&vector).map(|(w, v)| w + h / length * v).collect();
            self.condition.value(&frame, &self.events.ring.with(&machine, &moved))
        };
        // along the direction in which the equations are singular
        Some((at(ALONG)? - at(-ALONG)?) / (2.0 * ALONG))
    }
}

/// Half the width of the difference along a null vector.
const ALONG: f64 = 1e-4;

impl Equations for CurveEquations {
    const SLOW: bool = true;

    fn weights(&self) -> &[f64] {
        self.events.weights()
    }

    fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let (machine, ring) = self.split(w)?;
        let frame = MachineFrame::new(&machine);
        let (mut miss, mut rows) = self.events.linearised(&frame, &ring, w)?;
        let last = (w.len() - 2) * w.len();
        rows[last..last + w.len()].copy_from_slice(&self.gradient(&frame, w, &ring)?);
        miss.push(self.condition.value(&frame, &ring)?);
        Some((miss, rows))
    }
    fn residuals(&self, w: &[f64]) -> Option<Vec<f64>> {
        let (machine, ring) = self.split(w)?;
        let frame = MachineFrame::new(&machine);
        let mut miss = self.events.misses(&frame, &ring, w)?;
        miss.push(self.condition.value(&frame, &ring)?);
        Some(miss)
    }
}
