//! Regions of existence and stability: their polygons and the kinds of their boundaries.

use crate::{Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::continuation::{Polygon, Region, Vertex};
use vibroimpact_study::{RegionPlan, Regions};

/// The answer to `vibro region`. Pairs of values are in the order of `parameters`.
#[derive(JsonSchema, Serialize)]
pub(super) struct RegionAnswer {
    /// The label m/n of the motion.
    label: String,
    /// The parameters on the abscissa and the ordinate.
    parameters: [String; 2],
    /// Whether no energy is lost, at impacts or between them. The motion is then neutrally stable wherever it exists.
    neutrally_stable: bool,
    /// The region where the motion exists.
    existence: RegionObject,
    /// The region where it is stable.
    stability: RegionObject,
}

#[derive(JsonSchema, Serialize)]
struct RegionObject {
    /// Its boundaries; those of different sheets may overlap.
    polygons: Vec<PolygonObject>,
    /// Points of the grid where the search for orbits contradicts the polygons.
    unresolved: Vec<[f64; 2]>,
}

#[derive(JsonSchema, Serialize)]
struct PolygonObject {
    /// Whether it is the boundary of a hole.
    hole: bool,
    /// `below` for orbits whose multipliers are below +1, `above` for the others.
    sheet: &'static str,
    /// Values of the two parameters; the region lies to the left of the polygon.
    vertices: Vec<[f64; 2]>,
    /// The kind of boundary from each vertex to the next: fold, flip, no speed, touch, merging, frame; of a machine also torus and
    /// change.
    bounds: Vec<&'static str>,
}

impl RegionAnswer {
    pub(super) fn new<V: Varied>(found: &Regions, plan: &RegionPlan<V>, neutral: bool, units: &Units) -> Self {
        let unit = unit(plan, units);
        Self {
            label: plan.label.trim().to_owned(),
            parameters: [&plan.across, &plan.up].map(|stretch| stretch.parameter.field(units).to_owned()),
            neutrally_stable: neutral,
            existence: RegionObject::new(&found.existence, unit),
            stability: RegionObject::new(&found.stability, unit),
        }
    }
}

impl RegionObject {
    fn new(region: &Region, (x, y): (f64, f64)) -> Self {
        let polygon = |polygon: &Polygon| PolygonObject {
            hole: polygon.hole,
            sheet: sheet(polygon),
            vertices: polygon.vertices.iter().map(|Vertex { values: (p, q), .. }| [p * x, q * y]).collect(),
            bounds: polygon.vertices.iter().map(|vertex| vertex.bound.name()).collect(),
        };
        Self {
            polygons: region.polygons.iter().map(polygon).collect(),
            unresolved: region.unresolved.iter().map(|(p, q)| [p * x, q * y]).collect(),
        }
    }
}

/// The units of both parameters.
#[must_use]
pub fn unit<V: Varied>(plan: &RegionPlan<V>, units: &Units) -> (f64, f64) {
    (plan.across.parameter.unit(units), plan.up.parameter.unit(units))
}

/// The sheet of the surface of orbits: "below" if both multipliers are below +1, "above" otherwise.
pub(crate) const fn sheet(polygon: &Polygon) -> &'static str {
    if polygon.below { "below" } else { "above" }
}
