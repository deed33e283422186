//! A machine as a function of two numbers, and a frame in their plane.

use crate::continuation::curves::scales;
use crate::machine::{Machine, MachineError, MachineParts};
use core::fmt;
use core::ops::RangeInclusive;
use std::sync::Arc;

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
        scales(&self.ranges)
    }
}

impl fmt::Debug for MachinePlane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MachinePlane").field("ranges", &self.ranges).finish_non_exhaustive()
    }
}
