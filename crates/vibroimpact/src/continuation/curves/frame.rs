//! A plane of two parameters, and a frame in it.

use crate::continuation::branches::{BranchError, scale};
use crate::continuation::equations::plane_equations::Condition;
use crate::system::{Oscillator, ParameterPlane};
use core::ops::RangeInclusive;

/// The ranges of two numbers.
pub(crate) type Ranges = (RangeInclusive<f64>, RangeInclusive<f64>);

/// The change of each number that has length 1: a quarter of its range.
pub(crate) fn scales((p, q): &Ranges) -> (f64, f64) {
    let quarter = |range: &RangeInclusive<f64>| 0.25 * (range.end() - range.start());
    (quarter(p), quarter(q))
}

/// The point `(i, j)` of a grid over a frame with these ranges; no point lies on its edge.
pub(crate) fn node((p, q): &Ranges, (i, j): (u32, u32), (columns, rows): (u32, u32)) -> (f64, f64) {
    let at = |range: &RangeInclusive<f64>, k: u32, count: u32| {
        range.start() + (range.end() - range.start()) * (f64::from(k) + 0.5) / f64::from(count)
    };
    (at(p, i, columns), at(q, j, rows))
}

/// Refuses ranges that are not two finite numbers in increasing order, and a point outside.
pub(crate) fn check(ranges: &Ranges, (p, q): (f64, f64)) -> Result<(), BranchError> {
    scale(&ranges.0, p)?;
    scale(&ranges.1, q)?;
    Ok(())
}

/// A rectangular frame in a plane of two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The two parameters that vary.
    pub plane: ParameterPlane,
    /// Their ranges.
    pub ranges: (RangeInclusive<f64>, RangeInclusive<f64>),
}

impl Frame {
    /// The change of each parameter that has length 1.
    pub(crate) fn scales(&self) -> (f64, f64) {
        scales(&self.ranges)
    }

    /// Whether the ranges are finite and in order.
    pub(crate) fn sensible(&self) -> bool {
        let good = |r: &RangeInclusive<f64>| r.start().is_finite() && r.end().is_finite() && r.start() < r.end();
        good(&self.ranges.0) && good(&self.ranges.1)
    }

    /// Its edges, as functions that are positive inside.
    ///
    /// The distance from an edge of a small frame is measured in a unit of the size of the frame. Otherwise it would
    /// lie below the value at which a test function has no sign, and the edge would not be detected.
    pub(crate) fn edges(&self) -> [Condition; 4] {
        let ((p, q), scales) = (&self.ranges, self.scales());
        let (a, b) = (unit(scales.0), unit(scales.1));
        [
            Condition::Line(a, 0.0, a * p.start()),
            Condition::Line(-a, 0.0, -a * p.end()),
            Condition::Line(0.0, b, b * q.start()),
            Condition::Line(0.0, -b, -b * q.end()),
        ]
    }

    /// The frame with each range shortened at both ends by this fraction of it.
    pub(crate) fn shrunk(&self, share: f64) -> Self {
        let shrink = |r: &RangeInclusive<f64>| {
            let by = share * (r.end() - r.start());
            r.start() + by..=r.end() - by
        };
        Self { plane: self.plane.clone(), ranges: (shrink(&self.ranges.0), shrink(&self.ranges.1)) }
    }

    /// The point `(i, j)` of a grid over the frame; no point lies on its edge.
    pub(crate) fn node(&self, place: (u32, u32), grid: (u32, u32)) -> (f64, f64) {
        node(&self.ranges, place, grid)
    }

    /// Whether a condition holds wherever the plane has an oscillator, by some points inside the frame.
    #[must_use]
    pub fn everywhere(&self, osc: &Oscillator, holds: impl Fn(&Oscillator) -> bool) -> bool {
        let at = |k: u32| self.node((k % SAMPLES, k / SAMPLES), (SAMPLES, SAMPLES));
        (0..SAMPLES * SAMPLES).filter_map(|k| self.plane.set(osc, at(k)).ok()).all(|osc| holds(&osc))
    }
}

/// The points at which a condition is checked, along each side of the frame.
const SAMPLES: u32 = 3;

/// A power of two, so that multiplication by it is exact: 1 for a scale that is not small, otherwise the smallest with
/// which the product is not small.
fn unit(scale: f64) -> f64 {
    let mut unit = 1.0;
    while scale * unit < SMALL && unit < LARGEST {
        unit *= 2.0;
    }
    unit
}

/// Scales from this value on are not small.
const SMALL: f64 = 1e-4;
/// The largest unit; ranges for which it would be larger contain no distinct values.
const LARGEST: f64 = 1e200;
