//! Horizontal and vertical lines across a panel, and the stop that the mass hits.

use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::hatch::{Hatch, Pattern};
use crate::mark::extent::Extent;
use crate::number::N;
use crate::stroke::Stroke;
use serde::Serialize;

/// A horizontal line across the panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HLine {
    /// Its ordinate.
    pub y: f64,
    /// Its stroke.
    pub stroke: Stroke,
}

/// A vertical line across the panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct VLine {
    /// Its abscissa.
    pub x: f64,
    /// Its stroke.
    pub stroke: Stroke,
}

/// The side of the line on which the wall of a stop is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TextSide {
    /// At larger y.
    Above,
    /// At smaller y.
    Below,
    /// At smaller x.
    Left,
    /// At larger x.
    Right,
}

/// A stop: a line, with the area behind it hatched to the edge of the panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Wall {
    /// The coordinate of the stop.
    pub at: f64,
    /// The side of the wall.
    pub side: TextSide,
    /// Colour of the line and the hatch.
    pub colour: Colour,
}

impl HLine {
    /// A horizontal line at `y`.
    #[must_use]
    pub const fn new(y: f64, stroke: Stroke) -> Self {
        Self { y, stroke }
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        rule(canvas, frame, frame.y.at(self.y), true, self.stroke);
    }

    pub(crate) fn extent(&self, _: &mut Extent, y: &mut Extent) {
        y.see(self.y);
    }
}

impl VLine {
    /// A vertical line at `x`.
    #[must_use]
    pub const fn new(x: f64, stroke: Stroke) -> Self {
        Self { x, stroke }
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        rule(canvas, frame, frame.x.at(self.x), false, self.stroke);
    }

    pub(crate) fn extent(&self, x: &mut Extent, _: &mut Extent) {
        x.see(self.x);
    }
}

fn rule(canvas: &mut Canvas, frame: &Frame, at: f64, level: bool, stroke: Stroke) {
    let inside = if level { frame.holds((frame.left, at)) } else { frame.holds((at, frame.top)) };
    if inside {
        let d = if level {
            format!("M{} {}H{}", N(frame.left), N(at), N(frame.right()))
        } else {
            format!("M{} {}V{}", N(at), N(frame.top), N(frame.bottom()))
        };
        canvas.push(&format!("<path d=\"{d}\" fill=\"none\"{}/>\n", stroke.attributes()));
    }
}

impl Wall {
    /// A grey wall.
    #[must_use]
    pub const fn new(at: f64, side: TextSide) -> Self {
        Self { at, side, colour: Colour::GREY }
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        let upright = matches!(self.side, TextSide::Left | TextSide::Right);
        let mapping = if upright { &frame.x } else { &frame.y };
        if mapping.at(self.at).is_nan() {
            return;
        }
        let (first, last) = mapping.range;
        let beyond = match self.side {
            TextSide::Above | TextSide::Right => first.max(last),
            TextSide::Below | TextSide::Left => first.min(last),
        };
        // if the stop is outside the panel, either the whole panel is behind the wall or nothing
        let band = if matches!(self.side, TextSide::Above | TextSide::Right) == (self.at < beyond) {
            let (x, y) = if upright { ((self.at, beyond), frame.y.range) } else { (frame.x.range, (self.at, beyond)) };
            frame.cut(x, y)
        } else {
            None
        };
        if let Some([l, t, r, b]) = band {
            let hatch = canvas.hatch(Hatch::new(Pattern::Rising, self.colour));
            let tint = self.colour.alpha(0.12).paint("fill");
            let d = format!("M{} {}H{}V{}H{}z", N(l), N(t), N(r), N(b), N(l));
            canvas.push(&format!("<path d=\"{d}\"{tint}/><path d=\"{d}\" fill=\"{hatch}\"/>\n"));
        }
        rule(canvas, frame, mapping.at(self.at), !upright, Stroke::new(self.colour).width(3.0));
    }

    pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
        match self.side {
            TextSide::Left | TextSide::Right => x.see(self.at),
            TextSide::Above | TextSide::Below => y.see(self.at),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::test_frame;

    #[test]
    fn the_wall_fills_its_side() {
        let frame = test_frame((0.0, 1.0), (0.0, 1.0));
        for (wall, d) in [
            (Wall::new(0.75, TextSide::Above), "M0 0H100V25H0z"),
            (Wall::new(0.25, TextSide::Below), "M0 75H100V100H0z"),
            (Wall::new(0.75, TextSide::Right), "M75 0H100V100H75z"),
            (Wall::new(-5.0, TextSide::Right), "M0 0H100V100H0z"),
        ] {
            let mut canvas = Canvas::new("");
            wall.draw(&mut canvas, &frame);
            assert!(canvas.body.contains(d), "{wall:?}: {}", canvas.body);
        }
        let mut canvas = Canvas::new("");
        Wall::new(5.0, TextSide::Above).draw(&mut canvas, &frame);
        Wall::new(f64::NAN, TextSide::Left).draw(&mut canvas, &frame);
        HLine::new(7.0, Stroke::new(Colour::BLACK)).draw(&mut canvas, &frame);
        assert_eq!(canvas.body, "");
    }
}
