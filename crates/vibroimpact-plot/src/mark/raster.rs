//! A grid of class indices as one image: basins of attraction with one pixel for each cell.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use resvg::tiny_skia::{IntSize, Pixmap};

use crate::canvas::{Canvas, Frame};
use crate::colour::Colour;
use crate::error::{MAX_SIDE, PlotError};
use crate::mark::extent::Extent;
use crate::mark::rects::{Rect, Rects};
use crate::number::N;
use crate::palette::ClassStyle;
use crate::scale::Scale;
use crate::vision::Vision;
use serde::Serialize;

/// Equal cells over a rectangle, each in the colour of its class.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Raster {
    x: (f64, f64),
    y: (f64, f64),
    nx: usize,
    ny: usize,
    classes: Vec<u16>,
    palette: Vec<Colour>,
}

impl Raster {
    /// Cells that fill the rectangle `x` times `y` (outer edges). `classes` has rows from the lowest y upwards, each
    /// from the first x on. A class without a colour in the palette is transparent.
    ///
    /// # Errors
    /// If `classes` does not have `nx * ny` values, or a side is 0 or above 16384.
    pub fn new(
        x: (f64, f64),
        y: (f64, f64),
        (nx, ny): (usize, usize),
        classes: impl Into<Vec<u16>>,
        palette: impl Into<Vec<Colour>>,
    ) -> Result<Self, PlotError> {
        let (classes, palette) = (classes.into(), palette.into());
        if nx.checked_mul(ny) != Some(classes.len()) {
            return Err(PlotError::RasterSize { given: classes.len(), nx, ny });
        }
        let (width, height) = (nx as f64, ny as f64);
        if !(1.0..=MAX_SIDE).contains(&width) || !(1.0..=MAX_SIDE).contains(&height) {
            return Err(PlotError::ImageSize { width, height });
        }
        Ok(Self { x, y, nx, ny, classes, palette })
    }

    /// The same, but `x` and `y` are the centres of the first and last cells, that is, the grid points that were
    /// computed.
    ///
    /// # Errors
    /// As [`Raster::new`].
    pub fn centred(
        x: (f64, f64),
        y: (f64, f64),
        (nx, ny): (usize, usize),
        classes: impl Into<Vec<u16>>,
        palette: impl Into<Vec<Colour>>,
    ) -> Result<Self, PlotError> {
        let outer = |(a, b): (f64, f64), n: usize| {
            let half = if n > 1 { (b - a) / (2.0 * (n - 1) as f64) } else { 0.5 };
            (a - half, b + half)
        };
        Self::new(outer(x, nx), outer(y, ny), (nx, ny), classes, palette)
    }

    pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        if [frame.x.scale, frame.y.scale].contains(&Scale::Log10) {
            return self.runs().draw(canvas, frame);
        }
        let (a, b) = (frame.x.at(self.x.0), frame.x.at(self.x.1));
        let (c, d) = (frame.y.at(self.y.0), frame.y.at(self.y.1));
        let (width, height) = ((b - a).abs(), (d - c).abs());
        if !(width > 0.0 && height > 0.0) {
            return;
        }
        // page coordinates increase downwards, so the first row is the lowest line of the image
        let greyed;
        let shown = if canvas.grey {
            greyed = self.greyed();
            &greyed
        } else {
            self
        };
        let Some(png) = shown.png(b < a, c > d) else {
            return;
        };
        let clip = canvas.clip(frame);
        canvas.push(&format!(
            "<g{clip}><image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
             image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{}\"/></g>\n",
            N(a.min(b)),
            N(c.min(d)),
            N(width),
            N(height),
            BASE64_STANDARD.encode(&png)
        ));
    }

    /// The same raster in greys.
    fn greyed(&self) -> Self {
        let palette = self.palette.iter().map(|colour| Vision::Grey.see(*colour)).collect();
        Self { palette, ..self.clone() }
    }

    fn colour(&self, class: u16) -> Option<Colour> {
        self.palette.get(usize::from(class)).copied()
    }

    /// An image with one pixel for each cell. `None` does not occur for the sizes allowed by `new`.
    fn png(&self, mirror: bool, upturn: bool) -> Option<Vec<u8>> {
        let mut data = Vec::with_capacity(4 * self.classes.len());
        for j in 0..self.ny {
            let row = if upturn { self.ny - 1 - j } else { j } * self.nx;
            for i in 0..self.nx {
                let column = if mirror { self.nx - 1 - i } else { i };
                let pixel = self.colour(self.classes[row + column]).map_or([0; 4], |c| {
                    let m = resvg::tiny_skia::ColorU8::from_rgba(c.r, c.g, c.b, c.a).premultiply();
                    [m.red(), m.green(), m.blue(), m.alpha()]
                });
                data.extend_from_slice(&pixel);
            }
        }
        let size = IntSize::from_wh(u32::try_from(self.nx).ok()?, u32::try_from(self.ny).ok()?)?;
        Pixmap::from_vec(data, size)?.encode_png().ok()
    }

    /// Runs of one class as rectangles, because cells have different widths on a logarithmic axis.
    fn runs(&self) -> Rects {
        let step = |(a, b): (f64, f64), i: usize, n: usize| a + (b - a) * i as f64 / n as f64;
        let mut rects = Rects::new(self.palette.iter().map(|colour| ClassStyle::plain(*colour)).collect::<Vec<_>>());
        for (j, row) in self.classes.chunks(self.nx).enumerate() {
            let y = (step(self.y, j, self.ny), step(self.y, j + 1, self.ny));
            let mut i = 0;
            for run in row.chunk_by(|a, b| a == b) {
                let x = (step(self.x, i, self.nx), step(self.x, i + run.len(), self.nx));
                i += run.len();
                rects.rects.push(Rect { x, y, class: usize::from(run[0]) });
            }
        }
        rects
    }

    pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
        x.see_all(&[self.x.0, self.x.1]);
        y.see_all(&[self.y.0, self.y.1]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_row_is_the_lowest() -> Result<(), PlotError> {
        let colours = [Colour::WHITE, Colour::BLACK];
        let raster = Raster::new((0.0, 1.0), (0.0, 1.0), (2, 2), [0, 1, 0, 7], colours)?;
        let png = raster.png(false, true).unwrap_or_default();
        let picture = Pixmap::decode_png(&png).map_err(|e| PlotError::Png(e.to_string()))?;
        let red_alpha: Vec<_> = picture.pixels().iter().map(|p| (p.red(), p.alpha())).collect();
        assert_eq!(red_alpha, [(255, 255), (0, 0), (255, 255), (0, 255)]);
        Ok(())
    }

    #[test]
    fn sizes_are_checked() {
        let make = |n, shape| Raster::new((0.0, 1.0), (0.0, 1.0), shape, vec![0; n], [Colour::BLACK]);
        assert!(matches!(make(5, (2, 3)), Err(PlotError::RasterSize { given: 5, nx: 2, ny: 3 })));
        assert!(matches!(make(0, (0, 3)), Err(PlotError::ImageSize { .. })));
        assert!(matches!(make(0, (usize::MAX, 2)), Err(PlotError::RasterSize { .. })));
    }

    #[test]
    fn centred_cells_reach_half_a_step_further() -> Result<(), PlotError> {
        let raster = Raster::centred((0.0, 2.0), (5.0, 5.0), (3, 1), [0; 3], [Colour::BLACK])?;
        assert_eq!((raster.x, raster.y), ((-0.5, 2.5), (4.5, 5.5)));
        Ok(())
    }
}
