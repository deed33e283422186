//! Sizes in figure units.
//!
//! A figure of 680 units is meant for a column of 85 mm, so one unit is 1/8 mm or 0.354 pt: the
//! smallest text, 20 units, prints at 7.1 pt, which is what journals ask for. A double column of
//! 170 mm is 1360 units with the same sizes.

/// Width of a figure in a single column (85 mm).
pub const COLUMN: f64 = 680.0;

/// Width of a figure across two columns (170 mm).
pub const DOUBLE_COLUMN: f64 = 1360.0;

/// Pixels per unit that give 300 dpi at the nominal width: 680 units become 1004 pixels.
pub const DPI_300: f64 = 300.0 / 25.4 / 8.0;

/// Numbers at ticks.
pub(crate) const TICK_TEXT: f64 = 20.0;
/// Axis labels.
pub(crate) const LABEL_TEXT: f64 = 23.0;
/// Panel captions.
pub(crate) const CAPTION_TEXT: f64 = 22.0;
/// The figure's title.
pub(crate) const TITLE_TEXT: f64 = 24.0;
/// Legend entries.
pub(crate) const LEGEND_TEXT: f64 = 20.0;
/// Labels inside a panel.
pub(crate) const MARK_TEXT: f64 = 22.0;

/// Length of a labelled tick; the others are half as long.
pub(crate) const TICK: f64 = 7.0;
/// Between a tick and its number.
pub(crate) const TICK_GAP: f64 = 6.0;
/// Width of frames and ticks.
pub(crate) const FRAME: f64 = 1.6;
/// Air around everything.
pub(crate) const MARGIN: f64 = 10.0;
/// Air between panels, and between panels and legend.
pub(crate) const GAP: f64 = 20.0;
