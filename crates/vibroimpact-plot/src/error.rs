//! The errors of figures, as data; `Display` makes the message.

use std::fmt;

/// A reason why a figure could not be made.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PlotError {
    /// The number of class indices is not `nx * ny`.
    RasterSize {
        /// Number of class indices given.
        given: usize,
        /// Number of columns.
        nx: usize,
        /// Number of rows.
        ny: usize,
    },
    /// The image would have no pixels, or more than the allowed number.
    ImageSize {
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// A page of this size cannot be written.
    PageSize {
        /// Width in millimetres.
        width: f64,
        /// Height in millimetres.
        height: f64,
    },
    /// A figure of this size has no room for its panels.
    NoRoom {
        /// Width in millimetres.
        width: f64,
        /// Height in millimetres.
        height: f64,
    },
    /// The renderer refused the SVG text: a defect of this crate.
    Svg(String),
    /// The PNG encoder failed: a defect of this crate.
    Png(String),
    /// The writer of PDF failed: a defect of this crate.
    Pdf(String),
}

/// The longest side of a PNG, in pixels: 170 mm at 2400 dpi.
pub(crate) const MAX_SIDE: f64 = 16_384.0;

impl fmt::Display for PlotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RasterSize { given, nx, ny } => write!(
                f,
                "a raster of {nx} x {ny} cells needs {} class indices, {given} were given",
                nx.saturating_mul(*ny)
            ),
            Self::ImageSize { width, height } => write!(
                f,
                "an image of {width} x {height} pixels lies outside 1..={MAX_SIDE} on a side\n\
                 hint: scale is pixels per figure unit; 1.476 gives 300 dpi"
            ),
            Self::NoRoom { width, height } => write!(
                f,
                "a figure of {width} x {height} mm has no room for its axes and its legend\n\
                 hint: the usual figure of one column is 85 mm wide and 60 mm high"
            ),
            Self::Svg(why) => write!(f, "the renderer refused the figure's SVG text: {why}"),
            Self::PageSize { width, height } => write!(f, "a page of {width} x {height} mm cannot be written"),
            Self::Pdf(why) => write!(f, "the figure could not be written as PDF: {why}"),
            Self::Png(why) => write!(f, "the figure could not be encoded as PNG: {why}"),
        }
    }
}

impl std::error::Error for PlotError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_name_the_numbers() {
        let e = PlotError::RasterSize { given: 5, nx: 2, ny: 3 };
        assert_eq!(e.to_string(), "a raster of 2 x 3 cells needs 6 class indices, 5 were given");
    }
}
