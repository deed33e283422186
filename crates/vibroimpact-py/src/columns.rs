//! Lists of Rust as columns of numpy, passed without a copy.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// Values as an array.
pub(crate) fn column<T: numpy::Element>(py: Python<'_>, values: impl Iterator<Item = T>) -> Bound<'_, PyArray1<T>> {
    values.collect::<Vec<T>>().into_pyarray(py)
}

/// Rows of `width` values each as an array; `width` may be 0.
pub(crate) fn grid<T: numpy::Element>(
    py: Python<'_>,
    rows: impl ExactSizeIterator<Item = Vec<T>>,
    width: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = rows.len();
    rows.flatten().collect::<Vec<T>>().into_pyarray(py).reshape([count, width])
}
