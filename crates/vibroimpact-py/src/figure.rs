//! Figures of Datasets as JSON: the motions at the points of a grid and elsewhere, and orbit diagrams. Names of axes and titles are
//! those of the Dataset.

use crate::error::Trouble;
use crate::plan::text;
use numpy::{PyReadonlyArray1, PyReadonlyArray3};
use pyo3::prelude::*;
use std::borrow::Cow;
use vibroimpact_plot::{FigureAxis, class_style};
use vibroimpact_report::figure::cells::Cells;
use vibroimpact_report::figure::coloured::{self, Coloured, Of};
use vibroimpact_report::figure::diagram::{self, Motion};
use vibroimpact_report::figure::plane::{Plane, PlaneAxis, Sides};
use vibroimpact_report::figure::{map, scattered, shares};
use vibroimpact_report::{AnswerError, ReportError};
use vibroimpact_study::diagram::{Sweep, SweepDirection};
use vibroimpact_study::study::label_of;
use vibroimpact_study::{Span, Values};

/// Allowed deviation from even spacing, relative to the values.
const EVEN: f64 = 1e-12;

/// The values of an axis: a range, if they are evenly spaced or in equal ratios to rounding.
fn spaced(given: &[f64]) -> Values {
    let listed = || Values::Listed(given.to_vec());
    let (Some(first), Some(last), Ok(count)) = (given.first(), given.last(), u32::try_from(given.len())) else {
        return listed();
    };
    let size = EVEN * given.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let near = |span: &Span| given.iter().zip(0..).all(|(value, k)| (value - span.at(k)).abs() <= size);
    let spans = [Span::new(*first, *last, count), Span::logarithmic(*first, *last, count)];
    spans.into_iter().flatten().find(near).map_or_else(listed, Values::Span)
}

fn side(values: &PyReadonlyArray1<'_, f64>) -> Result<PlaneAxis, Trouble> {
    Ok(PlaneAxis::new("", &spaced(&values.as_array().to_vec())).map_err(AnswerError::from)?)
}

/// A column of a Dataset.
type Column<'py, T> = PyReadonlyArray1<'py, T>;
/// Shares, numbers of cycles, and whether each point was computed itself.
type Further<'py> = (Option<Column<'py, f64>>, Option<Column<'py, i32>>, Option<Column<'py, i8>>);

/// The figure of motions over one or two axes, the abscissa first. Given are codes of labels, with their number at each point;
/// shares, numbers of cycles and whether each point was computed itself, if there are any; and the values of a quantity, which of
/// several motions has the colour, and the name of the quantity.
#[pyfunction]
pub(crate) fn cells_figure(
    axes: Vec<Column<'_, f64>>,
    labels: Column<'_, i32>,
    width: usize,
    further: Further<'_>,
    quantity: Option<(Column<'_, f64>, String, String)>,
) -> Result<String, Trouble> {
    let sides = match axes.as_slice() {
        [x] => Sides::Line(side(x)?),
        [x, y] => Sides::Plane(Plane { x: side(x)?, y: side(y)? }),
        axes => return Err(AnswerError::from(ReportError::Axes(axes.len())).into()),
    };
    let (labels, shares) = (labels.as_array().to_vec(), further.0.map(|of| of.as_array().to_vec()));
    let (cycles, computed) = (further.1.map(|of| of.as_array().to_vec()), further.2.map(|of| of.as_array().to_vec()));
    let cells = Cells {
        labels: &labels,
        width,
        shares: shares.as_deref(),
        cycles: cycles.as_deref(),
        computed: computed.as_deref(),
    };
    let figure = match (quantity, &sides) {
        (Some((values, of, name)), _) => {
            let values = values.as_array().to_vec();
            let of = Of::from_name(&of).unwrap_or_default();
            let points = cells.points(Some((&values, &|_| 1.0)));
            coloured::of_points(
                &sides,
                &points,
                &Coloured { field: String::new(), of, range: None },
                (name, String::new()),
            )
        }
        (None, _) if cycles.is_some() => cells.basin(&sides, String::new()),
        (None, Sides::Line(side)) => Ok(shares::draw(side, &cells.points(None), String::new())),
        (None, Sides::Plane(plane)) => map::draw_with(plane, &cells.points(None), String::new(), (true, false)),
    };
    text(&figure.map_err(AnswerError::from)?)
}

/// The figure of motions at places that are no grid, by the codes of their labels.
#[pyfunction]
pub(crate) fn scattered_figure(
    xs: Column<'_, f64>,
    ys: Column<'_, f64>,
    labels: Column<'_, i32>,
) -> Result<String, Trouble> {
    let (xs, ys, labels) = (xs.as_array(), ys.as_array(), labels.as_array());
    let places = xs.iter().copied().zip(ys.iter().copied()).zip(labels);
    let motions = places.filter_map(|(place, code)| Some((place, Cow::Owned(label_of(*code)?))));
    text(&scattered::draw((FigureAxis::new(""), FigureAxis::new("")), xs.len(), motions))
}

/// The figure of an orbit diagram: points by run, value and number, not-a-number where there is none. `ways` are 1 and -1 for sweeps
/// with rising and falling values of the parameter with this symbol; there are none for scattered starts. A motion with fewer points
/// than `keep` repeats.
#[pyfunction]
pub(crate) fn diagram_figure(
    over: Column<'_, f64>,
    points: PyReadonlyArray3<'_, f64>,
    ways: Vec<i8>,
    symbol: &str,
    keep: usize,
) -> Result<String, Trouble> {
    let (points, side) = (points.as_array(), side(&over)?);
    let direction = match ways.as_slice() {
        [] => SweepDirection::Scatter { starts: points.shape()[0] as u64, seed: 0 },
        [way] if *way < 0 => SweepDirection::Down,
        [_] => SweepDirection::Up,
        _ => SweepDirection::Both,
    };
    let mut motions = Vec::new();
    for (run, of) in points.outer_iter().enumerate() {
        let sweep = match ways.get(run) {
            None => Sweep::Start(run as u64),
            Some(way) if *way < 0 => Sweep::Down,
            Some(_) => Sweep::Up,
        };
        for (index, row) in (0..).zip(of.outer_iter()) {
            let ys: Vec<f64> = row.iter().copied().filter(|y| y.is_finite()).collect();
            motions.push(Motion { index, sweep, repeats: ys.len() < keep || ys.len() == 1, ys });
        }
    }
    let over = spaced(&over.as_array().to_vec());
    let figure = diagram::draw(&motions, (&over, direction, symbol), (&side, FigureAxis::new("")));
    text(&figure.map_err(AnswerError::from)?)
}

/// The colour of the label of a motion, the same in every figure.
#[pyfunction]
pub(crate) fn class_colour(label: &str) -> String {
    class_style(label).colour.to_hex()
}
