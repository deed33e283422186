//! Columns of quantities.

use crate::number::Number;

/// Numbers, each after a comma; empty where they are not defined or infinite.
pub(super) fn finite(values: &[f64]) -> String {
    let cell = |value: &f64| if value.is_finite() { format!(",{}", Number(*value)) } else { ",".to_owned() };
    values.iter().map(cell).collect()
}
