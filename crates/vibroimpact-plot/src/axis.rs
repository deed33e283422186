//! An axis: its label, range, scale and ticks.

use crate::scale::Scale;
use crate::ticks::{Tick, ticks};
use serde::Serialize;

/// One axis of a panel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureAxis {
    /// Its name, in the markup of [labels](crate::plain): `"1/*β*"`.
    pub label: String,
    /// First and last value, from left to right or bottom to top; `first > last` reverses the axis. `None` fits the
    /// range to the marks.
    pub range: Option<(f64, f64)>,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Explicit ticks; `None` computes them.
    pub ticks: Option<Vec<Tick>>,
    /// Whether ticks have numbers (not for the upper one of two stacked panels).
    pub numbers: bool,
}

impl FigureAxis {
    /// A linear axis that fits its data.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: None, scale: Scale::Linear, ticks: None, numbers: true }
    }

    /// Shows exactly `first` to `last`.
    #[must_use]
    pub fn range(self, first: f64, last: f64) -> Self {
        Self { range: Some((first, last)), ..self }
    }

    /// Uses a decimal logarithmic scale.
    #[must_use]
    pub fn log10(self) -> Self {
        Self { scale: Scale::Log10, ..self }
    }

    /// Places labelled ticks at these values only.
    #[must_use]
    pub fn ticks(self, ticks: impl IntoIterator<Item = Tick>) -> Self {
        Self { ticks: Some(ticks.into_iter().collect()), ..self }
    }

    /// The range to draw: finite, not empty, and positive on a logarithmic axis, whatever range was given. `data` are
    /// the extremes of the marks.
    pub(crate) fn resolve(&self, data: Option<(f64, f64)>) -> (f64, f64) {
        let finite = |(lo, hi): &(f64, f64)| lo.is_finite() && hi.is_finite();
        let given = self.range.filter(finite);
        let fitted = data.filter(finite);
        let air = if given.is_none() && fitted.is_some() { PADDING } else { 0.0 };
        let (lo, hi) = given.or(fitted).unwrap_or((0.0, 1.0));
        match self.scale {
            Scale::Linear => {
                let (lo, hi) = (lo.clamp(-1e300, 1e300), hi.clamp(-1e300, 1e300));
                let size = lo.abs().max(hi.abs());
                // fitted to the marks, a range that is one value within rounding would show rounding as structure; a given
                // one has no room for a second tick
                let (relative, zero) = if given.is_none() { (ROUNDING, ROUNDED_ZERO) } else { (1e-14, 1e-300) };
                let pad = if (hi - lo).abs() <= (relative * size).max(zero) {
                    // a single value is placed in the middle of a range of its own size
                    if size <= zero { 1.0 } else { size / 2.0 }
                } else {
                    (hi - lo) * air
                };
                (lo - pad, hi + pad)
            }
            Scale::Log10 => {
                let (turn, lo, hi) = (lo > hi, lo.min(hi), lo.max(hi));
                let hi = if hi > 1e-300 { hi.min(1e300) } else { 1.0 };
                // without a positive lower end, three decades are shown
                let lo = if lo > 1e-303 { lo } else { hi / 1e3 };
                let factor = if lo >= hi { 10f64.sqrt() } else { (hi / lo).powf(air) };
                let (lo, hi) = (lo.min(hi) / factor, hi * factor);
                if turn { (hi, lo) } else { (lo, hi) }
            }
        }
    }

    /// The ticks to draw within a range, with room for `most` labels.
    pub(crate) fn resolve_ticks(&self, (lo, hi): (f64, f64), most: usize) -> Vec<Tick> {
        let mut list = match &self.ticks {
            Some(own) => own.clone(),
            None => ticks(self.scale, lo, hi, most),
        };
        let slack = 1e-9 * (hi - lo).abs();
        list.retain(|t| t.value >= lo.min(hi) - slack && t.value <= lo.max(hi) + slack);
        if !self.numbers {
            // the long marks stay: a blank is a label without visible text
            for tick in list.iter_mut().filter(|t| !t.label.is_empty()) {
                tick.label = " ".into();
            }
        }
        list
    }
}

/// Values that differ by less than this part of their size are equal to rounding, for an axis that fits its data.
const ROUNDING: f64 = 1e-12;
/// Values of at most this size are 0 to rounding, for an axis that fits its data.
const ROUNDED_ZERO: f64 = 1e-14;
/// Margin at each end of an axis that fits its data, relative to its length.
const PADDING: f64 = 0.04;

/// A resolved axis: data value to page coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mapping {
    pub(crate) scale: Scale,
    pub(crate) range: (f64, f64),
    /// Page coordinates of the two ends of the range.
    pub(crate) page: (f64, f64),
}

impl Mapping {
    /// The page coordinate of a value; `NaN` if it has none.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let (lo, hi) = self.range;
        let t = match self.scale {
            Scale::Linear => (value - lo) / (hi - lo),
            Scale::Log10 if value > 0.0 => (value / lo).log10() / (hi / lo).log10(),
            Scale::Log10 => f64::NAN,
        };
        // limit positions far beyond the page, which could overflow in renderers with f32
        (self.page.0 + t * (self.page.1 - self.page.0)).clamp(-1e6, 1e6)
    }

    /// The position of an end of an interval. On a logarithmic axis, an end at or below zero is placed at the low end.
    pub(crate) fn edge(&self, value: f64) -> f64 {
        if self.scale == Scale::Log10 && value <= 0.0 {
            if self.range.0 < self.range.1 { self.page.0 } else { self.page.1 }
        } else {
            self.at(value)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_range_becomes_drawable() {
        let bad = [f64::NAN, f64::INFINITY, -1e308, -1.0, 0.0, 5e-324, 1.0, 1e308];
        for lo in bad {
            for hi in bad {
                for axis in [FigureAxis::new("").range(lo, hi), FigureAxis::new("").range(lo, hi).log10()] {
                    let (a, b) = axis.resolve(Some((hi, lo)));
                    assert!(a.is_finite() && b.is_finite() && a != b, "{lo} {hi}: {a} {b}");
                    let mapping = Mapping { scale: axis.scale, range: (a, b), page: (0.0, 100.0) };
                    assert!(mapping.at(a).abs() < 1e-6, "{lo} {hi}: {a} {b}");
                    assert!(axis.resolve_ticks((a, b), 5).len() < 100);
                }
            }
        }
    }

    #[test]
    fn rounding_is_not_drawn_as_structure() {
        let fitted = |lo, hi| FigureAxis::new("").resolve(Some((lo, hi)));
        assert_eq!(fitted(-1e-16, 2e-16), (-1.0 - 1e-16, 1.0 + 2e-16));
        assert_eq!(fitted(0.8, 0.8 + 1e-14), (0.8 - (0.8 + 1e-14) / 2.0, (0.8 + 1e-14) * 1.5));
        // a range that was given is one that was meant
        assert_eq!(FigureAxis::new("").range(0.0, 1e-16).resolve(None), (0.0, 1e-16));
    }

    #[test]
    fn given_ranges_are_kept_and_fitted_ones_get_air() {
        assert_eq!(FigureAxis::new("").range(2.0, 0.0).resolve(None), (2.0, 0.0));
        assert_eq!(FigureAxis::new("").resolve(Some((0.0, 100.0))), (-4.0, 104.0));
        assert_eq!(FigureAxis::new("").resolve(None), (0.0, 1.0));
    }

    #[test]
    fn log_mapping() {
        let m = Mapping { scale: Scale::Log10, range: (0.1, 10.0), page: (0.0, 100.0) };
        assert!((m.at(1.0) - 50.0).abs() < 1e-12);
        assert!(m.at(0.0).is_nan() && m.at(-1.0).is_nan());
        assert_eq!(m.edge(0.0), 0.0);
    }
}
