//! Labels at a point of the data.

use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::label::{Anchor, Placed};
use crate::mark::extent::Extent;
use crate::theme;
use serde::Serialize;

/// A label. It is shown if its point lies inside the axes, and is never clipped by them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Text {
    /// Abscissa of its point.
    pub x: f64,
    /// Ordinate of its point.
    pub y: f64,
    /// The text, in the markup of [labels](crate::plain).
    pub markup: String,
    /// The part of the text that is placed at the point.
    pub anchor: Anchor,
    /// Shift to the right, in figure units.
    pub dx: f64,
    /// Shift upwards, in figure units.
    pub dy: f64,
    /// Font size in figure units.
    pub size: f64,
    /// The colour.
    pub colour: Colour,
    /// Whether it has a white outline, so that it is legible over colours.
    pub halo: bool,
}

impl Text {
    /// A label centred at a point, with a white outline.
    pub fn new(x: f64, y: f64, markup: impl Into<String>) -> Self {
        Self {
            x,
            y,
            markup: markup.into(),
            anchor: Anchor::Middle,
            dx: 0.0,
            dy: 0.0,
            size: theme::MARK_TEXT,
            colour: Colour::BLACK,
            halo: true,
        }
    }

    /// Sets the shift to the right and upwards, in figure units.
    #[must_use]
    pub fn shift(self, dx: f64, dy: f64) -> Self {
        Self { dx, dy, ..self }
    }

    /// Sets the anchor.
    #[must_use]
    pub fn anchor(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// Sets the font size.
    #[must_use]
    pub fn size(self, size: f64) -> Self {
        Self { size, ..self }
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        let place = frame.at(self.x, self.y);
        if !frame.holds(place) {
            return;
        }
        let size = if self.size.is_finite() { self.size.clamp(1.0, 400.0) } else { theme::MARK_TEXT };
        let (x, y) = (place.0 + self.dx, place.1 - self.dy);
        // capitals are 0.73 high, so this baseline centres them
        let baseline = y + 0.365 * size;
        let placed = Placed {
            colour: self.colour,
            halo: if self.halo { 0.16 * size } else { 0.0 },
            ..Placed::new(&self.markup, x, baseline, size).anchor(self.anchor)
        };
        canvas.push(&placed.svg());
    }

    pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
        x.see(self.x);
        y.see(self.y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::test_frame;

    #[test]
    fn labels_outside_are_not_shown() {
        let frame = test_frame((0.0, 1.0), (0.0, 1.0));
        let mut canvas = Canvas::new("");
        Text::new(2.0, 0.5, "out").draw(&mut canvas, &frame);
        Text::new(f64::NAN, 0.5, "nowhere").draw(&mut canvas, &frame);
        assert_eq!(canvas.body, "");
        Text::new(0.5, 0.5, "in").draw(&mut canvas, &frame);
        assert_eq!(canvas.body.matches("<text").count(), 2, "halo and text");
    }
}
