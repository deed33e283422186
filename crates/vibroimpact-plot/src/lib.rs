//! Figures of vibro-impact dynamics: from slices to SVG text or PNG bytes.
//!
//! A [`Figure`] is plain data: [`Panel`]s with two [`FigureAxis`] each, marks drawn in the given order, and a
//! [`Legend`] below the panels that never covers data. [`Figure::to_svg`] and [`Figure::to_png`] read no
//! files, start no threads, use no fonts of the machine, and give the same bytes for the same figure.
//!
//! ```
//! use vibroimpact_plot::{FigureAxis, Figure, Legend, Line, Panel, SERIES, TextSide, Wall};
//!
//! let xs: Vec<f64> = (0..100).map(|i| f64::from(i) / 10.0).collect();
//! let ys: Vec<f64> = xs.iter().map(|x| x.sin()).collect();
//! let line = Line::new(xs, ys, SERIES[0]);
//! let legend = Legend::below().line(line.stroke, "response");
//! let panel = Panel::new(FigureAxis::new("*τ*"), FigureAxis::new("*ξ*"))
//!     .with(line)
//!     .with(Wall::new(1.0, TextSide::Above));
//! let svg = Figure::new(panel).legend(legend).to_svg();
//! assert!(svg.starts_with("<svg"));
//! ```
//!
//! Lengths are in figure units of 1/8 mm at the nominal print width: [`COLUMN`] is 85 mm, [`DOUBLE_COLUMN`] 170 mm, and
//! the smallest text prints at 7 pt. Values that cannot be shown (`NaN`, infinities, non-positive values on a
//! logarithmic axis) are left out; an empty range is widened. Labels are written in a [small markup](plain): `"1/*β*"`,
//! `"*ξ*_0"`.
//!
//! [`class_style`] gives each group of motions one colour and hatch in all figures. They are suitable for colour-blind
//! readers and grey print.

mod axis;
mod canvas;
mod colour;
mod colour_bar;
mod colour_map;
mod error;
mod figure;
mod furniture;
mod grey;
mod hatch;
mod label;
mod layout;
mod legend;
mod mark;
mod markup;
mod metrics;
mod number;
mod palette;
mod panel;
mod pdf;
mod render;
mod resolution;
mod scale;
mod stroke;
mod svg;
mod theme;
mod ticks;
mod vision;

pub use axis::FigureAxis;
pub use colour::Colour;
pub use colour_bar::ColourBar;
pub use colour_map::{COLOUR_STEPS, colour_at};
pub use error::PlotError;
pub use figure::Figure;
pub use hatch::{Hatch, Pattern};
pub use label::Anchor;
pub use legend::{Entry, Key, Legend};
pub use mark::Mark;
pub use mark::guide::{HLine, TextSide, VLine, Wall};
pub use mark::line::Line;
pub use mark::points::{PointStyle, Points, Shape};
pub use mark::raster::Raster;
pub use mark::rects::{Rect, Rects};
pub use mark::region::FilledRegion;
pub use mark::text::Text;
pub use markup::plain;
pub use palette::{
    ClassStyle, GROUP_RULES, GROUPS, GroupRule, SERIES, SHADES, class_style, legend_group, legend_text, unforced,
};
pub use panel::Panel;
pub use scale::Scale;
pub use stroke::{Dash, Stroke};
pub use theme::{COLUMN, DOUBLE_COLUMN, DPI_300, UNITS_PER_MM};
pub use ticks::Tick;
pub use vision::Vision;
