//! Whether points lie in a region, which is given by its polygons.

use crate::columns::column;
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use vibroimpact::continuation::{Bound as Edge, Polygon, Region, Vertex};

/// Whether each of some points lies in a region. Each polygon is given by its vertices and whether multipliers are
/// below +1.
#[pyfunction]
pub(crate) fn contains<'py>(
    py: Python<'py>,
    polygons: Vec<(PyReadonlyArray2<'py, f64>, bool)>,
    p: PyReadonlyArray1<'py, f64>,
    q: PyReadonlyArray1<'py, f64>,
) -> Bound<'py, PyArray1<bool>> {
    let polygon = |(vertices, below): &(PyReadonlyArray2<'py, f64>, bool)| Polygon {
        vertices: vertices
            .as_array()
            .rows()
            .into_iter()
            .map(|row| Vertex { values: (row[0], row[1]), bound: Edge::Frame })
            .collect(),
        hole: false,
        below: *below,
    };
    let region = Region { polygons: polygons.iter().map(polygon).collect(), unresolved: Vec::new() };
    let points = p.as_array().to_vec().into_iter().zip(q.as_array().to_vec());
    column(py, points.map(|point| region.contains(point)))
}
