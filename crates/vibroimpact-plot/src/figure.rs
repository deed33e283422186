//! A figure: panels in a grid, a title and a legend.

use crate::legend::Legend;
use crate::panel::Panel;
use crate::theme;

/// A figure: panels, a title and a legend.
#[derive(Clone, Debug, PartialEq)]
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
        Self { width, height, title: None, panels, columns, legend: None, id: "vp-".into() }
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

    /// Sets the prefix of ids.
    #[must_use]
    pub fn id(self, prefix: impl Into<String>) -> Self {
        Self { id: prefix.into(), ..self }
    }
}
