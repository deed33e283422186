//! Linear and logarithmic axes.

use serde::Serialize;

/// The distribution of values along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Linear.
    #[default]
    Linear,
    /// By decimal logarithm; values at or below zero are not shown.
    Log10,
}
