//! A label on the page: runs of markup as SVG text.
//!
//! Sub- and superscripts are shifted with `dy`, because some browsers do not support `baseline-shift`.

use crate::colour::Colour;
use crate::markup::{Level, SCRIPT, escape, parse};
use crate::number::N;
use serde::Serialize;

/// Shift of a script, relative to the size of the surrounding text (positive is down).
const SHIFT_DOWN: f64 = 0.20;
const SHIFT_UP: f64 = -0.36;

/// The position of the reference point of a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Anchor {
    /// At its left end.
    #[default]
    Start,
    /// In its middle.
    Middle,
    /// At its right end.
    End,
}

/// A label placed on the page.
pub(crate) struct Placed<'a> {
    pub(crate) markup: &'a str,
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    pub(crate) colour: Colour,
    /// Whether it is rotated by 90 degrees to the left about its reference point.
    pub(crate) upright: bool,
    /// Width of a white outline, or 0.
    pub(crate) halo: f64,
}

impl<'a> Placed<'a> {
    pub(crate) fn new(markup: &'a str, x: f64, y: f64, size: f64) -> Self {
        Self { markup, x, y, size, anchor: Anchor::Start, colour: Colour::BLACK, upright: false, halo: 0.0 }
    }

    pub(crate) fn anchor(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The SVG text; `y` is the baseline.
    pub(crate) fn svg(&self) -> String {
        let spans = spans(self.markup, self.size);
        if spans.is_empty() {
            return String::new();
        }
        let anchor = match self.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let (x, y) = (N(self.x), N(self.y));
        let turn = if self.upright { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
        let head =
            format!("<text x=\"{x}\" y=\"{y}\" font-size=\"{}\"{anchor}{turn} xml:space=\"preserve\"", N(self.size));
        let mut out = String::new();
        if self.halo > 0.0 {
            // the outline is a separate text: drawn with each run, it would cover the run to its left
            out.push_str(&format!(
                "{head} fill=\"#ffffff\" stroke=\"#ffffff\" stroke-width=\"{}\" stroke-linejoin=\"round\">{spans}</text>\n",
                N(2.0 * self.halo)
            ));
        }
        out.push_str(&format!("{head}{}>{spans}</text>\n", self.colour.paint("fill")));
        out
    }
}

fn spans(markup: &str, size: f64) -> String {
    let mut out = String::new();
    let mut shift = 0.0;
    for run in parse(markup) {
        let (wanted, script) = match run.level {
            Level::Base => (0.0, false),
            Level::Sub => (SHIFT_DOWN * size, true),
            Level::Sup => (SHIFT_UP * size, true),
        };
        let mut attributes = String::new();
        if run.italic {
            attributes.push_str(" font-style=\"italic\"");
        }
        if run.bold {
            attributes.push_str(" font-weight=\"bold\"");
        }
        if script {
            attributes.push_str(&format!(" font-size=\"{}\"", N(size * SCRIPT)));
        }
        if wanted != shift {
            attributes.push_str(&format!(" dy=\"{}\"", N(wanted - shift)));
            shift = wanted;
        }
        let text = escape(&run.text);
        if attributes.is_empty() {
            out.push_str(&text);
        } else {
            out.push_str(&format!("<tspan{attributes}>{text}</tspan>"));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn baseline_returns_after_a_script() {
        let svg = Placed::new("a_0b", 0.0, 0.0, 10.0).svg();
        assert!(svg.contains("dy=\"2\"") && svg.contains("dy=\"-2\""), "{svg}");
    }

    #[test]
    fn labels_cannot_open_elements() {
        let svg = Placed::new("<script>", 0.0, 0.0, 20.0).svg();
        assert!(svg.contains("&lt;script&gt;") && !svg.contains("<script>"));
        assert_eq!(Placed::new("", 0.0, 0.0, 20.0).svg(), "");
    }
}
