//! An axis of a grid over a machine: a number by its path, or a part of the start.

use crate::Span;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An axis of a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineAxis {
    /// The path of a number, or `q.COORDINATE`, `qdot.COORDINATE` or `phase` of the start.
    pub vary: String,
    /// Its values.
    pub over: Span,
}

impl MachineAxis {
    /// The values of all axes at point number `k` of their grid; the first axis varies fastest.
    #[must_use]
    pub fn at(axes: &[Self], mut k: u64) -> Vec<f64> {
        let mut values = Vec::with_capacity(axes.len());
        for axis in axes {
            let count = u64::from(axis.over.count());
            values.push(axis.over.at(u32::try_from(k % count).unwrap_or(0)));
            k /= count;
        }
        values
    }
}
