//! The colours of motions and of series, and the groups of a legend.

use pyo3::prelude::*;
use vibroimpact_plot::{GROUPS, SERIES, class_style, legend_group, legend_text, unforced};

/// The colours of series, and the groups of motions with their words in the order of a legend.
#[pyfunction]
pub(crate) fn palette() -> (Vec<String>, Vec<(&'static str, &'static str)>) {
    let groups = GROUPS.map(|group| (group, legend_text(group)));
    (SERIES.iter().map(|colour| colour.to_hex()).collect(), groups.to_vec())
}

/// The group of the label of a motion in a legend, and its colour.
#[pyfunction]
pub(crate) fn look_of(label: &str) -> (&'static str, String) {
    // a machine without forcing has no motions m/n: those with m closings have the colours of (m+1)/1
    let group = unforced(label).map_or_else(|| legend_group(label), |m| legend_group(&format!("{}/1", m + 1)));
    (group, class_style(label).colour.to_hex())
}
