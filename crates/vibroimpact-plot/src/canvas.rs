//! The canvas that marks draw on: SVG text and the definitions to which it refers.

use std::collections::BTreeSet;

use crate::axis::Mapping;
use crate::colour_map::colour_at;
use crate::hatch::Hatch;
use crate::number::N;

/// SVG text under construction.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    pub(crate) body: String,
    /// Prefix of every id, so that two figures can share one web page.
    pub(crate) prefix: String,
    /// Whether images are grey; the colours of the other marks become grey in the text.
    pub(crate) grey: bool,
    hatches: BTreeSet<Hatch>,
    clips: String,
    /// Whether a colour bar needs the gradient of its colours.
    gradient: bool,
}

impl Canvas {
    pub(crate) fn new(prefix: &str) -> Self {
        Self { prefix: prefix.to_owned(), ..Self::default() }
    }

    pub(crate) fn push(&mut self, svg: &str) {
        self.body.push_str(svg);
    }

    /// The paint of a hatch, whose definition is added once.
    pub(crate) fn hatch(&mut self, hatch: Hatch) -> String {
        self.hatches.insert(hatch);
        format!("url(#{}{})", self.prefix, hatch.id())
    }

    /// The paint of the continuous colours from the lower to the upper edge, whose definition is added once.
    pub(crate) fn gradient(&mut self) -> String {
        self.gradient = true;
        format!("url(#{}colours)", self.prefix)
    }

    pub(crate) fn define_clip(&mut self, frame: &Frame) {
        self.clips.push_str(&format!("<clipPath id=\"{}{}\">{}</clipPath>\n", self.prefix, frame.clip, frame.rect("")));
    }

    /// The attribute that clips a mark at the axes.
    pub(crate) fn clip(&self, frame: &Frame) -> String {
        format!(" clip-path=\"url(#{}{})\"", self.prefix, frame.clip)
    }

    /// All definitions.
    pub(crate) fn definitions(&self) -> String {
        let hatches: String = self.hatches.iter().map(|h| h.definition(&self.prefix)).collect();
        let gradient = if self.gradient { gradient(&self.prefix) } else { String::new() };
        format!("{}{hatches}{gradient}", self.clips)
    }
}

/// The stops of the gradient: between two of them a straight line in sRGB differs from the map by less than an eye can see.
const STOPS: u32 = 32;

/// The definition of the gradient of continuous colours.
fn gradient(prefix: &str) -> String {
    let stop = |k: u32| {
        let place = f64::from(k) / f64::from(STOPS);
        format!("<stop offset=\"{}\" stop-color=\"{}\"/>", place, colour_at(place).to_hex())
    };
    let stops: String = (0..=STOPS).map(stop).collect();
    format!("<linearGradient id=\"{prefix}colours\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">{stops}</linearGradient>\n")
}

/// The inside of a panel's axes, in page coordinates (y downwards).
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) x: Mapping,
    pub(crate) y: Mapping,
    pub(crate) clip: String,
}

impl Frame {
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// The page coordinates of a data point.
    pub(crate) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.x.at(x), self.y.at(y))
    }

    /// Whether a point of the page lies inside, with a small tolerance for points on the edge.
    pub(crate) fn holds(&self, (x, y): (f64, f64)) -> bool {
        let slack = 0.5;
        x >= self.left - slack && x <= self.right() + slack && y >= self.top - slack && y <= self.bottom() + slack
    }

    /// The frame itself as an SVG element.
    pub(crate) fn rect(&self, attributes: &str) -> String {
        let Self { left, top, width, height, .. } = *self;
        let (x, y, w, h) = (N(left), N(top), N(width), N(height));
        format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"{attributes}/>")
    }

    /// The part of a data rectangle inside the frame, as left, top, right, bottom on the page.
    pub(crate) fn cut(&self, x: (f64, f64), y: (f64, f64)) -> Option<[f64; 4]> {
        let (a, b) = (self.x.edge(x.0), self.x.edge(x.1));
        let (c, d) = (self.y.edge(y.0), self.y.edge(y.1));
        if [a, b, c, d].iter().any(|v| v.is_nan()) {
            return None;
        }
        let (left, right) = (a.min(b).max(self.left), a.max(b).min(self.right()));
        let (top, bottom) = (c.min(d).max(self.top), c.max(d).min(self.bottom()));
        (left < right && top < bottom).then_some([left, top, right, bottom])
    }
}

/// A frame of 100 by 100 units at the origin over these ranges.
#[cfg(test)]
pub(crate) fn test_frame(x: (f64, f64), y: (f64, f64)) -> Frame {
    let scale = crate::scale::Scale::Linear;
    Frame {
        left: 0.0,
        top: 0.0,
        width: 100.0,
        height: 100.0,
        x: Mapping { scale, range: x, page: (0.0, 100.0) },
        y: Mapping { scale, range: y, page: (100.0, 0.0) },
        clip: "clip0".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_are_cut_at_the_frame() {
        let frame = test_frame((0.0, 10.0), (0.0, 10.0));
        assert_eq!(frame.cut((-5.0, 5.0), (5.0, 50.0)), Some([0.0, 0.0, 50.0, 50.0]));
        assert_eq!(frame.cut((11.0, 12.0), (0.0, 1.0)), None);
        assert_eq!(frame.cut((f64::NAN, 1.0), (0.0, 1.0)), None);
        assert!(frame.holds(frame.at(10.0, 0.0)) && !frame.holds(frame.at(f64::NAN, 0.0)));
    }
}
