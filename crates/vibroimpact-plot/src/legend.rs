//! The legend: the meaning of the signs of a figure, placed below the panels and never over them.

use crate::canvas::Canvas;
use crate::colour::Colour;
use crate::label::Placed;
use crate::mark::points::{PointStyle, Points};
use crate::markup;
use crate::number::N;
use crate::palette::ClassStyle;
use crate::stroke::Stroke;
use crate::theme;
use serde::Serialize;

/// The sign of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Key {
    /// A short line.
    Line(Stroke),
    /// A point.
    Point(PointStyle),
    /// A patch with the colour and hatch of a class.
    Patch(ClassStyle),
    /// An outlined patch.
    Outline(Stroke),
}

/// A sign and its meaning.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// The sign.
    pub key: Key,
    /// The meaning, in the markup of [labels](crate::plain).
    pub label: String,
}

/// The legend of a figure.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Legend {
    /// The entries, in columns from top to bottom.
    pub entries: Vec<Entry>,
    /// A line of text above the entries.
    pub title: Option<String>,
}

const KEY: f64 = 32.0;
const KEY_GAP: f64 = 9.0;
const COLUMN_GAP: f64 = 26.0;
const ROW: f64 = 28.0;
const PATCH: f64 = 19.0;

impl Legend {
    /// An empty legend below the panels.
    #[must_use]
    pub fn below() -> Self {
        Self::default()
    }

    /// Adds an entry.
    #[must_use]
    pub fn entry(mut self, key: Key, label: impl Into<String>) -> Self {
        self.entries.push(Entry { key, label: label.into() });
        self
    }

    /// Adds an entry for a line.
    #[must_use]
    pub fn line(self, stroke: Stroke, label: impl Into<String>) -> Self {
        self.entry(Key::Line(stroke), label)
    }

    /// Adds an entry for points.
    #[must_use]
    pub fn points(self, points: &Points, label: impl Into<String>) -> Self {
        self.entry(Key::Point(points.style), label)
    }

    /// Adds an entry for a class.
    #[must_use]
    pub fn patch(self, style: ClassStyle, label: impl Into<String>) -> Self {
        self.entry(Key::Patch(style), label)
    }

    /// The positions of all entries in the given width.
    pub(crate) fn arrange(&self, width: f64) -> Arranged {
        let head = if self.title.is_some() { ROW } else { 0.0 };
        let n = self.entries.len();
        // the smallest number of rows that fits the width
        let rows = (1..=n).find(|&rows| self.total(&self.widths(rows)) <= width).unwrap_or(n);
        let widths = self.widths(rows);
        let title = self.title.as_ref().map_or(0.0, |t| markup::width(t, theme::LEGEND_TEXT));
        let wide = self.total(&widths).max(title);
        Arranged { rows, width: wide, height: head + rows as f64 * ROW, widths }
    }

    fn widths(&self, rows: usize) -> Vec<f64> {
        let width = |e: &Entry| KEY + KEY_GAP + markup::width(&e.label, theme::LEGEND_TEXT);
        self.entries.chunks(rows.max(1)).map(|column| column.iter().map(width).fold(0.0, f64::max)).collect()
    }

    fn total(&self, widths: &[f64]) -> f64 {
        widths.iter().sum::<f64>() + COLUMN_GAP * widths.len().saturating_sub(1) as f64
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, left: f64, top: f64, arranged: &Arranged) {
        let size = theme::LEGEND_TEXT;
        let mut top = top;
        if let Some(title) = &self.title {
            canvas.push(&Placed::new(title, left, top + ROW / 2.0 + 0.365 * size, size).svg());
            top += ROW;
        }
        let mut x = left;
        for (column, width) in self.entries.chunks(arranged.rows.max(1)).zip(&arranged.widths) {
            for (row, entry) in column.iter().enumerate() {
                let middle = top + (row as f64 + 0.5) * ROW;
                key(canvas, entry.key, x, middle);
                let baseline = middle + 0.365 * size;
                canvas.push(&Placed::new(&entry.label, x + KEY + KEY_GAP, baseline, size).svg());
            }
            x += width + COLUMN_GAP;
        }
    }
}

/// The size and the columns of the legend.
#[derive(Clone, Debug)]
pub(crate) struct Arranged {
    rows: usize,
    widths: Vec<f64>,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

fn key(canvas: &mut Canvas, key: Key, x: f64, middle: f64) {
    let rect = |attributes: &str| {
        let (x, y) = (N(x + 0.5), N(middle - PATCH / 2.0));
        format!("<rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{PATCH}\"{attributes}/>", N(KEY - 1.0))
    };
    match key {
        Key::Line(stroke) => canvas.push(&format!(
            "<path d=\"M{} {}H{}\" fill=\"none\"{}/>\n",
            N(x),
            N(middle),
            N(x + KEY),
            stroke.attributes()
        )),
        Key::Point(style) => {
            // very small points are drawn larger in the legend, so that they are visible
            let size = if style.size.is_finite() { style.size.clamp(7.0, 20.0) } else { 9.0 };
            canvas.push(&style.paint(&style.shape.path(x + KEY / 2.0, middle, size)));
        }
        Key::Patch(style) => {
            canvas.push(&rect(&style.colour.paint("fill")));
            if let Some(hatch) = style.hatch {
                let paint = canvas.hatch(hatch);
                canvas.push(&rect(&format!(" fill=\"{paint}\"")));
            }
            // light classes need an outline to be visible on white paper
            let edge = Stroke::new(Colour::GREY).width(1.0).attributes();
            canvas.push(&rect(&format!(" fill=\"none\"{edge}")));
            canvas.push("\n");
        }
        Key::Outline(stroke) => {
            canvas.push(&rect(&format!(" fill=\"none\"{}", stroke.attributes())));
            canvas.push("\n");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn legend(n: usize) -> Legend {
        let stroke = Stroke::new(Colour::BLACK);
        (0..n).fold(Legend::below(), |l, i| l.line(stroke, format!("entry number {i}")))
    }

    #[test]
    fn below_wraps_into_columns_that_fit() {
        let arranged = legend(14).arrange(660.0);
        assert!(arranged.width <= 660.0);
        assert_eq!((arranged.rows, arranged.widths.len()), (5, 3));
        let narrow = legend(3).arrange(10.0);
        assert_eq!(narrow.rows, 3, "too narrow for anything: one column");
        assert_eq!(legend(0).arrange(660.0).height, 0.0);
    }
}
