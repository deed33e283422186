//! A machine as a function of two numbers, and a frame in their plane.

use crate::machine::{Machine, MachineError, MachineParts};
use core::fmt;
use core::ops::RangeInclusive;
use std::sync::Arc;
use thiserror::Error;

/// Why a curve of a machine cannot begin.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MachineCurveError {
    /// A range is not two finite numbers in increasing order, or does not contain the value of the machine.
    #[error("the curve begins at {value}, which does not lie in the range from {low} to {high}")]
    OutOfRange {
        /// The value of the machine.
        value: f64,
        /// Lower end of the range.
        low: f64,
        /// Upper end of the range.
        high: f64,
    },
    /// The point has another event, or none.
    #[error(
        "what happens at this point begins no curve\nhint: curves go through folds, flips, torus bifurcations, grazing, loss of contact, corners, and where sticking or holding begins or ends at a limit"
    )]
    NotThere,
    /// Newton's method does not converge from the point, or more than one curve goes through it.
    #[error("no single curve goes through this point of the plane")]
    NoCurve,
}

type At = dyn Fn(f64, f64) -> Option<Machine> + Send + Sync;

/// A machine for each point of a plane of two numbers, and a rectangular frame in this plane.
#[derive(Clone)]
pub struct MachinePlane {
    at: Arc<At>,
    /// The ranges of both numbers.
    pub ranges: (RangeInclusive<f64>, RangeInclusive<f64>),
}

impl MachinePlane {
    /// The machines that a function gives; `None` for values that are not allowed. The number of coordinates, of stops and
    /// of joints must not depend on the values.
    pub fn new(
        at: impl Fn(f64, f64) -> Option<Machine> + Send + Sync + 'static,
        ranges: (RangeInclusive<f64>, RangeInclusive<f64>),
    ) -> Self {
        Self { at: Arc::new(at), ranges }
    }

    /// The machines with other numbers at two paths.
    ///
    /// # Errors
    /// [`MachineError`] if a path leads to no number.
    pub fn of_paths(
        machine: &Machine,
        (one, two): (&str, &str),
        ranges: (RangeInclusive<f64>, RangeInclusive<f64>),
    ) -> Result<Self, MachineError> {
        machine.number(one)?;
        machine.number(two)?;
        let (machine, one, two) = (machine.clone(), one.to_owned(), two.to_owned());
        Ok(Self::new(move |p, q| machine.with(&one, p).ok()?.with(&two, q).ok(), ranges))
    }

    /// The machine at a point; `None` if the values are not allowed.
    #[must_use]
    pub fn at(&self, (p, q): (f64, f64)) -> Option<Machine> {
        (self.at)(p, q)
    }

    /// The derivatives of the numbers of the machine at a point, by the first and by the second number.
    pub(super) fn rates(&self, (p, q): (f64, f64)) -> Option<[MachineParts; 2]> {
        let (scales, parts) = (self.scales(), |p, q| self.at((p, q)).map(|machine| machine.parts().clone()));
        let one = MachineParts::rate(&|p| parts(p, q), (p, scales.0))?;
        Some([one, MachineParts::rate(&|q| parts(p, q), (q, scales.1))?])
    }

    /// The change of each number that has length 1: a quarter of its range.
    pub(super) fn scales(&self) -> (f64, f64) {
        let quarter = |range: &RangeInclusive<f64>| 0.25 * (range.end() - range.start());
        (quarter(&self.ranges.0), quarter(&self.ranges.1))
    }

    /// Refuses ranges that are none, and a point outside.
    pub(super) fn check(&self, (p, q): (f64, f64)) -> Result<(), MachineCurveError> {
        for (range, value) in [(&self.ranges.0, p), (&self.ranges.1, q)] {
            let (low, high) = (*range.start(), *range.end());
            if !(low.is_finite() && high.is_finite() && low < high && range.contains(&value)) {
                return Err(MachineCurveError::OutOfRange { value, low, high });
            }
        }
        Ok(())
    }
}

impl fmt::Debug for MachinePlane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MachinePlane").field("ranges", &self.ranges).finish_non_exhaustive()
    }
}
