//! Writes the tables for Python and JavaScript from those of the plots and figures, and checks that the files are up to date.
//!
//! `VIBROIMPACT_WRITE_TABLES=1 cargo test -p vibroimpact-report --test tables` writes the files again.

#![allow(clippy::expect_used)]

use std::path::Path;
use vibroimpact_plot::{GROUP_RULES, GROUPS, GroupRule, SERIES, SHADES, class_style, legend_text};

const PYTHON: &str = "../vibroimpact-py/python/vibroimpact/_tables.py";
const PAGE: &str = "../vibroimpact-web/page/tables.js";
const WRITTEN: &str = "Written by crates/vibroimpact-report/tests/tables.rs; do not edit.";

/// The rules of groups, one for each line, between the given brackets; `no_limit` is the text for no upper bound.
fn rules([open, close]: [char; 2], [no, yes]: [&str; 2], no_limit: &str) -> String {
    let range = |(from, to): (u64, u64)| {
        let to = if to == u64::MAX { no_limit.to_owned() } else { to.to_string() };
        format!("{open}{from}, {to}{close}")
    };
    let rule = |rule: &GroupRule| {
        let equal = if rule.equal { yes } else { no };
        format!("{open}{}, {}, {equal}, \"{}\"{close},\n", range(rule.m), range(rule.n), rule.group)
    };
    GROUP_RULES.iter().map(rule).collect()
}

/// The shades of groups, one group for each line.
fn shades(indent: &str, [open, close]: [char; 2]) -> String {
    let list = |colours: &[vibroimpact_plot::Colour]| {
        colours.iter().map(|colour| format!("\"{}\"", colour.to_hex())).collect::<Vec<_>>().join(", ")
    };
    let line = |(group, colours): &(&str, [_; 4])| {
        format!("{indent}\"{group}\": {open}{}{close},\n", list(colours.as_slice()))
    };
    SHADES.iter().map(line).collect()
}

/// Converts markup of plots, such as `*m*` for an italic m, to mathtext of matplotlib.
fn mathtext(markup: &str) -> String {
    markup
        .split('*')
        .enumerate()
        .map(|(k, part)| if k % 2 == 1 { format!("${part}$") } else { part.to_owned() })
        .collect()
}

/// The colours of series and of the groups of motions with their texts and rules in Python.
fn python() -> String {
    let indented = |lines: String| lines.lines().map(|line| format!("    {line}\n")).collect::<String>();
    let series: String = SERIES.iter().map(|colour| format!("    \"{}\",\n", colour.to_hex())).collect();
    let group = |text: &dyn Fn(&str) -> String| {
        GROUPS.iter().map(|group| format!("    \"{group}\": \"{}\",\n", text(group))).collect::<String>()
    };
    let classes = group(&|group| class_style(group).colour.to_hex());
    let shades = shades("    ", ['(', ')']);
    let legend = group(&|group| mathtext(legend_text(group)));
    let rules = indented(rules(['(', ')'], ["False", "True"], "math.inf"));
    format!(
        "\"\"\"Colours of series, and groups of motions in the order of a legend.\n\n{WRITTEN}\n\"\"\"\n\nimport math\n\n\
         SERIES = (\n{series})\n\nCLASSES = {{\n{classes}}}\n\n\
         #: Further colours of groups: m/n has number (m + 2n) mod 5, where 0 is the colour of the group and infinitely many impacts count as 0.\n\
         SHADES = {{\n{shades}}}\n\n\
         #: The words of a legend.\nLEGEND = {{\n{legend}}}\n\n\
         #: The first row that holds for m/n names its group: m from and to, n from and to, whether m = n is asked.\n\
         GROUP_RULES = (\n{rules})\n"
    )
}

/// The rules of groups and their shades in JavaScript.
fn page() -> String {
    let rules: String =
        rules(['[', ']'], ["false", "true"], "Infinity").lines().map(|line| format!("  {line}\n")).collect();
    format!(
        "/** The first row that holds for m/n names its group: m from and to, n from and to, whether m = n is asked. {WRITTEN} */\n\
         export const GROUP_RULES = [\n{rules}];\n\n\
         /** Further colours of groups: m/n has number (m + 2n) mod 5, where 0 is the colour of the group and infinitely many impacts count as 0. */\n\
         export const SHADES = {{\n{}}};\n",
        shades("  ", ['[', ']'])
    )
}

#[test]
fn tables_of_other_languages_are_fresh() {
    for (path, text) in [(PYTHON, python()), (PAGE, page())] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        if std::env::var_os("VIBROIMPACT_WRITE_TABLES").is_some() {
            std::fs::write(&path, &text).expect("the table can be written");
        }
        let there = std::fs::read_to_string(&path).expect("the table is checked in");
        assert_eq!(there, text, "VIBROIMPACT_WRITE_TABLES=1 writes {} anew", path.display());
    }
}
