//! Linear and logarithmic axes.

/// The distribution of values along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    #[default]
    Linear,
    /// By decimal logarithm; values at or below zero are not shown.
    Log10,
}
