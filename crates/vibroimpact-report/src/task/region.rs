//! Regions of existence and stability: their polygons and the kinds of their boundaries.

use crate::number::{Number, short};
use crate::task::diagram::over;
use crate::text::words::aligned;
use crate::{Table, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use vibroimpact::continuation::{Polygon, Region, Vertex};
use vibroimpact_study::{Parameter, RegionPlan, Regions, Stretch};

/// The answer to `vibro region`. Pairs of values are in the order of `parameters`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct RegionAnswer {
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
    pub(crate) fn new<V: Varied>(found: &Regions, plan: &RegionPlan<V>, neutral: bool, units: &Units) -> Self {
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
pub(crate) fn unit<V: Varied>(plan: &RegionPlan<V>, units: &Units) -> (f64, f64) {
    (plan.across.parameter.unit(units), plan.up.parameter.unit(units))
}

/// The sheet of the surface of orbits: "below" if both multipliers are below +1, "above" otherwise.
pub(crate) const fn sheet(polygon: &Polygon) -> &'static str {
    if polygon.below { "below" } else { "above" }
}

/// Both regions with their names.
pub(crate) fn both(found: &Regions) -> [(&'static str, &Region); 2] {
    [("existence", &found.existence), ("stability", &found.stability)]
}

/// The table of `vibro region`.
pub(crate) fn table<'a, V: Varied>(found: &'a Regions, plan: &RegionPlan<V>, units: &Units) -> Table<'a> {
    let (across, up) = (plan.across.parameter.column(units), plan.up.parameter.column(units));
    Table::new(format!("region,polygon,hole,sheet,{across},{up},bound"), rows(found, unit(plan, units)))
}

/// One row for each vertex.
fn rows(found: &Regions, (x, y): (f64, f64)) -> impl Iterator<Item = String> + '_ {
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

/// Each polygon with its extent and the kinds of its boundary. The motion may be neutral where it exists, and its region may be
/// known in closed form.
pub(crate) fn text<V: Varied>(found: &Regions, plan: &RegionPlan<V>, known: (bool, bool), units: &Units) -> String {
    let (across, up) = (over(&plan.across, units), over(&plan.up, units));
    let names = [&plan.across, &plan.up].map(|stretch| stretch.parameter.words(units));
    let text = format!("{} over {across}, {up}\n", plan.label.trim());
    text + &polygons(found, (&names, unit(plan, units), plan.grid), known)
}

/// Whether a region is that of the motion without impacts over parameters of the oscillator, which is known in closed form.
pub(crate) fn in_closed_form(plan: &RegionPlan) -> bool {
    plan.clears() && ![plan.across, plan.up].iter().any(is_physical)
}

/// The polygons of both regions over numbers with these names and units, or why there is none.
fn polygons(
    found: &Regions,
    (names, unit, grid): (&[String; 2], (f64, f64), u32),
    (neutral, closed_form): (bool, bool),
) -> String {
    let mut text = String::new();
    for (name, region) in both(found) {
        let none = match (region.polygons.is_empty(), name) {
            (false, _) => "",
            (true, "stability") if neutral => {
                ": none, the motion is neutral where it exists: without damping and losses at impacts nothing attracts"
            }
            (true, _) if closed_form => ": none, the amplitude of the motion without impacts exceeds a gap everywhere",
            (true, _) => ": none found",
        };
        let _ = writeln!(text, "\n{name}{none}");
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
            text.push_str(&aligned(&heads, &rows));
        }
        if !region.unresolved.is_empty() {
            let _ = writeln!(
                text,
                "  at {} of {} points of the grid the polygons and the search for orbits do not agree: a curve was lost there, or the orbits rest on a stop",
                region.unresolved.len(),
                u64::from(grid).pow(2)
            );
        }
    }
    text
}

/// Whether a number in SI units varies.
const fn is_physical(stretch: &Stretch) -> bool {
    matches!(stretch.parameter, Parameter::Body(_))
}

fn row(k: usize, polygon: &Polygon, (x, y): (f64, f64)) -> Vec<String> {
    let range = |of: &dyn Fn((f64, f64)) -> f64| {
        let values = polygon.vertices.iter().map(|vertex| of(vertex.values));
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        format!("{} to {}", short(low), short(high))
    };
    // each kind once, in the order of first appearance
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
