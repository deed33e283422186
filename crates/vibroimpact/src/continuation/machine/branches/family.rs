//! A machine as a function of numbers.

use crate::machine::{Machine, MachineError, MachineParts, RateGrid, Reduction, VariedReduction};
use core::fmt;
use std::sync::Arc;

/// A function of N numbers, which need not be allowed.
type Function<const N: usize, T> = Arc<dyn Fn([f64; N]) -> Option<T> + Send + Sync>;

/// A machine for each value of a number, or of N numbers.
#[derive(Clone)]
pub struct Family<const N: usize = 1> {
    machine: Function<N, Machine>,
    /// The oscillators that the machines are, where they need no machines.
    reduction: Option<Function<N, Reduction>>,
}

impl Family {
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
        Ok((Self::of_paths(machine, vec![path.to_owned()], |[value]| vec![value])?, value))
    }

    /// The machine for a value; `None` if the value is not allowed.
    #[must_use]
    pub fn at(&self, value: f64) -> Option<Machine> {
        self.machine([value])
    }
}

impl<const N: usize> Family<N> {
    /// The machines that a function of N numbers gives.
    pub fn of(machine: impl Fn([f64; N]) -> Option<Machine> + Send + Sync + 'static) -> Self {
        Self { machine: Arc::new(machine), reduction: None }
    }

    /// The machines with other numbers at some paths, which are a function of the N numbers.
    ///
    /// # Errors
    /// [`MachineError`] if a path leads to no number.
    pub fn of_paths(
        machine: &Machine,
        paths: Vec<String>,
        values: impl Fn([f64; N]) -> Vec<f64> + Send + Sync + 'static,
    ) -> Result<Self, MachineError> {
        paths.iter().try_for_each(|path| machine.number(path).map(drop))?;
        let values = Arc::new(values);
        let varied = VariedReduction::new(machine, &paths);
        let of = values.clone();
        let reduction: Option<Function<N, Reduction>> = match varied {
            Some(varied) => Some(Arc::new(move |numbers| varied.at(&of(numbers)))),
            None => None,
        };
        let parts = machine.parts().clone();
        let machine = move |numbers| {
            let mut parts = parts.clone();
            paths.iter().zip(values(numbers)).try_for_each(|(path, value)| parts.set(path, value)).ok()?;
            Machine::new(parts).ok()
        };
        Ok(Self { machine: Arc::new(machine), reduction })
    }

    /// The oscillator that the machine for values of the numbers is; `None` if it is none.
    pub(crate) fn reduction(&self, values: [f64; N]) -> Option<Reduction> {
        match &self.reduction {
            Some(reduction) => reduction(values),
            None => self.machine(values)?.reduced(),
        }
    }

    /// The machine for values of the numbers; `None` if they are not allowed.
    pub(crate) fn machine(&self, values: [f64; N]) -> Option<Machine> {
        (self.machine)(values)
    }

    /// The derivatives of all numbers of the machine by each of these, for numbers of these scales; `grid` belongs to this family.
    pub(crate) fn rates(&self, values: [f64; N], scales: [f64; N], grid: &RateGrid) -> Option<Vec<MachineParts>> {
        let by = |k: usize| {
            let at = |value: f64| {
                let mut values = values;
                values[k] = value;
                self.machine(values).map(|machine| machine.parts().clone())
            };
            let number = (values[k], scales[k]);
            // with each value of the others a grid would be another one
            if N == 1 { grid.rate(&at, number) } else { MachineParts::rate(&at, number) }
        };
        (0..N).map(by).collect()
    }
}

impl<const N: usize> fmt::Debug for Family<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Family")
    }
}
