//! Linear and logarithmic axes.

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By decimal logarithm; values at or below zero are not shown.
    Log10,
}
