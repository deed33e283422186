//! Polylines.

use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::mark::extent::Extent;
use crate::mark::thin;
use crate::stroke::{Dash, Stroke};
use serde::Serialize;

/// A polyline; a `NaN` or infinite coordinate breaks it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// Abscissae.
    pub xs: Vec<f64>,
    /// Ordinates; surplus values of the longer list are ignored.
    pub ys: Vec<f64>,
    /// Its stroke.
    pub stroke: Stroke,
}

impl Line {
    /// A solid line through these points.
    pub fn new(xs: impl Into<Vec<f64>>, ys: impl Into<Vec<f64>>, colour: Colour) -> Self {
        Self { xs: xs.into(), ys: ys.into(), stroke: Stroke::new(colour) }
    }

    /// Sets the width in figure units.
    #[must_use]
    pub fn width(self, width: f64) -> Self {
        Self { stroke: self.stroke.width(width), ..self }
    }

    /// Sets the dashes.
    #[must_use]
    pub fn dash(self, dash: Dash) -> Self {
        Self { stroke: self.stroke.dash(dash), ..self }
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        let points = self.xs.iter().zip(&self.ys).map(|(&x, &y)| {
            let finite = x.is_finite() && y.is_finite();
            if finite { frame.at(x, y) } else { (f64::NAN, f64::NAN) }
        });
        let path = thin::path(points, frame);
        if !path.is_empty() {
            let (clip, stroke) = (canvas.clip(frame), self.stroke.attributes());
            canvas
                .push(&format!("<g{clip}><path d=\"{path}\" fill=\"none\" stroke-linejoin=\"round\"{stroke}/></g>\n"));
        }
    }

    pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
        for (&a, &b) in self.xs.iter().zip(&self.ys) {
            if a.is_finite() && b.is_finite() {
                x.see(a);
                y.see(b);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::test_frame;

    #[test]
    fn lines_are_clipped_and_dashed() {
        let mut canvas = Canvas::new("");
        let line = Line::new([0.0, 1.0, 9.0], [0.0, 1.0], Colour::BLACK).dash(Dash::Dashed);
        line.draw(&mut canvas, &test_frame((0.0, 1.0), (0.0, 1.0)));
        assert!(canvas.body.contains("clip-path=\"url(#clip0)\""), "{}", canvas.body);
        assert!(canvas.body.contains("d=\"M0 100L100 0\"") && canvas.body.contains("dasharray"));
    }
}
