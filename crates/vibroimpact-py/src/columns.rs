//! Lists of Rust as columns of numpy, passed without a copy.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// Values as an array.
pub(crate) fn column<T: numpy::Element>(py: Python<'_>, values: impl Iterator<Item = T>) -> Bound<'_, PyArray1<T>> {
    values.collect::<Vec<T>>().into_pyarray(py)
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
