//! Regions of existence and stability as tables, text and JSON.

use crate::args::Units;
use crate::report::branch_text::named;
use crate::report::csv::Number;
use crate::report::text::{short, table};
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::continuation::{Polygon, Region, Vertex};
use vibroimpact_study::{RegionPlan, Regions, Stretch};

/// The command's part of the object. Pairs of values are in the order of `parameters`.
#[derive(Serialize)]
pub(crate) struct Answer {
    label: String,
    parameters: [&'static str; 2],
    existence: RegionObject,
    stability: RegionObject,
}

#[derive(Serialize)]
struct RegionObject {
    polygons: Vec<PolygonObject>,
    /// Points where the search for orbits and the polygons do not agree.
    unresolved: Vec<[f64; 2]>,
}

#[derive(Serialize)]
struct PolygonObject {
    hole: bool,
    sheet: &'static str,
    vertices: Vec<[f64; 2]>,
    /// What bounds the region from each vertex to the next.
    bounds: Vec<&'static str>,
}

impl Answer {
    pub(crate) fn new(found: &Regions, plan: &RegionPlan, units: &Units) -> Self {
        let unit = unit(plan, units);
        Self {
            label: plan.label.trim().to_owned(),
            parameters: [plan.across.parameter.name(), plan.up.parameter.name()],
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
fn unit(plan: &RegionPlan, units: &Units) -> (f64, f64) {
    (units.of(plan.across.parameter), units.of(plan.up.parameter))
}

/// Which sheet of the surface of orbits: their multipliers below +1, or one above.
const fn sheet(polygon: &Polygon) -> &'static str {
    if polygon.below { "below" } else { "above" }
}

/// Both regions with their names.
fn both(found: &Regions) -> [(&'static str, &Region); 2] {
    [("existence", &found.existence), ("stability", &found.stability)]
}

/// The columns of the table.
pub(crate) fn columns(plan: &RegionPlan) -> String {
    format!("region,polygon,hole,sheet,{},{},bound", plan.across.parameter.name(), plan.up.parameter.name())
}

/// One row a vertex.
pub(crate) fn rows<'a>(found: &'a Regions, plan: &RegionPlan, units: &Units) -> impl Iterator<Item = String> + 'a {
    let (x, y) = unit(plan, units);
    both(found).into_iter().flat_map(move |(name, region)| {
        region.polygons.iter().enumerate().flat_map(move |(k, polygon)| {
            let head = format!("{name},{},{},{}", k + 1, polygon.hole, sheet(polygon));
            polygon.vertices.iter().map(move |vertex| {
                let (p, q) = vertex.values;
                format!("{head},{},{},{}", Number(p * x), Number(q * y), vertex.bound.name())
            })
        })
    })
}

/// A parameter's range in words.
fn over(stretch: &Stretch, units: &Units) -> String {
    let (name, unit) = (named(stretch.parameter, units), units.of(stretch.parameter));
    format!("{name} from {} to {}", short(stretch.from * unit), short(stretch.to * unit))
}

/// Each polygon with its extent and what bounds it.
pub(crate) fn text(found: &Regions, plan: &RegionPlan, units: &Units) -> String {
    let (across, up) = (over(&plan.across, units), over(&plan.up, units));
    let mut text = format!("{} over {across}, {up}\n", plan.label.trim());
    let names = [plan.across.parameter, plan.up.parameter].map(|parameter| named(parameter, units));
    let unit = unit(plan, units);
    for (name, region) in both(found) {
        let _ = writeln!(text, "\n{name}{}", if region.polygons.is_empty() { ": none found" } else { "" });
        let heads = [
            "polygon".to_owned(),
            "vertices".into(),
            format!("<{}", names[0]),
            format!("<{}", names[1]),
            "<bounded by".into(),
        ];
        let rows: Vec<Vec<String>> =
            region.polygons.iter().enumerate().map(|(k, polygon)| row(k, polygon, unit)).collect();
        if !rows.is_empty() {
            text.push_str(&table(&heads, &rows));
        }
        if !region.unresolved.is_empty() {
            let _ = writeln!(
                text,
                "  at {} of {} points of the grid the polygons and the search for orbits do not agree",
                region.unresolved.len(),
                u64::from(plan.grid).pow(2)
            );
        }
    }
    text
}

fn row(k: usize, polygon: &Polygon, (x, y): (f64, f64)) -> Vec<String> {
    let range = |of: &dyn Fn((f64, f64)) -> f64| {
        let values = polygon.vertices.iter().map(|vertex| of(vertex.values));
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        format!("{} to {}", short(low), short(high))
    };
    // in the order in which they are met, each once
    let mut bounds: Vec<&str> = Vec::new();
    for vertex in &polygon.vertices {
        if !bounds.contains(&vertex.bound.name()) {
            bounds.push(vertex.bound.name());
        }
    }
    let hole = if polygon.hole { " (a hole)" } else { "" };
    vec![
        (k + 1).to_string(),
        polygon.vertices.len().to_string(),
        range(&|(p, _)| p * x),
        range(&|(_, q)| q * y),
        bounds.join(", ") + hole,
    ]
}
