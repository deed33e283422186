//! Lists of Rust as columns of numpy, passed without a copy.

use numpy::{Complex64, IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use vibroimpact::Side;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::Cycle;

/// +1 for the first stop, -1 for the second.
pub(crate) const fn sign(side: Side) -> i8 {
    match side {
        Side::Upper => 1,
        Side::Lower => -1,
    }
}

/// The name of a side.
pub(crate) const fn named(side: Side) -> &'static str {
    match side {
        Side::Upper => "upper",
        Side::Lower => "lower",
    }
}

/// The impacts of one cycle, or of several cycles one after another.
#[derive(IntoPyObject)]
pub(crate) struct Impacts<'py> {
    phase: Bound<'py, PyArray1<f64>>,
    velocity_before: Bound<'py, PyArray1<f64>>,
    interval: Bound<'py, PyArray1<f64>>,
    side: Bound<'py, PyArray1<i8>>,
}

impl<'py> Impacts<'py> {
    pub(crate) fn new<'a>(py: Python<'py>, cycles: &(impl Iterator<Item = &'a Cycle> + Clone)) -> Self {
        let points = || cycles.clone().flat_map(|cycle| &cycle.points);
        Self {
            phase: column(py, points().map(|point| point.state.phase)),
            velocity_before: column(py, points().map(|point| point.state.velocity)),
            interval: column(py, points().map(|point| point.interval)),
            side: column(py, points().map(|point| sign(point.state.side))),
        }
    }
}

/// Values as an array.
pub(crate) fn column<T: numpy::Element>(py: Python<'_>, values: impl Iterator<Item = T>) -> Bound<'_, PyArray1<T>> {
    values.collect::<Vec<T>>().into_pyarray(py)
}

/// Pairs as an array of two columns.
pub(crate) fn pairs<T: numpy::Element>(
    py: Python<'_>,
    values: impl Iterator<Item = [T; 2]>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let flat: Vec<T> = values.flatten().collect();
    let rows = flat.len() / 2;
    flat.into_pyarray(py).reshape([rows, 2])
}

/// Rows of `width` values each as an array.
pub(crate) fn grid<T: numpy::Element>(
    py: Python<'_>,
    rows: impl Iterator<Item = Vec<T>>,
    width: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let flat: Vec<T> = rows.flatten().collect();
    let count = flat.len() / width;
    flat.into_pyarray(py).reshape([count, width])
}

/// Multipliers as complex numbers.
pub(crate) fn complex(multipliers: [Multiplier; 2]) -> [Complex64; 2] {
    multipliers.map(|m| Complex64::new(m.re, m.im))
}
