//! The tables that other languages need are written from those of this crate, and checked in.
//!
//! `VIBROIMPACT_WRITE_TABLES=1 cargo test -p vibroimpact-plot --test tables` writes them anew.

#![allow(clippy::expect_used)]

use std::path::Path;
use vibroimpact_plot::{GROUPS, SERIES, class_style};

const PYTHON: &str = "../vibroimpact-py/python/vibroimpact/_tables.py";

/// The colours of series and of the groups of motions, in Python.
fn python() -> String {
    let series: String = SERIES.iter().map(|colour| format!("    \"{}\",\n", colour.to_hex())).collect();
    let classes: String =
        GROUPS.iter().map(|group| format!("    \"{group}\": \"{}\",\n", class_style(group).colour.to_hex())).collect();
    format!(
        "\"\"\"Colours of series, and of the groups of motions in the order of a legend.\n\n\
         Written by crates/vibroimpact-plot/tests/tables.rs; do not edit.\n\"\"\"\n\n\
         SERIES = (\n{series})\n\nCLASSES = {{\n{classes}}}\n"
    )
}

#[test]
fn tables_of_other_languages_are_fresh() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PYTHON);
    if std::env::var_os("VIBROIMPACT_WRITE_TABLES").is_some() {
        std::fs::write(&path, python()).expect("the table can be written");
    }
    let there = std::fs::read_to_string(&path).expect("the table is checked in");
    assert_eq!(there, python(), "VIBROIMPACT_WRITE_TABLES=1 writes it anew");
}
