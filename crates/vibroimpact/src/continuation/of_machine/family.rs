//! A machine as a function of one number.

use crate::machine::{Machine, MachineError, MachineParts};
use core::fmt;
use std::sync::Arc;

/// A machine for each value of a number.
#[derive(Clone)]
pub struct MachineFamily(Arc<dyn Fn(f64) -> Option<Machine> + Send + Sync>);

impl MachineFamily {
    /// The machines that a function gives; `None` for values that are not allowed. The number of coordinates, of stops and
    /// of joints must not depend on the value.
    pub fn new(at: impl Fn(f64) -> Option<Machine> + Send + Sync + 'static) -> Self {
        Self(Arc::new(at))
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
        (self.0)(value)
    }

    /// The derivatives of the numbers of the machine at a value, for a number of this scale.
    pub(crate) fn rate(&self, value: f64, scale: f64) -> Option<MachineParts> {
        MachineParts::rate(&|value| self.at(value).map(|machine| machine.parts().clone()), (value, scale))
    }
}

impl fmt::Debug for MachineFamily {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("MachineFamily")
    }
}
