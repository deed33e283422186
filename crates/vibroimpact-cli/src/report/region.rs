//! Regions of existence and stability as text.

use crate::report::diagram::over;
use crate::report::words::table;
use std::fmt::Write;
use vibroimpact::continuation::Polygon;
use vibroimpact_report::json::region::unit;
use vibroimpact_report::number::short;
use vibroimpact_report::table::region::both;
use vibroimpact_report::{Units, Varied};
use vibroimpact_study::{Parameter, RegionPlan, Regions, Stretch};

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
            text.push_str(&table(&heads, &rows));
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
