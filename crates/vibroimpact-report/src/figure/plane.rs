//! A plane of two axes with a cell around each point.

use crate::units::shown;
use crate::{ReportError, Units, Varied};
use vibroimpact_plot::FigureAxis;
use vibroimpact_study::{Axis, Values};

/// Maximum number of points along one axis of a figure.
const MOST: usize = 16_384;

/// One axis of a plane: its name and its values.
#[derive(Clone, Debug)]
pub struct PlaneAxis {
    name: String,
    values: Values,
}

/// The two axes of a plane. The first one is the abscissa and varies fastest.
#[derive(Clone, Debug)]
pub struct Plane {
    /// The abscissa.
    pub x: PlaneAxis,
    /// The ordinate.
    pub y: PlaneAxis,
}

impl Plane {
    /// The plane over two axes.
    pub(crate) fn of<V: Varied>(axes: &[Axis<V>], units: &Units) -> Result<Self, ReportError> {
        let [x, y] = axes else { return Err(ReportError::Axes(axes.len())) };
        Ok(Self { x: PlaneAxis::of(x, units)?, y: PlaneAxis::of(y, units)? })
    }
}

/// The one or two axes of a figure.
#[derive(Clone, Debug)]
pub enum Sides {
    /// The abscissa only.
    Line(PlaneAxis),
    /// Both.
    Plane(Plane),
}

impl Sides {
    /// The axes of a plan in the given units.
    ///
    /// # Errors
    /// As [`PlaneAxis::of`], and [`ReportError::Axes`] if there are not one or two axes.
    pub fn of<V: Varied>(axes: &[Axis<V>], units: &Units) -> Result<Self, ReportError> {
        match axes {
            [axis] => Ok(Self::Line(PlaneAxis::of(axis, units)?)),
            axes => Ok(Self::Plane(Plane::of(axes, units)?)),
        }
    }
}

/// Refuses an axis that is too long.
const fn short_enough(given: usize) -> Result<(), ReportError> {
    if given > MOST { Err(ReportError::Values { given, most: MOST }) } else { Ok(()) }
}

impl PlaneAxis {
    /// An axis with rising or falling values.
    ///
    /// # Errors
    /// [`ReportError::Order`] for values in another order.
    pub fn new(name: impl Into<String>, values: &Values) -> Result<Self, ReportError> {
        if !values.in_order() {
            return Err(ReportError::Order);
        }
        Ok(Self { name: name.into(), values: values.clone() })
    }

    /// The axis of a plan in the given units.
    ///
    /// # Errors
    /// [`ReportError::Order`] as for [`Self::new`], [`ReportError::Values`] for more than 16384 values, and
    /// [`ReportError::Plan`] if a value overflows in these units.
    pub fn of<V: Varied>(axis: &Axis<V>, units: &Units) -> Result<Self, ReportError> {
        short_enough(axis.over.count())?;
        Self::new(axis.vary.axis(units), &shown(&axis.over, axis.vary.unit(units))?)
    }

    /// The number of values.
    pub(crate) fn count(&self) -> usize {
        self.values.count()
    }

    /// Value number `k`.
    pub(crate) fn at(&self, k: usize) -> f64 {
        self.values.at(k)
    }

    /// The first and the last value, if the values are evenly spaced.
    pub(crate) fn even(&self) -> Option<(f64, f64)> {
        match &self.values {
            Values::Span(span) if !span.is_logarithmic() => Some(span.ends()),
            _ => None,
        }
    }

    pub(crate) fn logarithmic(&self) -> bool {
        matches!(&self.values, Values::Span(span) if span.is_logarithmic())
    }

    /// The edges of the cell around value number `k`.
    pub(crate) fn cell(&self, k: usize) -> (f64, f64) {
        let at = |k: usize| self.values.at(k);
        let (here, last) = (at(k), self.count() - 1);
        let between = |a: f64, b: f64| if self.logarithmic() { (a * b).sqrt() } else { f64::midpoint(a, b) };
        // the outermost cells are symmetric about their values
        let beyond = |inner: f64| {
            if self.logarithmic() { here * (here / inner) } else { here + (here - inner) }
        };
        let (before, after) = match (k > 0, k < last) {
            (true, true) => (between(at(k - 1), here), between(here, at(k + 1))),
            (true, false) => (between(at(k - 1), here), beyond(between(at(k - 1), here))),
            (false, true) => (beyond(between(here, at(k + 1))), between(here, at(k + 1))),
            (false, false) => (here - 0.5, here + 0.5),
        };
        (before.min(after), before.max(after))
    }

    /// The range from the outer edge of the first cell to that of the last one.
    pub(crate) fn range(&self) -> (f64, f64) {
        let (first, last) = (self.cell(0), self.cell(self.count() - 1));
        (first.0.min(last.0), first.1.max(last.1))
    }

    /// An axis that shows the outermost cells completely.
    pub(crate) fn axis(&self) -> FigureAxis {
        let (low, high) = self.range();
        let axis = FigureAxis::new(self.name.clone()).range(low, high);
        if self.logarithmic() { axis.log10() } else { axis }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_meet_and_cover() {
        for values in [
            Values::Span("0:4:5".parse().unwrap()),
            Values::Span("100:0.01:5:log".parse().unwrap()),
            Values::Listed(vec![0.0, 1.0, 10.0]),
        ] {
            let side = PlaneAxis::new("x", &values).unwrap();
            let mut cells: Vec<_> = (0..side.count()).map(|k| side.cell(k)).collect();
            cells.sort_by(|a, b| a.0.total_cmp(&b.0));
            assert!(cells.windows(2).all(|pair| (pair[0].1 - pair[1].0).abs() < 1e-12 * pair[0].1.abs().max(1.0)));
            assert!((0..side.count()).all(|k| side.cell(k).0 < values.at(k) && values.at(k) < side.cell(k).1));
        }
        assert!(PlaneAxis::new("x", &Values::Listed(vec![0.0, 2.0, 1.0])).is_err());
    }
}
