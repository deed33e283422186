//! Areas with holes: regions of existence, or outlines read from a published map.

use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::hatch::Hatch;
use crate::mark::extent::Extent;
use crate::number::N;
use crate::stroke::Stroke;
use serde::Serialize;

/// Closed rings. An area inside an even number of rings is outside the region.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FilledRegion {
    /// The rings, each a list of corners; the last corner is joined to the first.
    pub rings: Vec<Vec<(f64, f64)>>,
    /// Colour of the inside; it may be transparent to show what lies below.
    pub fill: Option<Colour>,
    /// Hatch of the inside.
    pub hatch: Option<Hatch>,
    /// The outline.
    pub outline: Option<Stroke>,
}

impl FilledRegion {
    /// A region with these rings. It is invisible until it has a fill, a hatch or an outline.
    #[must_use]
    pub fn new(rings: Vec<Vec<(f64, f64)>>) -> Self {
        Self { rings, ..Self::default() }
    }

    /// A region with one ring.
    pub fn polygon(ring: impl Into<Vec<(f64, f64)>>) -> Self {
        Self::new(vec![ring.into()])
    }

    /// Sets the fill.
    #[must_use]
    pub fn fill(self, colour: Colour) -> Self {
        Self { fill: Some(colour), ..self }
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        let mut path = String::new();
        for ring in &self.rings {
            // corners that cannot be shown are left out; fewer than three corners enclose nothing
            let corners: Vec<_> =
                ring.iter().map(|&(x, y)| frame.at(x, y)).filter(|(x, y)| !x.is_nan() && !y.is_nan()).collect();
            if corners.len() >= 3 {
                for (i, (x, y)) in corners.into_iter().enumerate() {
                    path.push_str(&format!("{}{} {}", if i == 0 { 'M' } else { 'L' }, N(x), N(y)));
                }
                path.push('z');
            }
        }
        if path.is_empty() {
            return;
        }
        canvas.push(&format!("<g{} fill-rule=\"evenodd\">", canvas.clip(frame)));
        if let Some(fill) = self.fill {
            canvas.push(&format!("<path d=\"{path}\"{}/>", fill.paint("fill")));
        }
        if let Some(hatch) = self.hatch {
            let paint = canvas.hatch(hatch);
            canvas.push(&format!("<path d=\"{path}\" fill=\"{paint}\"/>"));
        }
        if let Some(outline) = self.outline {
            let stroke = outline.attributes();
            canvas.push(&format!("<path d=\"{path}\" fill=\"none\" stroke-linejoin=\"round\"{stroke}/>"));
        }
        canvas.push("</g>\n");
    }

    pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
        for &(a, b) in self.rings.iter().flatten() {
            x.see(a);
            y.see(b);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::test_frame;

    #[test]
    fn rings_with_too_few_corners_are_nothing() {
        let frame = test_frame((0.0, 1.0), (0.0, 1.0));
        let mut canvas = Canvas::new("");
        let bad = vec![(0.0, 0.0), (1.0, f64::NAN), (1.0, 1.0)];
        FilledRegion::polygon(bad).fill(Colour::BLACK).draw(&mut canvas, &frame);
        assert_eq!(canvas.body, "");
        let good = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)];
        FilledRegion::polygon(good).fill(Colour::BLACK.alpha(0.5)).draw(&mut canvas, &frame);
        assert!(canvas.body.contains("M0 100L100 100L100 0z") && canvas.body.contains("fill-opacity"));
    }
}
