//! The errors of figures, as data; `Display` makes the message.

/// A reason why a figure could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// The number of class indices is not `nx * ny`.
    #[error("a raster of {nx} x {ny} cells needs {} class indices, {given} were given", nx.saturating_mul(*ny))]
    RasterSize {
        /// Number of class indices given.
        given: usize,
        /// Number of columns.
        nx: usize,
        /// Number of rows.
        ny: usize,
    },
    /// The image would have no pixels, or more than the allowed number.
    #[error(
        "an image of {width} x {height} pixels lies outside 1..={MAX_SIDE} on a side\nhint: scale is pixels per figure unit; 1.476 gives 300 dpi"
    )]
    ImageSize {
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// A page of this size cannot be written.
    #[error("a page of {width} x {height} mm cannot be written")]
    PageSize {
        /// Width in millimetres.
        width: f64,
        /// Height in millimetres.
        height: f64,
    },
    /// A figure of this size has no room for its panels.
    #[error(
        "a figure of {width} x {height} mm has no room for its axes and its legend\nhint: the usual figure of one column is 85 mm wide and 60 mm high"
    )]
    NoRoom {
        /// Width in millimetres.
        width: f64,
        /// Height in millimetres.
        height: f64,
    },
    /// The renderer refused the SVG text: a defect of this crate.
    #[error("the renderer refused the figure's SVG text: {0}")]
    Svg(String),
    /// The PNG encoder failed: a defect of this crate.
    #[error("the figure could not be encoded as PNG: {0}")]
    Png(String),
    /// The writer of PDF failed: a defect of this crate.
    #[error("the figure could not be written as PDF: {0}")]
    Pdf(String),
}

/// The longest side of a PNG, in pixels: 170 mm at 2400 dpi.
pub(crate) const MAX_SIDE: f64 = 16_384.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_name_the_numbers() {
        let e = PlotError::RasterSize { given: 5, nx: 2, ny: 3 };
        assert_eq!(e.to_string(), "a raster of 2 x 3 cells needs 6 class indices, 5 were given");
    }
}
