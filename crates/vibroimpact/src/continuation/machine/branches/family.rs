//! A machine as a function of numbers.

use crate::machine::{Machine, MachineError, MachineParts};
use core::fmt;
use std::sync::Arc;

/// A machine for each value of a number, or of N numbers.
#[derive(Clone)]
pub struct MachineFamily<const N: usize = 1>(Arc<dyn Fn([f64; N]) -> Option<Machine> + Send + Sync>);

impl MachineFamily {
    /// The machines that a function gives; `None` for values that are not allowed. The number of coordinates, of stops and
    /// of joints must not depend on the value.
    pub fn new(at: impl Fn(f64) -> Option<Machine> + Send + Sync + 'static) -> Self {
        Self::of(move |[value]| at(value))
    }

    /// The machines with another number at a path, and the number of `machine` there.
    ///
    /// # Errors
    /// [`MachineError`] if the path leads to no number.
    pub fn of_path(machine: &Machine, path: &str) -> Result<(Self, f64), MachineError> {
        let value = machine.number(path)?;
        let (machine, path) = (machine.clone(), path.to_owned());
        Ok((Self::new(move |value| machine.with(&path, value).ok()), value))
    }

    /// The machine for a value; `None` if the value is not allowed.
    #[must_use]
    pub fn at(&self, value: f64) -> Option<Machine> {
        self.machine([value])
    }
}

impl<const N: usize> MachineFamily<N> {
    /// The machines that a function of N numbers gives.
    pub(crate) fn of(machine: impl Fn([f64; N]) -> Option<Machine> + Send + Sync + 'static) -> Self {
        Self(Arc::new(machine))
    }

    /// The machine for values of the numbers; `None` if they are not allowed.
    pub(crate) fn machine(&self, values: [f64; N]) -> Option<Machine> {
        (self.0)(values)
    }

    /// The derivatives of all numbers of the machine by each of these, for numbers of these scales.
    pub(crate) fn rates(&self, values: [f64; N], scales: [f64; N]) -> Option<Vec<MachineParts>> {
        let by = |k: usize| {
            let at = |value: f64| {
                let mut values = values;
                values[k] = value;
                self.machine(values).map(|machine| machine.parts().clone())
            };
            MachineParts::rate(&at, (values[k], scales[k]))
        };
        (0..N).map(by).collect()
    }
}

impl<const N: usize> fmt::Debug for MachineFamily<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("MachineFamily")
    }
}
