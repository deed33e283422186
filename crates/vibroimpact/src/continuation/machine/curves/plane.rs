//! A machine as a function of two numbers, and a frame in their plane.

use crate::continuation::curves::{Ranges, scales};
use crate::continuation::machine::branches::Family;
use crate::machine::{Machine, MachineError};
use core::ops::RangeInclusive;

/// A machine for each point of a plane of two numbers, and a rectangular frame in this plane.
#[derive(Clone, Debug)]
pub struct Plane {
    pub(crate) family: Family<2>,
    /// The ranges of both numbers.
    pub ranges: (RangeInclusive<f64>, RangeInclusive<f64>),
}

impl Plane {
    /// The machines that a function gives; `None` for values that are not allowed. The number of coordinates, of stops and
    /// of joints must not depend on the values.
    pub fn new(at: impl Fn(f64, f64) -> Option<Machine> + Send + Sync + 'static, ranges: Ranges) -> Self {
        Self { family: Family::of(move |[p, q]| at(p, q)), ranges }
    }

    /// The machines with other numbers at two paths.
    ///
    /// # Errors
    /// [`MachineError`] if a path leads to no number.
    pub fn of_paths(machine: &Machine, (one, two): (&str, &str), ranges: Ranges) -> Result<Self, MachineError> {
        let paths = vec![one.to_owned(), two.to_owned()];
        Ok(Self { family: Family::of_paths(machine, paths, |values| values.to_vec())?, ranges })
    }

    /// The machines of a family.
    #[must_use]
    pub const fn of(family: Family<2>, ranges: Ranges) -> Self {
        Self { family, ranges }
    }

    /// The change of each number that has length 1.
    pub(crate) fn scales(&self) -> [f64; 2] {
        scales(&self.ranges).into()
    }
}
