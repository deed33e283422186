//! Sizes in figure units.
//!
//! A figure of 680 units is intended for a column of 85 mm, so one unit is 1/8 mm or 0.354 pt. The smallest text, 20
//! units, prints at 7.1 pt, as journals require. A double column of 170 mm is 1360 units with the same sizes of text.

/// Width of a figure in a single column (85 mm).
pub const COLUMN: f64 = 680.0;

/// Width of a figure across two columns (170 mm).
pub const DOUBLE_COLUMN: f64 = 1360.0;

/// Figure units in a millimetre on paper.
pub const UNITS_PER_MM: f64 = 8.0;

/// Pixels per unit for 300 dpi at the nominal width: 680 units become 1004 pixels.
pub const DPI_300: f64 = 300.0 / 25.4 / UNITS_PER_MM;

/// Font size of numbers at ticks.
pub(crate) const TICK_TEXT: f64 = 20.0;
/// Font size of axis labels.
pub(crate) const LABEL_TEXT: f64 = 23.0;
/// Font size of panel captions.
pub(crate) const CAPTION_TEXT: f64 = 22.0;
/// Font size of the title of a figure.
pub(crate) const TITLE_TEXT: f64 = 24.0;
/// Font size of legend entries.
pub(crate) const LEGEND_TEXT: f64 = 20.0;
/// Font size of labels inside a panel.
pub(crate) const MARK_TEXT: f64 = 22.0;

/// Length of a labelled tick; the others are half as long.
pub(crate) const TICK: f64 = 7.0;
/// Distance between a tick and its number.
pub(crate) const TICK_GAP: f64 = 6.0;
/// Width of frames and ticks.
pub(crate) const FRAME: f64 = 1.6;
/// Margin around the figure.
pub(crate) const MARGIN: f64 = 10.0;
/// Distance between panels, and between panels and legend.
pub(crate) const GAP: f64 = 20.0;
