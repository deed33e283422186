//! The figure of the regions where a motion exists and where it is stable, in a plane of two parameters. Edges have the
//! colour of their kind.

use crate::figure::label;
use crate::figure::styles::BOUND_STYLES;
use crate::task::region::unit;
use crate::{Units, Varied};
use vibroimpact::continuation::{Bound, Polygon, Region};
use vibroimpact_plot::{
    ClassStyle, Colour, Figure, FigureAxis, FilledRegion, Legend, Line, Panel, Stroke, class_style,
};
use vibroimpact_study::{RegionPlan, Regions, Stretch};

/// Colour of the region where the motion exists and is unstable.
const EXISTS: Colour = Colour::hex(0xec_ecec);
/// Widths of edges.
const THICK: f64 = 3.2;
const THIN: f64 = 1.5;

/// The figure of `vibro region`; of a motion that is neutral where it exists, or not.
pub(crate) fn figure<V: Varied>(
    found: &Regions,
    plan: &RegionPlan<V>,
    (neutral, units): (bool, &Units),
    title: impl Into<String>,
) -> Figure {
    let motion = plan.label.trim();
    let (x, y) = unit(plan, units);
    let axis = |stretch: &Stretch<V>, unit: f64| {
        FigureAxis::new(stretch.parameter.axis(units)).range(stretch.from * unit, stretch.to * unit)
    };
    let scaled = |region: &Region| {
        let mut region = region.clone();
        let vertices = region.polygons.iter_mut().flat_map(|polygon| &mut polygon.vertices);
        vertices.for_each(|vertex| vertex.values = (vertex.values.0 * x, vertex.values.1 * y));
        region
    };
    let found = &Regions { existence: scaled(&found.existence), stability: scaled(&found.stability) };
    let mut panel = Panel::new(axis(&plan.across, x), axis(&plan.up, y));
    let stable = class_style(motion).colour;
    let mut legend = Legend::below();
    let name = label(motion);
    let exists = if neutral { "exists, neutral" } else { "exists, unstable" };
    for (region, colour, what) in [(&found.existence, EXISTS, exists), (&found.stability, stable, "stable")] {
        for area in areas(region) {
            panel.add(area.fill(colour));
        }
        if neutral && what == "stable" {
            continue;
        }
        legend = legend.patch(ClassStyle::plain(colour), format!("{name} {what}"));
    }
    for (bound, colour, dash, name) in BOUND_STYLES {
        let stroke = Stroke { colour, width: THICK, dash };
        let mut seen = false;
        // the edges of the second orbit that exists beside another one are thin
        for (below, stroke) in [(false, stroke.width(THIN)), (true, stroke)] {
            let (mut xs, mut ys) = (Vec::new(), Vec::new());
            let polygons = found.existence.polygons.iter().chain(&found.stability.polygons);
            for polygon in polygons.filter(|polygon| polygon.below == below) {
                edges(polygon, bound, &mut xs, &mut ys);
            }
            if !xs.is_empty() {
                panel.add(Line { xs, ys, stroke });
                seen = true;
            }
        }
        if seen {
            legend = legend.line(stroke, name);
        }
    }
    Figure::new(panel).size(680.0, 620.0).title(title).legend(legend)
}

/// Each outer ring with its holes, filled separately because the sheets of a surface may overlap.
fn areas(region: &Region) -> impl Iterator<Item = FilledRegion> + '_ {
    region.polygons.iter().filter(|polygon| !polygon.hole).map(|outer| {
        let alone = Region { polygons: vec![outer.clone()], unresolved: Vec::new() };
        let inside = |hole: &&Polygon| {
            hole.hole
                && hole.below == outer.below
                && hole.vertices.first().is_some_and(|vertex| alone.contains(vertex.values))
        };
        let holes = region.polygons.iter().filter(inside);
        FilledRegion::new(core::iter::once(outer).chain(holes).map(ring).collect())
    })
}

fn ring(polygon: &Polygon) -> Vec<(f64, f64)> {
    polygon.vertices.iter().map(|vertex| vertex.values).collect()
}

/// Adds the edges of a polygon with the given kind of boundary.
fn edges(polygon: &Polygon, bound: Bound, xs: &mut Vec<f64>, ys: &mut Vec<f64>) {
    let count = polygon.vertices.len();
    let mut joined = false;
    for (k, vertex) in polygon.vertices.iter().enumerate() {
        if vertex.bound != bound {
            joined = false;
            continue;
        }
        let next = polygon.vertices[(k + 1) % count];
        if !joined {
            xs.extend([f64::NAN, vertex.values.0]);
            ys.extend([f64::NAN, vertex.values.1]);
        }
        xs.push(next.values.0);
        ys.push(next.values.1);
        joined = true;
    }
}
