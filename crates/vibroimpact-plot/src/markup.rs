//! The markup of labels, and their SVG text.
//!
//! | text | meaning |
//! |---|---|
//! | `*β*` | italic (oblique) |
//! | `**T**` | bold |
//! | `_0`, `_{max}` | subscript: one character, or a group |
//! | `^2`, `^{−3}` | superscript |
//! | `\*`, `\_` … | the character itself |
//!
//! Any text is accepted: an unclosed star or brace extends to the end.

use crate::metrics;

/// Size of sub- and superscripts relative to the text: 5 pt for text of 7 pt is still legible.
pub(crate) const SCRIPT: f64 = 0.72;

/// A run of text in one style.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) text: String,
    pub(crate) italic: bool,
    pub(crate) bold: bool,
    pub(crate) level: Level,
}

/// The vertical position of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    Base,
    Sub,
    Sup,
}

/// The text with every markup character escaped, so that it is printed unchanged.
#[must_use]
pub fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(c, '*' | '_' | '^' | '{' | '}' | '\\') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Splits a label into runs.
pub(crate) fn parse(markup: &str) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let (mut italic, mut bold, mut level, mut group) = (false, false, Level::Base, false);
    let mut chars = markup.chars().peekable();
    while let Some(c) = chars.next() {
        let c = match c {
            '\\' => chars.next().unwrap_or('\\'),
            '*' if chars.peek() == Some(&'*') => {
                chars.next();
                bold = !bold;
                continue;
            }
            '*' => {
                italic = !italic;
                continue;
            }
            '_' | '^' if level == Level::Base && chars.peek().is_some() => {
                level = if c == '_' { Level::Sub } else { Level::Sup };
                group = chars.next_if_eq(&'{').is_some();
                continue;
            }
            '}' if group => {
                (level, group) = (Level::Base, false);
                continue;
            }
            other => other,
        };
        match runs.last_mut() {
            Some(run) if (run.italic, run.bold, run.level) == (italic, bold, level) => {
                run.text.push(c);
            }
            _ => runs.push(Run { text: c.to_string(), italic, bold, level }),
        }
        if !group {
            level = Level::Base;
        }
    }
    runs
}

/// The label without its styles, for `<title>`.
pub(crate) fn strip(markup: &str) -> String {
    parse(markup).into_iter().map(|run| run.text).collect()
}

/// The width of a label in figure units at a font size.
pub(crate) fn width(markup: &str, size: f64) -> f64 {
    parse(markup)
        .iter()
        .map(|run| {
            let size = if run.level == Level::Base { size } else { size * SCRIPT };
            metrics::width(&run.text, run.italic, run.bold) * size
        })
        .sum()
}

/// Replaces the characters that XML reserves, and removes the control characters that it forbids.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\r' | '\t' => out.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(markup: &str) -> String {
        let mut out = String::new();
        for run in parse(markup) {
            out.push(match (run.italic, run.bold, run.level) {
                (true, _, _) => 'i',
                (_, true, _) => 'b',
                (_, _, Level::Sub) => '_',
                (_, _, Level::Sup) => '^',
                _ => ' ',
            });
            out.push_str(&run.text);
            out.push('|');
        }
        out
    }

    #[test]
    fn markup_table() {
        for (markup, want) in [
            ("1/*β*", " 1/|iβ|"),
            ("*ξ*_0", "iξ|_0|"),
            ("x_{max}^2y", " x|_max|^2| y|"),
            ("**N** *a*", "bN|  |ia|"),
            (r"a\*b\_c", " a*b_c|"),
            ("open *star", " open |istar|"),
            ("x_{open", " x|_open|"),
            ("tail_", " tail_|"),
            ("", ""),
        ] {
            assert_eq!(shape(markup), want, "{markup}");
        }
        assert_eq!(strip(&plain("a_b*c^{d}\\")), "a_b*c^{d}\\");
    }

    #[test]
    fn reserved_characters_are_escaped() {
        assert_eq!(escape("a<b & \"c\">'\u{7}\n"), "a&lt;b &amp; &quot;c&quot;&gt;&#39; ");
    }

    #[test]
    fn scripts_are_narrower() {
        assert!(width("a_{00}", 20.0) < width("a00", 20.0));
    }
}
