//! The derivatives of all numbers of a machine by another one.

use super::parts::{FrictionJoint, HarmonicForce, MachineParts, Stop, StopLaw};
use core::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

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
        let slopes = derivative(&|value| Some(at(value)?.all_numbers()), (value, scale))?;
        Some(at(value)?.with_numbers(slopes))
    }

    fn all_numbers(mut self) -> Vec<f64> {
        let mut all = Vec::new();
        self.each_number(&mut |number| all.push(*number));
        all
    }

    fn with_numbers(mut self, numbers: Vec<f64>) -> Self {
        let mut numbers = numbers.into_iter();
        self.each_number(&mut |number| *number = numbers.next().unwrap_or(0.0));
        self
    }
}

/// Machines at the nodes of a grid of values of a number: the exponent of the distance of its nodes, a power of two, and the count of
/// these from 0.
type Grid = HashMap<(i32, i64), Option<Arc<MachineParts>>>;

/// Derivatives of all numbers of a machine by another one, by interpolation between machines at the nodes of a grid. They serve
/// all values beside them, so that few machines are made along a branch. The nodes are always the same: which values were asked for before
/// changes nothing.
#[derive(Clone, Debug, Default)]
pub(crate) struct RateGrid(RefCell<Grid>);

/// Nodes on each side of a value.
const HALF: i64 = 4;
/// The largest distance of nodes, in parts of the size of the number, and by how much derivatives from all nodes and from those without
/// the outer ones may differ, relative to the numbers: if they differ by more, these vary too much for so few nodes. Polynomials, as most
/// numbers are, are right to rounding with distant nodes, which serve many values.
const GRIDS: [(f64, f64); 2] = [(0.1, 1e-13), (0.008, 1e-8)];
/// The largest number of machines that are kept.
const KEPT: usize = 64;
/// From this number of nodes between 0 and the value on, their values are not told apart well.
const FAR: f64 = 1e9;

impl RateGrid {
    /// The same as [`MachineParts::rate`].
    pub(crate) fn rate(
        &self,
        at: &dyn Fn(f64) -> Option<MachineParts>,
        (value, scale): (f64, f64),
    ) -> Option<MachineParts> {
        // nodes that are farther apart serve more values
        let sizes = [scale.max(value.abs()), scale.min(value.abs().max(0.1 * scale))];
        let found = |grid| sizes.into_iter().find_map(|size| self.interpolated(at, (value, size), grid));
        let found = GRIDS.into_iter().find_map(found);
        found.or_else(|| MachineParts::rate(at, (value, scale)))
    }

    /// The same where the number has this size; `None` where machines are not allowed at all nodes, or where they vary too much.
    fn interpolated(
        &self,
        at: &dyn Fn(f64) -> Option<MachineParts>,
        (value, size): (f64, f64),
        (distance, most): (f64, f64),
    ) -> Option<MachineParts> {
        // a power of two, so that the nodes are exact
        let exponent = libm::ilogb(distance * size);
        let width = libm::ldexp(1.0, exponent);
        let place = value / width;
        if !(size > 0.0 && place.abs() < FAR) {
            return None;
        }
        #[allow(clippy::cast_possible_truncation)] // below the limit
        let first = place.floor() as i64;
        let nodes: Vec<Arc<MachineParts>> =
            (1 - HALF..=HALF).map(|k| self.node(at, (exponent, first + k), width)).collect::<Option<_>>()?;
        let numbers: Vec<Vec<f64>> = nodes.iter().map(|node| node.as_ref().clone().all_numbers()).collect();
        let share = place - place.floor();
        let (all, inner) = (slopes(share, HALF), slopes(share, HALF - 1));
        let count = numbers.first()?.len();
        let rate = |i: usize| {
            // the weights add up to 0: of differences the rate of a number that does not change is exactly 0
            let of = |weights: &[f64], skipped: usize| -> f64 {
                let changes = numbers[skipped..].iter().map(|other| other[i] - numbers[0][i]);
                weights.iter().zip(changes).map(|(weight, change)| weight * change).sum::<f64>() / width
            };
            let (rate, other) = (of(&all, 0), of(&inner, 1));
            let alike = (rate - other).abs() <= most * (rate.abs() + numbers[0][i].abs() / size);
            alike.then_some(rate)
        };
        let rates: Vec<f64> = (0..count).map(rate).collect::<Option<_>>()?;
        Some(nodes[0].as_ref().clone().with_numbers(rates))
    }

    fn node(
        &self,
        at: &dyn Fn(f64) -> Option<MachineParts>,
        place: (i32, i64),
        width: f64,
    ) -> Option<Arc<MachineParts>> {
        let mut grid = self.0.borrow_mut();
        if grid.len() > KEPT {
            grid.clear();
        }
        #[allow(clippy::cast_precision_loss)] // below the limit
        let of = || at(place.1 as f64 * width).map(Arc::new);
        grid.entry(place).or_insert_with(of).clone()
    }
}

/// The weights of values at so many nodes on each side, at -2, -1, 0, 1, 2, 3 for three, in the derivative of their polynomial at `x`.
fn slopes(x: f64, half: i64) -> Vec<f64> {
    #[allow(clippy::cast_precision_loss)] // a few
    let nodes: Vec<f64> = (1 - half..=half).map(|k| k as f64).collect();
    let others = |k: usize| nodes.iter().enumerate().filter(move |(i, _)| *i != k);
    let weight = |k: usize| {
        let each = others(k).map(|(i, node)| {
            let rest = others(k).filter(|(j, _)| *j != i).map(|(_, other)| (x - other) / (nodes[k] - other));
            rest.product::<f64>() / (nodes[k] - node)
        });
        each.sum()
    };
    (0..nodes.len()).map(weight).collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    /// A machine of which some numbers are functions of one, and their derivatives.
    fn parts(stiffness: f64, damping: f64, gap: f64) -> MachineParts {
        MachineParts::new(["body"]).with_mass(0, 1.0).with_link(&[1.0], stiffness, damping).with_rigid_stop(
            "stop",
            &[1.0],
            gap,
            0.5,
        )
    }

    fn numbers(parts: &MachineParts) -> [f64; 3] {
        [parts.stiffness[(0, 0)], parts.damping[(0, 0)], parts.stops[0].gap]
    }

    /// Against derivatives in closed form, and how many machines that takes along a branch.
    #[test]
    fn few_machines_serve_all_values() {
        let made = Cell::new(0);
        let at = |x: f64| {
            made.set(made.get() + 1);
            Some(parts(1.0 / (1.0 + x), libm::sqrt(x), libm::sin(x)))
        };
        let grid = RateGrid::default();
        for k in 0..200 {
            let x = 0.5 + 1e-3 * f64::from(k);
            let found = grid.rate(&at, (x, 0.05)).unwrap();
            // a number that does not change has no rate, not even one of rounding: with none of the structure nothing is integrated
            assert_eq!((found.mass[(0, 0)], found.stops[0].direction[0]), (0.0, 0.0));
            let rates = numbers(&found);
            let exact = [-1.0 / ((1.0 + x) * (1.0 + x)), 0.5 / libm::sqrt(x), libm::cos(x)];
            for (rate, exact) in rates.iter().zip(exact) {
                assert!((rate - exact).abs() < 2e-12, "{x}: {rate} is not {exact}");
            }
            // nothing depends on what was asked for before
            assert_eq!(rates, numbers(&RateGrid::default().rate(&at, (x, 0.05)).unwrap()));
        }
        made.set(0);
        for k in 0..200 {
            grid.rate(&at, (0.5 + 1e-3 * f64::from(k), 0.05)).unwrap();
        }
        assert!(made.get() < 100, "{} machines", made.get());
    }

    /// Where a number bends, and beside the end of the allowed values.
    #[test]
    fn bends_and_ends() {
        let grid = RateGrid::default();
        let bent = |x: f64| Some(parts(1.0 + (x - 0.5).abs(), 0.0, 0.0));
        for (x, slope) in [(0.501, 1.0), (0.499, -1.0)] {
            let rates = numbers(&grid.rate(&bent, (x, 0.1)).unwrap());
            assert!((rates[0] - slope).abs() < 1e-9, "{x}: {rates:?}");
        }
        let grid = RateGrid::default();
        let ends = |x: f64| (x <= 0.5).then(|| parts(x * x, 0.0, 0.0));
        for x in [0.5, 0.4999] {
            let rates = numbers(&grid.rate(&ends, (x, 0.1)).unwrap());
            assert!((rates[0] - 2.0 * x).abs() < 1e-9, "{x}: {rates:?}");
        }
    }
}
