//! The regions of a plane of two parameters in which a motion exists and in which it is stable, as polygons.

use crate::axis::stretch;
use crate::columns::{column, pairs};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::Oscillator;
use crate::simulate::text;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use vibroimpact::continuation::{Bound as Edge, Polygon, Region, Vertex};
use vibroimpact_study::{Plan, RegionPlan, Results, Task};

/// The vertices, the kind of boundary from each vertex to the next, whether it is a hole, and whether multipliers are
/// below +1.
type PolygonFields<'py> = (Bound<'py, PyArray2<f64>>, Vec<&'static str>, bool, bool);

/// The polygons, and the points of the grid where the search for orbits contradicts them.
type Part<'py> = (Vec<PolygonFields<'py>>, Bound<'py, PyArray2<f64>>);

fn part<'py>(py: Python<'py>, region: &Region) -> PyResult<Part<'py>> {
    let polygon = |polygon: &Polygon| {
        let vertices = pairs(py, polygon.vertices.iter().map(|vertex| vertex.values.into()))?;
        let bounds = polygon.vertices.iter().map(|vertex| vertex.bound.name()).collect();
        Ok((vertices, bounds, polygon.hole, polygon.below))
    };
    let polygons = region.polygons.iter().map(polygon).collect::<PyResult<_>>()?;
    Ok((polygons, pairs(py, region.unresolved.iter().map(|point| (*point).into()))?))
}

/// The regions of existence and of stability, whether the motion is neutrally stable, and the plan.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // keywords
pub(crate) fn region<'py>(
    py: Python<'py>,
    osc: Oscillator,
    label: String,
    across: (String, f64, f64),
    up: (String, f64, f64),
    grid: u32,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<(Part<'py>, Part<'py>, bool, String), Trouble> {
    let task = RegionPlan { label, across: stretch(across)?, up: stretch(up)?, grid };
    let plan = Plan::new(osc.plan, Task::Region(task.clone()));
    let neutral = task.neutral(&osc.plan);
    let watch = Watch { what: "looking for regions", total: 2, progress, threads };
    let found = door::result(py, watch, &plan, |of| if let Results::Region(found) = of { Some(found) } else { None })?;
    Ok((part(py, &found.existence)?, part(py, &found.stability)?, neutral, text(&plan)?))
}

/// Whether each of some points lies in a region. Each polygon is given by its vertices and whether multipliers are
/// below +1.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // called from Python
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
