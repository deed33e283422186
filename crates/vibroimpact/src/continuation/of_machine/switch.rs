//! The cycle of twice the period beside a flip.
//!
//! A little beyond a flip, on one of its sides, a cycle of twice the period lies at a distance of about the square root of
//! the change of the number, in the direction that one period multiplies by -1. It is found by Newton's method from there.

use super::family::MachineFamily;
use super::point::{MachineBranchEvent, MachinePoint};
use crate::math::{Lu, Matrix, dot};
use crate::orbit::{MachineCycle, MachineFrame, MachineLap};

/// Changes of the number, in units of the scale, at which the cycle is searched for.
const BESIDE: [f64; 4] = [1e-4, 1e-3, 1e-5, 5e-3];
/// Distances along the direction, in units of the square root of the change and of the size of the motion.
const ALONG: [f64; 4] = [1.0, 0.3, 3.0, 0.1];

impl MachinePoint {
    /// The cycle of twice the period that begins at this flip, with the value of the number at which it was found, on a
    /// branch over a range of four times `scale`; `None` if this is no flip, or none was found.
    #[must_use]
    pub fn doubled(&self, family: &MachineFamily, scale: f64) -> Option<(f64, MachineCycle)> {
        if self.event != Some(MachineBranchEvent::Flip) {
            return None;
        }
        let machine = family.at(self.value)?;
        let frame = MachineFrame::new(&machine);
        let begin = self.cycle.strobes.first()?;
        let periods = self.cycle.label.periods;
        let time = frame.time(periods, self.cycle.period);
        let turn = MachineLap::fly(&frame, begin, time)?.derivative?;
        let direction = towards(&turn)?;
        let values = frame.shape.values(begin);
        let size = self.cycle.sizes.0.max(self.cycle.sizes.1);
        for by in BESIDE {
            for side in [1.0, -1.0] {
                let value = self.value + side * by * scale;
                let Some(beside) = family.at(value) else { continue };
                let frame = MachineFrame::new(&beside);
                for along in ALONG {
                    let step = along * by.sqrt() * size;
                    let moved: Vec<f64> = values.iter().zip(&direction).map(|(x, d)| x + step * d).collect();
                    let guess = frame.shape.with_values(begin, &moved);
                    if let Some(cycle) = MachineCycle::lasting(&frame, &guess, (2 * periods, 2.0 * time)) {
                        return Some((value, cycle));
                    }
                }
            }
        }
        None
    }
}

/// The direction that a matrix multiplies by -1, of length 1, by inverse iteration.
fn towards(turn: &Matrix) -> Option<Vec<f64>> {
    let size = turn.rows();
    let mut shifted = turn.clone();
    for i in 0..size {
        // beside the eigenvalue, so that the matrix is not singular
        shifted[(i, i)] += 1.0 + 1e-9;
    }
    let lu = Lu::new(shifted.values().to_vec(), size)?;
    let mut vector: Vec<f64> = (0..size).map(|i| if i % 2 == 0 { 1.0 } else { 0.7 }).collect();
    for _ in 0..3 {
        lu.solve(&mut vector);
        let length = dot(&vector, &vector).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        vector.iter_mut().for_each(|x| *x /= length);
    }
    Some(vector)
}
