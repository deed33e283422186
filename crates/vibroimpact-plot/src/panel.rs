//! A panel: two axes, a caption, and marks between them.

use crate::axis::{FigureAxis, Mapping};
use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::mark::Mark;
use crate::mark::extent::Extent;
use crate::markup;
use crate::stroke::Stroke;
use crate::theme;
use crate::ticks::Tick;
use serde::Serialize;

/// A pair of axes and the marks between them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// The horizontal axis.
    pub x: FigureAxis,
    /// The vertical axis.
    pub y: FigureAxis,
    /// A line of text above the frame at its left end: `"(a)"`, `"**(a)** *δ* = 0"`.
    pub caption: Option<String>,
    /// The marks; the first one is lowest.
    pub marks: Vec<Mark>,
    /// Whether frame, ticks, numbers and labels are left out: a drawing, whose axes only say how large it is.
    pub bare: bool,
}

impl Panel {
    /// An empty panel.
    #[must_use]
    pub fn new(x: FigureAxis, y: FigureAxis) -> Self {
        Self { x, y, caption: None, marks: Vec::new(), bare: false }
    }

    /// Sets the caption.
    #[must_use]
    pub fn caption(self, markup: impl Into<String>) -> Self {
        Self { caption: Some(markup.into()), ..self }
    }

    /// Adds a mark on top of the others.
    #[must_use]
    pub fn with(mut self, mark: impl Into<Mark>) -> Self {
        self.marks.push(mark.into());
        self
    }

    /// Adds a mark on top of the others.
    pub fn add(&mut self, mark: impl Into<Mark>) {
        self.marks.push(mark.into());
    }

    /// Ranges and ticks for a frame of approximately this size.
    pub(crate) fn prepare(&self, width: f64, height: f64) -> Prepared {
        use crate::scale::Scale::Log10;
        let (mut x, mut y) = (Extent::new(self.x.scale == Log10), Extent::new(self.y.scale == Log10));
        for mark in &self.marks {
            mark.extent(&mut x, &mut y);
        }
        let (x_range, y_range) = (self.x.resolve(x.range()), self.y.resolve(y.range()));
        let room = |length: f64, each: f64| (length / each).clamp(2.0, 10.0);
        #[expect(clippy::cast_possible_truncation, reason = "between 2 and 10")]
        let y_ticks = self.y.resolve_ticks(y_range, room(height, 48.0) as usize);
        // as many numbers as fit side by side with space between them
        #[expect(clippy::cast_possible_truncation, reason = "between 2 and 10")]
        let mut most = room(width, 50.0) as usize;
        let mapping = Mapping { scale: self.x.scale, range: x_range, page: (0.0, width) };
        let x_ticks = loop {
            let ticks = self.x.resolve_ticks(x_range, most);
            if most <= 1 || self.x.ticks.is_some() || !crowded(&ticks, &mapping) {
                break ticks;
            }
            most -= 1;
        };
        Prepared { x_range, y_range, x_ticks, y_ticks }
    }

    /// The room that numbers, labels and caption need around the frame.
    pub(crate) fn margins(&self, prepared: &Prepared) -> Margins {
        if self.bare {
            return Margins {
                top: if self.caption.is_some() { 1.5 * theme::CAPTION_TEXT } else { 0.0 },
                ..Margins::default()
            };
        }
        let width = |t: &Tick| markup::width(&t.label, theme::TICK_TEXT);
        let numbers = prepared.y_ticks.iter().map(width).fold(0.0, f64::max);
        let label = |axis: &FigureAxis| {
            if axis.label.is_empty() { 0.0 } else { 1.4 * theme::LABEL_TEXT }
        };
        let beside = theme::TICK + theme::TICK_GAP;
        // half of the last number extends beyond the frame if it is at the end
        let end = prepared.x_ticks.iter().filter(|_| self.x.numbers).map(width).fold(0.0, f64::max);
        Margins {
            left: (beside + numbers + label(&self.y)).max(end / 2.0),
            right: end / 2.0,
            top: if self.caption.is_some() { 1.5 * theme::CAPTION_TEXT } else { theme::TICK_TEXT / 2.0 },
            bottom: beside + if self.x.numbers { theme::TICK_TEXT } else { 0.0 } + label(&self.x),
        }
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame, prepared: &Prepared) {
        canvas.define_clip(frame);
        canvas.push("<g>\n");
        for mark in &self.marks {
            mark.draw(canvas, frame);
        }
        if self.bare {
            canvas.push("</g>\n");
            return;
        }
        canvas.push(
            &frame.rect(&format!(" fill=\"none\"{}", Stroke::new(Colour::BLACK).width(theme::FRAME).attributes())),
        );
        canvas.push("\n");
        self.draw_ticks(canvas, frame, prepared);
        self.draw_labels(canvas, frame, prepared);
        canvas.push("</g>\n");
    }
}

/// The ranges and ticks of a panel.
#[derive(Clone, Debug)]
pub(crate) struct Prepared {
    pub(crate) x_range: (f64, f64),
    pub(crate) y_range: (f64, f64),
    pub(crate) x_ticks: Vec<Tick>,
    pub(crate) y_ticks: Vec<Tick>,
}

/// The margins around a frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Margins {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// Whether two numbers are too close to each other.
fn crowded(ticks: &[Tick], mapping: &Mapping) -> bool {
    let mut spans: Vec<(f64, f64)> = ticks
        .iter()
        .filter(|t| !t.label.trim().is_empty())
        .map(|t| (mapping.at(t.value), markup::width(&t.label, theme::TICK_TEXT)))
        .collect();
    spans.sort_by(|a, b| a.0.total_cmp(&b.0));
    let air = 0.7 * theme::TICK_TEXT;
    spans.windows(2).any(|w| w[1].0 - w[0].0 < (w[0].1 + w[1].1) / 2.0 + air)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_never_touch() {
        for width in [40.0, 100.0, 300.0, 600.0] {
            for (lo, hi) in [(0.0, 1.0), (-1234.5, 99_999.0), (1.000_001, 1.000_002), (0.0, 4e-7)] {
                let panel = Panel::new(FigureAxis::new("x").range(lo, hi), FigureAxis::new("y"));
                let prepared = panel.prepare(width, 300.0);
                let mapping = Mapping { scale: panel.x.scale, range: prepared.x_range, page: (0.0, width) };
                let shown = prepared.x_ticks.iter().filter(|t| !t.label.is_empty()).count();
                assert!(shown <= 2 || !crowded(&prepared.x_ticks, &mapping), "{width} {lo} {hi}");
            }
        }
    }

    #[test]
    fn a_drawing_has_marks_only() {
        let panel = || Panel::new(FigureAxis::new("x").range(0.0, 1.0), FigureAxis::new("y").range(0.0, 1.0));
        let svg = |panel| crate::Figure::new(panel).to_svg();
        let (framed, bare) = (
            svg(panel()),
            svg(Panel { bare: true, ..panel() }.with(crate::Line::new([0.0, 1.0], [0.0, 1.0], Colour::BLACK))),
        );
        assert!(framed.contains("<text") && !bare.contains("<text") && bare.contains("stroke-linejoin"), "{bare}");
    }

    #[test]
    fn wide_numbers_get_wide_margins() {
        let margin = |hi| {
            let panel = Panel::new(FigureAxis::new("x"), FigureAxis::new("y").range(0.0, hi));
            panel.margins(&panel.prepare(400.0, 300.0)).left
        };
        assert!(margin(90_000.0) > margin(9.0) + 40.0);
    }
}
