//! Separate points: impacts, Poincaré sections, named points.

use std::collections::HashSet;
use std::fmt::Write as _;

use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::mark::extent::Extent;
use crate::number::N;
use serde::Serialize;

/// The shape of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// ●
    #[default]
    Circle,
    /// ■
    Square,
    /// ◆
    Diamond,
    /// ▲
    TriangleUp,
    /// ▼
    TriangleDown,
    /// ×
    Cross,
    /// +
    Plus,
    /// ▶
    TriangleRight,
    /// ◀
    TriangleLeft,
    /// ⬟
    Pentagon,
    /// ★
    Star,
    /// ▮
    Bar,
}

impl Shape {
    /// Path data about a centre. `size` is the diameter of the circle; the other shapes have its area.
    pub(crate) fn path(self, x: f64, y: f64, size: f64) -> String {
        let r = size / 2.0;
        let (nx, ny) = (N(x), N(y));
        match self {
            Self::Circle => {
                let (n, d) = (N(r), N(size));
                format!("M{} {ny}a{n} {n} 0 1 0 {d} 0a{n} {n} 0 1 0 -{d} 0z", N(x - r))
            }
            Self::Square => {
                let h = r * 0.886;
                let side = N(2.0 * h);
                format!("M{} {}h{side}v{side}h-{side}z", N(x - h), N(y - h))
            }
            Self::Diamond => {
                let h = r * 1.253;
                format!("M{} {ny}L{nx} {}L{} {ny}L{nx} {}z", N(x - h), N(y - h), N(x + h), N(y + h))
            }
            Self::TriangleUp | Self::TriangleDown => {
                let (h, s) = (r * 1.555, if self == Self::TriangleUp { 1.0 } else { -1.0 });
                let (base, half) = (N(y + s * h / 2.0), h * 0.866);
                format!("M{nx} {}L{} {base}L{} {base}z", N(y - s * h), N(x + half), N(x - half))
            }
            Self::Cross => {
                let h = r * 0.8;
                let (l, t, b, rt) = (N(x - h), N(y - h), N(y + h), N(x + h));
                format!("M{l} {t}L{rt} {b}M{l} {b}L{rt} {t}")
            }
            Self::TriangleRight | Self::TriangleLeft => {
                let (h, s) = (r * 1.555, if self == Self::TriangleRight { 1.0 } else { -1.0 });
                let (base, half) = (N(x - s * h / 2.0), h * 0.866);
                format!("M{} {ny}L{base} {}L{base} {}z", N(x + s * h), N(y + half), N(y - half))
            }
            Self::Pentagon => around(x, y, &[r * 1.149; 5]),
            Self::Star => around(x, y, &[r * 1.462, r * 0.731].repeat(5)),
            Self::Bar => {
                let (w, h) = (r * 0.62, r * 1.27);
                format!("M{} {}h{}v{}h-{}z", N(x - w), N(y - h), N(2.0 * w), N(2.0 * h), N(2.0 * w))
            }
            Self::Plus => format!("M{} {ny}H{}M{nx} {}V{}", N(x - r), N(x + r), N(y - r), N(y + r)),
        }
    }

    fn is_open(self) -> bool {
        matches!(self, Self::Cross | Self::Plus)
    }
}

/// A closed path around a centre, through points at these distances from it and at equal angles from the top on.
#[allow(clippy::cast_precision_loss)] // a few points
fn around(x: f64, y: f64, distances: &[f64]) -> String {
    let mut path = String::new();
    let (mut angle, mut verb) = (0.0_f64, 'M');
    for distance in distances {
        let (sin, cos) = angle.sin_cos();
        let _ = write!(path, "{verb}{} {}", N(x + distance * sin), N(y - distance * cos));
        angle += core::f64::consts::TAU / distances.len() as f64;
        verb = 'L';
    }
    path + "z"
}

/// The style of points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PointStyle {
    /// The shape.
    pub shape: Shape,
    /// Diameter in figure units.
    pub size: f64,
    /// The colour.
    pub colour: Colour,
    /// Whether the points are filled; otherwise only outlined.
    pub filled: bool,
    /// An outline in another colour, which separates filled points from what lies below.
    pub rim: Option<Colour>,
}

impl PointStyle {
    /// Paints the outline and the body of points with this path.
    pub(crate) fn paint(&self, path: &str) -> String {
        let open = self.shape.is_open();
        let line = if open { 2.5 } else { 2.0 };
        let mut out = String::new();
        if let Some(rim) = self.rim {
            let width = if open || !self.filled { line + 3.0 } else { 3.0 };
            out.push_str(&format!(
                "<path d=\"{path}\" fill=\"none\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n",
                N(width),
                rim.paint("stroke")
            ));
        }
        let ink = if self.filled && !open {
            self.colour.paint("fill")
        } else {
            format!(" fill=\"none\" stroke-width=\"{line}\"{}", self.colour.paint("stroke"))
        };
        out.push_str(&format!("<path d=\"{path}\"{ink}/>\n"));
        out
    }
}

/// Points with a common style.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Points {
    /// Abscissae.
    pub xs: Vec<f64>,
    /// Ordinates; surplus values of the longer list are ignored.
    pub ys: Vec<f64>,
    /// The style.
    pub style: PointStyle,
}

impl Points {
    /// Filled circles of 9 units (1.1 mm).
    pub fn new(xs: impl Into<Vec<f64>>, ys: impl Into<Vec<f64>>, colour: Colour) -> Self {
        let style = PointStyle { shape: Shape::Circle, size: 9.0, colour, filled: true, rim: None };
        Self { xs: xs.into(), ys: ys.into(), style }
    }

    /// Sets the shape.
    #[must_use]
    pub fn shape(mut self, shape: Shape) -> Self {
        self.style.shape = shape;
        self
    }

    /// Sets the diameter in figure units.
    #[must_use]
    pub fn size(mut self, size: f64) -> Self {
        self.style.size = size;
        self
    }

    /// Sets the outline.
    #[must_use]
    pub fn rim(mut self, colour: Colour) -> Self {
        self.style.rim = Some(colour);
        self
    }

    /// Draws the points. The frame does not clip them: a point whose centre is inside is drawn completely.
    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        let size = if self.style.size.is_finite() { self.style.size.clamp(0.2, 200.0) } else { 9.0 };
        let mut path = String::new();
        let mut seen = HashSet::new();
        // two points within a fiftieth of their size look like one; in a cloud of thousands of overlapping points a
        // tenth is enough, and the file is smaller
        let many = self.xs.len().min(self.ys.len()) > 5000;
        let grid = (size / if many { 10.0 } else { 50.0 }).max(0.05);
        for (&x, &y) in self.xs.iter().zip(&self.ys) {
            let (px, py) = frame.at(x, y);
            #[expect(clippy::cast_possible_truncation, reason = "page coordinates are within 1e6")]
            let cell = ((px / grid).round() as i64, (py / grid).round() as i64);
            if frame.holds((px, py)) && seen.insert(cell) {
                path.push_str(&self.style.shape.path(px, py, size));
            }
        }
        if !path.is_empty() {
            canvas.push(&self.style.paint(&path));
        }
    }

    pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
        x.see_all(&self.xs);
        y.see_all(&self.ys);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::test_frame;

    #[test]
    fn doubles_and_strangers_are_left_out() {
        let (frame, mut canvas) = (test_frame((0.0, 1.0), (0.0, 1.0)), Canvas::new(""));
        let xs = [0.5, 0.5, f64::NAN, 7.0, 1.0];
        Points::new(xs, [0.5, 0.5, 0.5, 0.5, 0.0], Colour::BLACK).shape(Shape::Plus).draw(&mut canvas, &frame);
        assert_eq!(canvas.body.matches('V').count(), 2, "{}", canvas.body);
    }

    #[test]
    fn every_shape_has_a_path() {
        let round =
            [Shape::Circle, Shape::Square, Shape::Diamond, Shape::Cross, Shape::Plus, Shape::Pentagon, Shape::Star];
        let pointed = [Shape::TriangleUp, Shape::TriangleDown, Shape::TriangleRight, Shape::TriangleLeft, Shape::Bar];
        let all = [&round[..], &pointed].concat();
        let paths: HashSet<String> = all.iter().map(|s| s.path(5.0, 5.0, 10.0)).collect();
        assert_eq!(paths.len(), all.len());
    }
}
