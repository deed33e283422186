//! Hatches: a second sign beside colour, for readers and printers without it.

use crate::colour::Colour;
use crate::number::N;

/// The lines of a hatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Pattern {
    /// Rising to the right: `///`.
    Rising,
    /// Falling to the right: `\\\`.
    Falling,
    /// Both.
    Cross,
    /// Level lines.
    Horizontal,
    /// Upright lines.
    Vertical,
    /// Dots.
    Dots,
}

/// A hatch: lines in a colour over whatever lies below.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hatch {
    /// Which lines.
    pub pattern: Pattern,
    /// In which colour.
    pub colour: Colour,
}

/// Side of the repeated tile. Eight units are 1 mm in print: three lines fit a legend patch, and
/// one or two a cell of a 40-column map.
const TILE: f64 = 8.0;

impl Hatch {
    /// A hatch of these lines in this colour.
    #[must_use]
    pub const fn new(pattern: Pattern, colour: Colour) -> Self {
        Self { pattern, colour }
    }

    /// A name that is the same for the same hatch.
    pub(crate) fn id(self) -> String {
        let Colour { r, g, b, a } = self.colour;
        format!("hatch-{:?}-{r:02x}{g:02x}{b:02x}{a:02x}", self.pattern).to_lowercase()
    }

    /// The `<pattern>` for `<defs>`; `prefix` keeps figures on one page apart.
    pub(crate) fn definition(self, prefix: &str) -> String {
        let (t, h) = (TILE, TILE / 2.0);
        // strokes overshoot the tile by a corner so that they meet their continuation
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
