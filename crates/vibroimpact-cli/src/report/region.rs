//! Regions of existence and stability as tables, text and JSON.

use crate::report::csv::Number;
use crate::report::text::{short, table};
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::continuation::{Polygon, Region};
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
    pub(crate) fn new(found: &Regions, plan: &RegionPlan) -> Self {
        Self {
            label: plan.label.trim().to_owned(),
            parameters: [plan.across.parameter.name(), plan.up.parameter.name()],
            existence: RegionObject::new(&found.existence),
            stability: RegionObject::new(&found.stability),
        }
    }
}

impl RegionObject {
    fn new(region: &Region) -> Self {
        let polygon = |polygon: &Polygon| PolygonObject {
            hole: polygon.hole,
            sheet: sheet(polygon),
            vertices: polygon.vertices.iter().map(|vertex| vertex.values.into()).collect(),
            bounds: polygon.vertices.iter().map(|vertex| vertex.bound.name()).collect(),
        };
        Self {
            polygons: region.polygons.iter().map(polygon).collect(),
            unresolved: region.unresolved.iter().map(|point| (*point).into()).collect(),
        }
    }
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
pub(crate) fn rows(found: &Regions) -> impl Iterator<Item = String> + '_ {
    both(found).into_iter().flat_map(|(name, region)| {
        region.polygons.iter().enumerate().flat_map(move |(k, polygon)| {
            let head = format!("{name},{},{},{}", k + 1, polygon.hole, sheet(polygon));
            polygon.vertices.iter().map(move |vertex| {
                let (p, q) = vertex.values;
                format!("{head},{},{},{}", Number(p), Number(q), vertex.bound.name())
            })
        })
    })
}

/// A parameter's range in words.
fn over(stretch: &Stretch) -> String {
    let name = stretch.parameter.name().replace('_', " ");
    format!("{name} from {} to {}", short(stretch.from), short(stretch.to))
}

/// Each polygon with its extent and what bounds it.
pub(crate) fn text(found: &Regions, plan: &RegionPlan) -> String {
    let mut text = format!("{} over {}, {}\n", plan.label.trim(), over(&plan.across), over(&plan.up));
    let names = [plan.across.parameter, plan.up.parameter].map(|parameter| parameter.name().replace('_', " "));
    for (name, region) in both(found) {
        let _ = writeln!(text, "\n{name}{}", if region.polygons.is_empty() { ": none found" } else { "" });
        let heads = [
            "polygon".to_owned(),
            "vertices".into(),
            format!("<{}", names[0]),
            format!("<{}", names[1]),
            "<bounded by".into(),
        ];
        let rows: Vec<Vec<String>> = region.polygons.iter().enumerate().map(|(k, polygon)| row(k, polygon)).collect();
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

fn row(k: usize, polygon: &Polygon) -> Vec<String> {
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
        range(&|(p, _)| p),
        range(&|(_, q)| q),
        bounds.join(", ") + hole,
    ]
}
