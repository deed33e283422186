//! Marks: what a panel shows, drawn in the order given.

pub(crate) mod guide;
pub(crate) mod line;
pub(crate) mod points;
pub(crate) mod raster;
pub(crate) mod rects;
pub(crate) mod region;
pub(crate) mod text;
mod thin;

use crate::canvas::{Canvas, Frame};
use guide::{HLine, VLine, Wall};
use line::Line;
use points::Points;
use raster::Raster;
use rects::Rects;
use region::Region;
use text::Text;

/// Anything a panel can show.
#[derive(Clone, Debug, PartialEq)]
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
    Region(Region),
    /// A label at a place.
    Text(Text),
    /// A line across the panel at one y.
    HLine(HLine),
    /// A line up the panel at one x.
    VLine(VLine),
    /// A stop, with the space behind it hatched.
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

            /// Hands every place this mark wants to be seen to the two collectors.
            pub(crate) fn extent(&self, x: &mut Extent, y: &mut Extent) {
                match self {
                    $(Self::$kind(mark) => mark.extent(x, y),)*
                }
            }
        }
    };
}

marks!(Line, Points, Raster, Rects, Region, Text, HLine, VLine, Wall);

/// The smallest and largest finite value seen.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Extent {
    range: Option<(f64, f64)>,
    /// For a logarithmic axis only positive values count.
    positive: bool,
}

impl Extent {
    pub(crate) fn new(positive: bool) -> Self {
        Self { range: None, positive }
    }

    pub(crate) fn see(&mut self, value: f64) {
        if value.is_finite() && (!self.positive || value > 0.0) {
            let (lo, hi) = self.range.unwrap_or((value, value));
            self.range = Some((lo.min(value), hi.max(value)));
        }
    }

    pub(crate) fn see_all(&mut self, values: &[f64]) {
        for &value in values {
            self.see(value);
        }
    }

    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        self.range
    }
}

#[cfg(test)]
mod tests {
    use super::Extent;

    #[test]
    fn extents_skip_what_cannot_be_shown() {
        let mut all = Extent::new(false);
        all.see_all(&[f64::NAN, 2.0, f64::INFINITY, -1.0]);
        assert_eq!(all.range(), Some((-1.0, 2.0)));
        let mut positive = Extent::new(true);
        positive.see_all(&[0.0, -3.0]);
        assert_eq!(positive.range(), None);
    }
}
