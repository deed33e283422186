//! Writes the tables for JavaScript from those of the plots, and checks that the file is up to date.
//!
//! `VIBROIMPACT_WRITE_TABLES=1 cargo test -p vibroimpact-report --test tables` writes the file again.

#![allow(clippy::expect_used)]

use std::path::Path;
use vibroimpact_plot::{GROUP_RULES, GroupRule, SHADES};

const PAGE: &str = "../vibroimpact-web/page/tables.js";
const WRITTEN: &str = "Written by crates/vibroimpact-report/tests/tables.rs; do not edit.";

/// The rules of groups, one for each line.
fn rules() -> String {
    let range = |(from, to): (u64, u64)| {
        let to = if to == u64::MAX { "Infinity".to_owned() } else { to.to_string() };
        format!("[{from}, {to}]")
    };
    let rule =
        |rule: &GroupRule| format!("  [{}, {}, {}, \"{}\"],\n", range(rule.m), range(rule.n), rule.equal, rule.group);
    GROUP_RULES.iter().map(rule).collect()
}

/// The shades of groups, one group for each line.
fn shades() -> String {
    let line = |(group, colours): &(&str, [vibroimpact_plot::Colour; 4])| {
        let list = colours.map(|colour| format!("\"{}\"", colour.to_hex())).join(", ");
        format!("  \"{group}\": [{list}],\n")
    };
    SHADES.iter().map(line).collect()
}

/// The rules of groups and their shades in JavaScript.
fn page() -> String {
    format!(
        "/** The first row that holds for m/n names its group: m from and to, n from and to, whether m = n is asked. {WRITTEN} */\n\
         export const GROUP_RULES = [\n{}];\n\n\
         /** Further colours of groups: m/n has number (m + 2n) mod 5, where 0 is the colour of the group and infinitely many impacts count as 0. */\n\
         export const SHADES = {{\n{}}};\n",
        rules(),
        shades()
    )
}

#[test]
fn tables_of_other_languages_are_fresh() {
    let (path, text) = (Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE), page());
    if std::env::var_os("VIBROIMPACT_WRITE_TABLES").is_some() {
        std::fs::write(&path, &text).expect("the table can be written");
    }
    let there = std::fs::read_to_string(&path).expect("the table is checked in");
    assert_eq!(there, text, "VIBROIMPACT_WRITE_TABLES=1 writes {} anew", path.display());
}
