//! A plane of two parameters, and a box in it.

use crate::continuation::equations::plane_equations::Condition;
use crate::system::Parameter;
use core::ops::RangeInclusive;

/// A plane of two parameters and the box in it that is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The parameters.
    pub parameters: (Parameter, Parameter),
    /// Their ranges.
    pub ranges: (RangeInclusive<f64>, RangeInclusive<f64>),
}

impl Frame {
    /// What a change of each parameter counts by: a quarter of its range.
    pub(crate) fn scales(&self) -> (f64, f64) {
        let quarter = |range: &RangeInclusive<f64>| 0.25 * (range.end() - range.start());
        (quarter(&self.ranges.0), quarter(&self.ranges.1))
    }

    /// Whether the ranges are finite and in order.
    pub(crate) fn sensible(&self) -> bool {
        let good = |r: &RangeInclusive<f64>| r.start().is_finite() && r.end().is_finite() && r.start() < r.end();
        good(&self.ranges.0) && good(&self.ranges.1)
    }

    /// Its edges, each positive inside.
    ///
    /// A distance from the edge of a small frame is measured in a unit of its size: what is below the rounding of a walk has no
    /// sign, and an edge whose distance never has one is never met.
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

    /// The same with each range shrunk by a share of it at either end.
    pub(crate) fn shrunk(&self, share: f64) -> Self {
        let shrink = |r: &RangeInclusive<f64>| {
            let by = share * (r.end() - r.start());
            r.start() + by..=r.end() - by
        };
        Self { parameters: self.parameters, ranges: (shrink(&self.ranges.0), shrink(&self.ranges.1)) }
    }

    /// Whether it holds a point.
    pub(crate) fn holds(&self, (p, q): (f64, f64)) -> bool {
        self.ranges.0.contains(&p) && self.ranges.1.contains(&q)
    }
}

/// A power of two, so that nothing is rounded: 1 for a scale that is not small, otherwise about its inverse.
fn unit(scale: f64) -> f64 {
    let mut unit = 1.0;
    while scale * unit < SMALL && unit < LARGEST {
        unit *= 2.0;
    }
    unit
}

/// Scales from here on are not small.
const SMALL: f64 = 1e-4;
/// Units stay below this, where no range leaves anything to tell apart.
const LARGEST: f64 = 1e200;
