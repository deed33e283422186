//! The figure of a map: each point of the parameter plane in the colours of its coexisting motions.

use crate::figure::coloured::Value;
use crate::figure::plane::{Plane, PlaneAxis, Sides, varied};
use crate::figure::point_motion::{PointMotion, group, points};
use crate::figure::{shares, title_without};
use crate::{Asked, ReportError};
use vibroimpact_plot::{ClassStyle, Figure, GROUPS, Legend, Panel, Raster, Rects, class_style, legend_text};
use vibroimpact_study::{MachineMap, MachineShare, MapPoint, RegionMap};

/// With more points than this, coexisting motions would be too small to be visible, and only the most frequent one is
/// drawn.
const SPLIT: usize = 40_000;

/// The figure of `vibro map`: a plane, or the shares of the motions over one axis.
///
/// # Errors
/// [`ReportError`] if there are not one or two axes with rising or falling values, or if an axis is too long.
pub fn figure(found: &RegionMap, asked: &Asked) -> Result<Figure, ReportError> {
    let axes = &found.plan.axes;
    if let [axis] = axes.as_slice() {
        let points = points(found, None, &asked.units);
        return Ok(shares::draw(&PlaneAxis::of(axis, &asked.units)?, &points, title_without(asked, &varied(axes))));
    }
    let cell = |point: &MapPoint| groups(point.motions.iter().map(|motion| motion.verdict.label()));
    let cells: Vec<Vec<usize>> = found.points.iter().map(cell).collect();
    draw(&Plane::of(axes, &asked.units)?, &cells, title_without(asked, &varied(axes)))
}

/// The figure of `vibro map --machine`, as [`figure`]; the names of the axes are the paths.
///
/// # Errors
/// As [`figure`].
pub fn of_machine(found: &MachineMap, title: String) -> Result<Figure, ReportError> {
    match Sides::of_machine(&found.axes)? {
        Sides::Line(side) => {
            let motion = |motion: &MachineShare| PointMotion {
                group: group(&motion.label()),
                share: motion.share,
                value: Value::Undefined,
            };
            let points: Vec<Vec<PointMotion>> =
                found.cells.iter().map(|cell| cell.iter().map(motion).collect()).collect();
            Ok(shares::draw(&side, &points, title))
        }
        Sides::Plane(plane) => {
            let cell = |cell: &Vec<MachineShare>| groups(cell.iter().map(|motion| motion.label().into()));
            draw(&plane, &found.cells.iter().map(cell).collect::<Vec<_>>(), title)
        }
    }
}

/// Draws a map. `cells` has the distinct groups of the motions at each point, the most frequent first.
///
/// # Errors
/// [`ReportError::Plot`] if the number of cells is not the number of points of the plane.
pub fn draw(plane: &Plane, cells: &[Vec<usize>], title: String) -> Result<Figure, ReportError> {
    let mut present = [false; GROUPS.len()];
    let split = cells.len() <= SPLIT;
    let shown = |cell: &Vec<usize>| cell.iter().take(if split { usize::MAX } else { 1 }).copied().collect::<Vec<_>>();
    for class in cells.iter().flat_map(shown) {
        present[class] = true;
    }
    let panel = Panel::new(plane.x.axis(), plane.y.axis());
    let columns = plane.x.count();
    let panel = match (plane.x.even(), plane.y.even()) {
        (Some(x), Some(y)) if !split => {
            let class =
                |cell: &Vec<usize>| cell.first().and_then(|class| u16::try_from(*class).ok()).unwrap_or(u16::MAX);
            let palette = GROUPS.map(|group| class_style(group).colour).to_vec();
            let first: Vec<u16> = cells.iter().map(class).collect();
            panel.with(Raster::centred(x, y, (columns, plane.y.count()), first, palette)?)
        }
        _ => {
            let mut rects = Rects::new(GROUPS.map(class_style).to_vec());
            for (k, cell) in cells.iter().enumerate().filter(|(_, cell)| !cell.is_empty()) {
                rects.cell(plane.x.cell(k % columns), plane.y.cell(k / columns), &shown(cell));
            }
            panel.with(rects)
        }
    };
    let mut legend = Legend::below();
    for (group, _) in GROUPS.iter().zip(present).filter(|(_, present)| *present) {
        let style = class_style(group);
        let style = if split { style } else { ClassStyle::plain(style.colour) };
        legend = legend.patch(style, legend_text(group));
    }
    Ok(Figure::new(panel).size(680.0, 620.0).title(title).legend(legend))
}

/// The distinct groups of some labels, in the order of first appearance.
fn groups<'a>(labels: impl Iterator<Item = std::borrow::Cow<'a, str>>) -> Vec<usize> {
    let mut groups: Vec<usize> = Vec::new();
    for label in labels {
        let class = group(&label);
        if !groups.contains(&class) {
            groups.push(class);
        }
    }
    groups
}
