//! Hatches: a second distinction in addition to colour, for colour-blind readers and grey print.

use crate::colour::Colour;
use crate::number::N;
use serde::Serialize;

/// The lines of a hatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Rising to the right: `///`.
    Rising,
    /// Falling to the right: `\\\`.
    Falling,
    /// Both.
    Cross,
    /// Horizontal lines.
    Horizontal,
    /// Vertical lines.
    Vertical,
    /// Dots.
    Dots,
}

/// A hatch: lines in a colour, drawn over the fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct Hatch {
    /// The pattern of the lines.
    pub pattern: Pattern,
    /// The colour of the lines.
    pub colour: Colour,
}

/// Side of the repeated tile. Eight units are 1 mm in print: a patch in a legend has three lines, and a cell of a map
/// with 40 columns has one or two.
const TILE: f64 = 8.0;

impl Hatch {
    /// A hatch of these lines in this colour.
    #[must_use]
    pub const fn new(pattern: Pattern, colour: Colour) -> Self {
        Self { pattern, colour }
    }

    /// An id that is equal for equal hatches.
    pub(crate) fn id(self) -> String {
        let Colour { r, g, b, a } = self.colour;
        format!("hatch-{:?}-{r:02x}{g:02x}{b:02x}{a:02x}", self.pattern).to_lowercase()
    }

    /// The `<pattern>` for `<defs>`; `prefix` distinguishes the figures on a page.
    pub(crate) fn definition(self, prefix: &str) -> String {
        let (t, h) = (TILE, TILE / 2.0);
        // lines extend beyond the corners of the tile, so that they join their continuation
        let rising = format!("M-1 1L1 -1M0 {t}L{t} 0M{} {}L{} {}", N(t - 1.0), N(t + 1.0), N(t + 1.0), N(t - 1.0));
        let falling = format!("M{} -1L{} 1M0 0L{t} {t}M-1 {}L1 {}", N(t - 1.0), N(t + 1.0), N(t - 1.0), N(t + 1.0));
        let lines = match self.pattern {
            Pattern::Rising => rising,
            Pattern::Falling => falling,
            Pattern::Cross => rising + &falling,
            Pattern::Horizontal => format!("M0 {h}H{t}"),
            Pattern::Vertical => format!("M{h} 0V{t}"),
            Pattern::Dots => String::new(),
        };
        let ink = if lines.is_empty() {
            format!("<circle cx=\"{h}\" cy=\"{h}\" r=\"1.4\"{}/>", self.colour.paint("fill"))
        } else {
            format!("<path d=\"{lines}\" fill=\"none\" stroke-width=\"1.3\"{}/>", self.colour.paint("stroke"))
        };
        format!(
            "<pattern id=\"{prefix}{}\" width=\"{t}\" height=\"{t}\" patternUnits=\"userSpaceOnUse\">{ink}</pattern>\n",
            self.id()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_name_per_hatch() {
        let a = Hatch::new(Pattern::Cross, Colour::BLACK);
        let b = Hatch::new(Pattern::Cross, Colour::BLACK.alpha(0.5));
        assert_ne!(a.id(), b.id());
        assert!(a.definition("f-").contains("id=\"f-hatch-cross-000000ff\""));
    }
}
