//! The motions of a map as text.

use crate::report::stored::label_table;
use vibroimpact_report::json::map::{coexisting, counts};
use vibroimpact_study::{RegionMap, counted};

/// The number of points, and one row for each label.
pub(crate) fn text(found: &RegionMap) -> String {
    format!(
        "{}, {} each; several motions coexist at {} of them\n\n{}",
        counted(found.points.len() as u64, "point"),
        counted(found.plan.starts, "start"),
        coexisting(found),
        label_table(&counts(found))
    )
}
