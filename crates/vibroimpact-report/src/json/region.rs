//! Regions of existence and stability: their polygons and the kinds of their boundaries.

use super::Scales;
use crate::{Asked, PROGRAM, Units};
use serde::Serialize;
use vibroimpact::continuation::{Polygon, Region, Vertex};
use vibroimpact_study::{Parameter, Plan, RegionPlan, Regions};

/// The fields of the regions. Pairs of values are in the order of `parameters`.
#[derive(Serialize)]
struct RegionFields {
    label: String,
    parameters: [&'static str; 2],
    /// Whether no energy is lost, at impacts or between them. The motion is then neutrally stable wherever it exists.
    neutrally_stable: bool,
    existence: RegionObject,
    stability: RegionObject,
}

#[derive(Serialize)]
struct RegionObject {
    polygons: Vec<PolygonObject>,
    /// Points of the grid where the search for orbits contradicts the polygons.
    unresolved: Vec<[f64; 2]>,
}

#[derive(Serialize)]
struct PolygonObject {
    hole: bool,
    sheet: &'static str,
    vertices: Vec<[f64; 2]>,
    /// The kind of boundary from each vertex to the next.
    bounds: Vec<&'static str>,
}

/// The whole object. Parameters that vary have no value in `system`.
#[derive(Serialize)]
struct Object<'a> {
    system: SystemObject,
    #[serde(flatten)]
    answer: RegionFields,
    units: &'static str,
    plan: &'a Plan,
    program: &'static str,
}

#[derive(Serialize)]
struct SystemObject {
    beta: Option<f64>,
    inverse_beta: Option<f64>,
    gap: Option<f64>,
    restitution: Option<f64>,
    damping: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    second_gap: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    second_restitution: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scales: Option<Scales>,
}

/// The object of `vibro region`.
#[must_use]
pub fn document<'a>(asked: &Asked, plan: &'a Plan, (task, found): (&RegionPlan, &Regions)) -> impl Serialize + use<'a> {
    let Asked { system, units } = asked;
    let varied = [task.across.parameter, task.up.parameter];
    let fixed = |parameter: Parameter, value: Option<f64>| value.filter(|_| !varied.contains(&parameter));
    let second = system.second_stop;
    Object {
        system: SystemObject {
            beta: fixed(Parameter::Beta, system.beta),
            inverse_beta: fixed(Parameter::InverseBeta, system.inverse_beta),
            gap: fixed(Parameter::Gap, Some(system.gap)),
            restitution: fixed(Parameter::Restitution, Some(system.restitution)),
            damping: fixed(Parameter::Damping, Some(system.damping)),
            second_gap: fixed(Parameter::SecondGap, second.map(|stop| stop.gap)),
            second_restitution: fixed(Parameter::SecondRestitution, second.map(|stop| stop.restitution)),
            scales: Scales::new(units),
        },
        answer: RegionFields::new(found, task, asked),
        units: units.name(),
        plan,
        program: PROGRAM,
    }
}

impl RegionFields {
    fn new(found: &Regions, plan: &RegionPlan, Asked { system, units }: &Asked) -> Self {
        let unit = unit(plan, units);
        Self {
            label: plan.label.trim().to_owned(),
            parameters: [plan.across.parameter, plan.up.parameter].map(|parameter| units.name_of(parameter)),
            neutrally_stable: plan.neutral(system),
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
pub fn unit(plan: &RegionPlan, units: &Units) -> (f64, f64) {
    (units.of(plan.across.parameter), units.of(plan.up.parameter))
}

/// The sheet of the surface of orbits: "below" if both multipliers are below +1, "above" otherwise.
pub(crate) const fn sheet(polygon: &Polygon) -> &'static str {
    if polygon.below { "below" } else { "above" }
}
