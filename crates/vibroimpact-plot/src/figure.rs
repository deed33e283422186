//! A figure: panels in a grid, a title and a legend.

use crate::colour_bar::ColourBar;
use crate::error::PlotError;
use crate::legend::Legend;
use crate::panel::Panel;
use crate::theme::{self, UNITS_PER_MM};
use serde::Serialize;

/// A figure: panels, a title and a legend.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// Width in figure units; see [`COLUMN`](crate::COLUMN).
    pub width: f64,
    /// Height of title and panels in figure units; a legend below adds to it.
    pub height: f64,
    /// A line of text above everything.
    pub title: Option<String>,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
    /// Number of panels in a row.
    pub columns: usize,
    /// The legend.
    pub legend: Option<Legend>,
    /// The colours of a continuous quantity, to the right of the panels.
    pub colour_bar: Option<ColourBar>,
    /// Whether all colours are replaced by greys of equal luminance.
    pub grey: bool,
    /// Whether the SVG text states its size in millimetres, at 1/8 mm for each figure unit, and not in pixels.
    pub millimetres: bool,
    /// Prefix of the ids in the SVG text; it must differ between figures on one web page.
    pub id: String,
}

impl Figure {
    /// A figure of one panel, 85 mm wide in print (680 by 480 units).
    #[must_use]
    pub fn new(panel: Panel) -> Self {
        Self::grid(1, vec![panel])
    }

    /// Panels row by row, `columns` in a row. One column is 85 mm wide in print, more are 170 mm.
    #[must_use]
    pub fn grid(columns: usize, panels: Vec<Panel>) -> Self {
        let columns = columns.max(1);
        let rows = panels.len().div_ceil(columns).max(1);
        let (width, height) = if columns == 1 {
            (theme::COLUMN, if rows == 1 { 480.0 } else { 330.0 * rows as f64 })
        } else {
            (theme::DOUBLE_COLUMN, 480.0 * rows as f64)
        };
        Self {
            width,
            height,
            title: None,
            panels,
            columns,
            legend: None,
            colour_bar: None,
            grey: false,
            millimetres: false,
            id: "vp-".into(),
        }
    }

    /// Sets the size in figure units (1/8 mm in print).
    #[must_use]
    pub fn size(self, width: f64, height: f64) -> Self {
        Self { width, height, ..self }
    }

    /// Sets the title.
    #[must_use]
    pub fn title(self, markup: impl Into<String>) -> Self {
        Self { title: Some(markup.into()), ..self }
    }

    /// Sets the legend.
    #[must_use]
    pub fn legend(self, legend: Legend) -> Self {
        Self { legend: Some(legend), ..self }
    }

    /// Sets the colour bar.
    #[must_use]
    pub fn colour_bar(self, bar: ColourBar) -> Self {
        Self { colour_bar: Some(bar), ..self }
    }

    /// Sets the size of the whole figure, with its legend, in millimetres on paper. Text, lines and marks keep their sizes.
    ///
    /// # Errors
    /// [`PlotError::NoRoom`] if no frame of at least 10 mm on each side remains.
    pub fn fit(self, width: f64, height: f64) -> Result<Self, PlotError> {
        let refuse = || PlotError::NoRoom { width, height };
        let (wide, high) = (width * UNITS_PER_MM, height * UNITS_PER_MM);
        if !(wide.is_finite() && high.is_finite() && wide > 0.0 && high > 0.0) {
            return Err(refuse());
        }
        let mut figure = Self { width: wide, height: high, millimetres: true, ..self };
        // a legend below adds to the height of the panels
        figure.height -= figure.outer_size().1 - high;
        let (least, outer) = (10.0 * UNITS_PER_MM, figure.outer_size());
        let fits = (outer.0 - wide).abs() < 1e-6 && (outer.1 - high).abs() < 1e-6;
        if fits && figure.smallest_frame().is_none_or(|(w, h)| w >= least && h >= least) {
            Ok(figure)
        } else {
            Err(refuse())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FigureAxis, Points, SERIES, class_style};

    fn figure() -> Figure {
        let points = Points::new([0.5], [0.5], SERIES[1]);
        let legend = Legend::below().patch(class_style("1/1"), "1/1").points(&points, "a point");
        Figure::new(Panel::new(FigureAxis::new("x"), FigureAxis::new("y")).with(points)).legend(legend).title("t")
    }

    #[test]
    fn the_size_on_paper_includes_the_legend_and_changes_no_mark() -> Result<(), PlotError> {
        let mark = |svg: &str| svg.split_once("a4.5 4.5").map(|_| ());
        for (width, height) in [(85.0, 60.0), (170.0, 100.0), (60.0, 45.0)] {
            let small = figure().fit(width, height)?;
            let outer = small.outer_size();
            assert!((outer.0 - 8.0 * width).abs() < 1e-9 && (outer.1 - 8.0 * height).abs() < 1e-9, "{outer:?}");
            let svg = small.to_svg();
            assert!(svg.contains(&format!("width=\"{width}mm\" height=\"{height}mm\"")), "{svg}");
            assert_eq!((mark(&svg), mark(&figure().to_svg())), (Some(()), Some(())), "{svg}");
        }
        for (width, height) in [(20.0, 60.0), (85.0, 20.0), (f64::NAN, 3.0), (-1.0, 60.0)] {
            assert!(matches!(figure().fit(width, height), Err(PlotError::NoRoom { .. })), "{width} {height}");
        }
        Ok(())
    }

    #[test]
    fn a_grey_figure_has_no_colour_left() -> Result<(), PlotError> {
        let raster = crate::Raster::new((0.0, 1.0), (0.0, 1.0), (2, 1), [0, 1], [SERIES[0], SERIES[1]])?;
        let mut colourful = figure().colour_bar(ColourBar::new(FigureAxis::new("").range(0.0, 1.0)));
        colourful.panels[0].add(raster);
        let coloured = |figure: &Figure| -> Result<bool, PlotError> {
            let png = figure.to_png(0.5)?;
            let picture = resvg::tiny_skia::Pixmap::decode_png(&png).map_err(|e| PlotError::Png(e.to_string()))?;
            Ok(picture.pixels().iter().any(|p| p.red() != p.green() || p.green() != p.blue()))
        };
        assert!(coloured(&colourful)? && !coloured(&Figure { grey: true, ..colourful.clone() })?);
        // a title is text, not a colour
        assert!(Figure { grey: true, ..figure().title("#d55e00 ok") }.to_svg().contains("#d55e00 ok"));
        Ok(())
    }
}
