//! Marks: the contents of a panel, drawn in the given order.

pub(crate) mod extent;
pub(crate) mod guide;
pub(crate) mod line;
pub(crate) mod points;
pub(crate) mod raster;
pub(crate) mod rects;
pub(crate) mod region;
pub(crate) mod text;
mod thin;

use crate::canvas::{Canvas, Frame};
use extent::Extent;
use guide::{HLine, VLine, Wall};
use line::Line;
use points::Points;
use raster::Raster;
use rects::Rects;
use region::FilledRegion;
use serde::Serialize;
use text::Text;

/// A mark of any kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Mark {
    /// A polyline.
    Line(Line),
    /// Separate points.
    Points(Points),
    /// A grid of class indices.
    Raster(Raster),
    /// Rectangles with a class each.
    Rects(Rects),
    /// An area with holes.
    FilledRegion(FilledRegion),
    /// A label at a point.
    Text(Text),
    /// A horizontal line across the panel.
    HLine(HLine),
    /// A vertical line across the panel.
    VLine(VLine),
    /// A stop, with the area behind it hatched.
    Wall(Wall),
}

macro_rules! marks {
    ($($kind:ident),*) => {
        $(impl From<$kind> for Mark {
            fn from(mark: $kind) -> Self {
                Self::$kind(mark)
            }
        })*

        impl Mark {
            pub(crate) fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
                match self {
                    $(Self::$kind(mark) => mark.draw(canvas, frame),)*
                }
            }

            /// Passes every point that should be visible to the two collectors.
            pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
                match self {
                    $(Self::$kind(mark) => mark.extent(x, y),)*
                }
            }
        }
    };
}

marks!(Line, Points, Raster, Rects, FilledRegion, Text, HLine, VLine, Wall);
