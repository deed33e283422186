//! An axis of a grid over a machine: a number by its path, or a part of the start.

use crate::machine::MachineSource;
use crate::{Axis, PlanError};

/// One line of text that describes what varies.
pub(crate) fn long_name(vary: &str) -> String {
    match vary.split_once('.') {
        Some(("q", name)) => format!("coordinate {name} of the start"),
        Some(("qdot", name)) => format!("velocity of {name} at the start"),
        None if vary == "phase" => "phase of the forcing at the start".to_owned(),
        _ => format!("{vary} of the machine"),
    }
}

impl Axis<String> {
    /// The description of a machine with these values of numbers.
    ///
    /// # Errors
    /// [`PlanError::Machine`] for a number that the machine does not have.
    pub(crate) fn with_values<'a>(
        source: &MachineSource,
        values: impl IntoIterator<Item = (&'a Self, f64)>,
    ) -> Result<MachineSource, PlanError> {
        Ok(source.with_all(values.into_iter().map(|(axis, value)| (axis.vary.as_str(), value)))?)
    }

    /// The values of all axes at point number `k` of their grid; the first axis varies fastest.
    #[must_use]
    pub fn at(axes: &[Self], mut k: u64) -> Vec<f64> {
        let mut values = Vec::with_capacity(axes.len());
        for axis in axes {
            let count = axis.over.count() as u64;
            values.push(axis.over.at(usize::try_from(k % count).unwrap_or(0)));
            k /= count;
        }
        values
    }
}
