//! Rectangles with classes: the cells of a map, whole or divided into stripes.

use crate::canvas::{Canvas, Frame};
use crate::mark::extent::Extent;
use crate::number::N;
use crate::palette::ClassStyle;
use serde::Serialize;

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rect {
    /// Left and right edge.
    pub x: (f64, f64),
    /// Lower and upper edge.
    pub y: (f64, f64),
    /// Index of its style.
    pub class: usize,
}

/// Rectangles in the styles of their classes. A class without a style is not drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rects {
    /// The rectangles.
    pub rects: Vec<Rect>,
    /// The style of each class.
    pub styles: Vec<ClassStyle>,
}

impl Rects {
    /// No rectangles yet, with these styles.
    pub fn new(styles: impl Into<Vec<ClassStyle>>) -> Self {
        Self { rects: Vec::new(), styles: styles.into() }
    }

    /// Adds a cell. Several classes, which are coexisting motions, share it in vertical stripes of equal width.
    pub fn cell(&mut self, x: (f64, f64), y: (f64, f64), classes: &[usize]) {
        let n = classes.len() as f64;
        for (k, &class) in classes.iter().enumerate() {
            let part = |k: usize| x.0 + (x.1 - x.0) * k as f64 / n;
            self.rects.push(Rect { x: (part(k), part(k + 1)), y, class });
        }
    }

    /// Draws one path for each class: neighbours of a class join without a seam, and the file is small.
    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        let mut paths = vec![String::new(); self.styles.len()];
        for rect in &self.rects {
            if let (Some(path), Some([l, t, r, b])) = (paths.get_mut(rect.class), frame.cut(rect.x, rect.y)) {
                path.push_str(&format!("M{} {}H{}V{}H{}z", N(l), N(t), N(r), N(b), N(l)));
            }
        }
        for (path, style) in paths.iter().zip(&self.styles) {
            if path.is_empty() {
                continue;
            }
            let fill = style.colour.paint("fill");
            canvas.push(&format!("<path d=\"{path}\" shape-rendering=\"crispEdges\"{fill}/>\n"));
            if let Some(hatch) = style.hatch {
                let paint = canvas.hatch(hatch);
                canvas.push(&format!("<path d=\"{path}\" fill=\"{paint}\"/>\n"));
            }
        }
    }

    pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
        for rect in &self.rects {
            x.see_all(&[rect.x.0, rect.x.1]);
            y.see_all(&[rect.y.0, rect.y.1]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::test_frame;
    use crate::palette::class_style;

    #[test]
    fn split_cells_are_stripes() {
        let mut rects = Rects::new([class_style("1/1"), class_style("2/1")]);
        rects.cell((0.0, 1.0), (0.0, 1.0), &[0, 1]);
        rects.cell((1.0, 2.0), (0.0, 1.0), &[9]);
        rects.cell((1.0, 2.0), (0.0, f64::NAN), &[0]);
        rects.cell((0.0, 1.0), (0.0, 1.0), &[]);
        let mut canvas = Canvas::new("");
        rects.draw(&mut canvas, &test_frame((0.0, 2.0), (0.0, 1.0)));
        assert!(canvas.body.contains("d=\"M0 0H25V100H0z\""), "{}", canvas.body);
        assert!(canvas.body.contains("d=\"M25 0H50V100H25z\""));
    }
}
