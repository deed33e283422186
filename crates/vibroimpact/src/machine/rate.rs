//! The derivatives of all numbers of a machine by another one.

use super::parts::{FrictionJoint, HarmonicForce, MachineParts, Stop, StopLaw};

/// The step of differences, relative to the scale of the number.
const STEP: f64 = 1e-3;

impl MachineParts {
    /// All numbers, always in the same order.
    pub(crate) fn each_number(&mut self, visit: &mut dyn FnMut(&mut f64)) {
        for matrix in [&mut self.mass, &mut self.damping, &mut self.stiffness] {
            for i in 0..matrix.rows() {
                matrix.row_mut(i).iter_mut().for_each(&mut *visit);
            }
        }
        self.constant.iter_mut().chain(&mut self.frequency).for_each(&mut *visit);
        for HarmonicForce { cos, sin, .. } in &mut self.forces {
            cos.iter_mut().chain(sin).for_each(&mut *visit);
        }
        for Stop { direction, gap, motion, law, .. } in &mut self.stops {
            direction.iter_mut().chain([gap]).for_each(&mut *visit);
            motion.iter_mut().for_each(|motion| [&mut motion.cos, &mut motion.sin].into_iter().for_each(&mut *visit));
            match law {
                StopLaw::Rigid { restitution } => visit(restitution),
                StopLaw::Compliant { stiffness, damping, preload, .. } => {
                    [stiffness, damping, preload].into_iter().for_each(&mut *visit);
                }
            }
        }
        for FrictionJoint { direction, sliding, limit, belt, .. } in &mut self.joints {
            direction.iter_mut().chain([sliding, limit, belt]).for_each(&mut *visit);
        }
    }

    /// The derivatives of all numbers of a machine by another number of this `scale`, at `value`; exact to rounding where they are
    /// linear in it.
    pub(crate) fn rate(at: &dyn Fn(f64) -> Option<Self>, (value, scale): (f64, f64)) -> Option<Self> {
        let mut rate = at(value)?;
        let numbers = |value: f64| {
            let mut all = Vec::new();
            at(value)?.each_number(&mut |number| all.push(*number));
            Some(all)
        };
        let mut slopes = derivative(&numbers, (value, scale))?.into_iter();
        rate.each_number(&mut |number| *number = slopes.next().unwrap_or(0.0));
        Some(rate)
    }
}

/// The derivative of several numbers at `value`, where another one varies on this `scale`: from differences of the fourth
/// order, whose own error is about 1e-12 of the largest terms. `None` if there are no numbers on either side.
fn derivative(at: &dyn Fn(f64) -> Option<Vec<f64>>, (value, scale): (f64, f64)) -> Option<Vec<f64>> {
    let mut h = STEP * scale.min(value.abs().max(0.1 * scale));
    for _ in 0..8 {
        let near = |k: f64| at(value + k * h);
        if let (Some(a), Some(b), Some(c), Some(d)) = (near(1.0), near(-1.0), near(2.0), near(-2.0)) {
            let slope = |i: usize| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
            return Some((0..a.len()).map(slope).collect());
        }
        // beside the end of the allowed numbers: one-sided differences of the second order
        for side in [1.0, -1.0] {
            if let (Some(a), Some(b), Some(c)) = (near(0.0), near(0.05 * side), near(0.1 * side)) {
                let slope = |i: usize| side * (4.0 * b[i] - 3.0 * a[i] - c[i]) / (0.1 * h);
                return Some((0..a.len()).map(slope).collect());
            }
        }
        h *= 0.1;
    }
    None
}
