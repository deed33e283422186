//! Strokes: the colour, width and dashes of a line.

use crate::colour::Colour;
use crate::number::N;
use serde::Serialize;

/// The dashes of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Dash {
    /// A solid line.
    #[default]
    Solid,
    /// Long dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dash, dot, dash, dot.
    DashDot,
}

/// The style of a line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width in figure units (2.8 units are 1 pt at the nominal size).
    pub width: f64,
    /// Its dashes.
    pub dash: Dash,
}

impl Stroke {
    /// A solid line of 2.5 units (0.9 pt).
    #[must_use]
    pub const fn new(colour: Colour) -> Self {
        Self { colour, width: 2.5, dash: Dash::Solid }
    }

    /// Sets the width.
    #[must_use]
    pub fn width(self, width: f64) -> Self {
        Self { width, ..self }
    }

    /// Sets the dashes.
    #[must_use]
    pub fn dash(self, dash: Dash) -> Self {
        Self { dash, ..self }
    }

    /// The width, limited to positive and reasonable values.
    pub(crate) fn safe_width(self) -> f64 {
        if self.width.is_finite() { self.width.clamp(0.1, 100.0) } else { 1.0 }
    }

    /// SVG attributes.
    pub(crate) fn attributes(self) -> String {
        let width = self.safe_width();
        let parts: &[f64] = match self.dash {
            Dash::Solid => &[],
            Dash::Dashed => &[4.0, 2.4],
            // dots of length zero with round caps disappear in some renderers
            Dash::Dotted => &[1.0, 1.6],
            Dash::DashDot => &[4.5, 2.0, 1.0, 2.0],
        };
        let mut text = format!("{} stroke-width=\"{}\"", self.colour.paint("stroke"), N(width));
        if !parts.is_empty() {
            let parts: Vec<String> = parts.iter().map(|p| N(p * width).to_string()).collect();
            text.push_str(&format!(" stroke-dasharray=\"{}\"", parts.join(" ")));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_grow_with_the_width() {
        let s = Stroke::new(Colour::BLACK).width(2.0).dash(Dash::Dotted);
        assert_eq!(s.attributes(), " stroke=\"#000000\" stroke-width=\"2\" stroke-dasharray=\"2 3.2\"");
        assert!(s.width(f64::NAN).attributes().contains("stroke-width=\"1\""));
    }
}
