//! Regions of existence and stability: their polygons and the kinds of their boundaries.

use super::Document;
use crate::{Asked, Units};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::Oscillator;
use vibroimpact::continuation::{Polygon, Region, Vertex};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{MachineRegionPlan, Plan, RegionPlan, Regions};

/// The answer to `vibro region`. Pairs of values are in the order of `parameters`.
#[derive(JsonSchema, Serialize)]
pub(super) struct RegionAnswer {
    label: String,
    parameters: [String; 2],
    /// Whether no energy is lost, at impacts or between them. The motion is then neutrally stable wherever it exists.
    neutrally_stable: bool,
    existence: RegionObject,
    stability: RegionObject,
}

#[derive(JsonSchema, Serialize)]
struct RegionObject {
    polygons: Vec<PolygonObject>,
    /// Points of the grid where the search for orbits contradicts the polygons.
    unresolved: Vec<[f64; 2]>,
}

#[derive(JsonSchema, Serialize)]
struct PolygonObject {
    hole: bool,
    sheet: &'static str,
    vertices: Vec<[f64; 2]>,
    /// The kind of boundary from each vertex to the next.
    bounds: Vec<&'static str>,
}

/// The object of `vibro region`. Parameters that vary have no value in the system.
#[must_use]
pub fn document<'a>(
    asked: &Asked,
    plan: &'a Plan,
    osc: &Oscillator,
    (task, found): (&RegionPlan, &Regions),
) -> impl Serialize + use<'a> {
    let varied = [task.across.parameter, task.up.parameter];
    Document::over(asked, osc, &varied, plan, RegionAnswer::new(found, task, asked))
}

impl RegionAnswer {
    fn new(found: &Regions, plan: &RegionPlan, Asked { system, units }: &Asked) -> Self {
        let unit = unit(plan, units);
        Self {
            label: plan.label.trim().to_owned(),
            parameters: [plan.across.parameter, plan.up.parameter].map(|of| units.name_of(of).to_owned()),
            neutrally_stable: plan.neutral(system),
            existence: RegionObject::new(&found.existence, unit),
            stability: RegionObject::new(&found.stability, unit),
        }
    }
}

impl RegionAnswer {
    /// The same of a machine.
    pub(super) fn of_machine(found: &Regions, plan: &MachineRegionPlan, source: &MachineSource) -> Self {
        Self {
            label: plan.label.trim().to_owned(),
            parameters: [plan.across.path.clone(), plan.up.path.clone()],
            neutrally_stable: plan.neutral(source),
            existence: RegionObject::new(&found.existence, (1.0, 1.0)),
            stability: RegionObject::new(&found.stability, (1.0, 1.0)),
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
pub fn unit(plan: &RegionPlan, units: &Units) -> (f64, f64) {
    (units.of(plan.across.parameter), units.of(plan.up.parameter))
}

/// The sheet of the surface of orbits: "below" if both multipliers are below +1, "above" otherwise.
pub(crate) const fn sheet(polygon: &Polygon) -> &'static str {
    if polygon.below { "below" } else { "above" }
}
