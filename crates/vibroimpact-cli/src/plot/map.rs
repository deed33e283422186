//! The map: each point of the parameter plane in the colours of the motions that coexist there.

use crate::exit::Failure;
use crate::plot::basin::{axis, half_cell};
use vibroimpact_plot::{
    ClassStyle, Figure, GROUPS, Legend, Panel, Raster, Rects, class_style, legend_group, legend_text,
};
use vibroimpact_study::{MapPoint, RegionMap, Span};

/// Above so many points coexisting motions could not be told apart, and a raster shows the most frequent one.
const SPLIT: usize = 40_000;

pub(crate) fn figure(map: &RegionMap, (x, y): (&Span, &Span), title: String) -> Result<Figure, Failure> {
    let mut present = [false; GROUPS.len()];
    let classes: Vec<Vec<usize>> = map.points.iter().map(groups).collect();
    let split = map.points.len() <= SPLIT;
    for cell in &classes {
        for class in cell.iter().take(if split { usize::MAX } else { 1 }) {
            present[*class] = true;
        }
    }
    let panel = Panel::new(axis("1/*β*", x), axis("*δ*", y));
    let panel = if split {
        let mut cells = Rects::new(GROUPS.map(class_style).to_vec());
        let (dx, dy) = (half_cell(x), half_cell(y));
        for (point, classes) in map.points.iter().zip(&classes) {
            let (px, py) = (point.at[0], point.at[1]);
            cells.cell((px - dx, px + dx), (py - dy, py + dy), classes);
        }
        panel.with(cells)
    } else {
        let first: Vec<u16> = classes
            .iter()
            .map(|cell| cell.first().and_then(|class| u16::try_from(*class).ok()).unwrap_or(u16::MAX))
            .collect();
        let palette = GROUPS.map(|group| class_style(group).colour).to_vec();
        let size = (x.count() as usize, y.count() as usize);
        panel.with(Raster::centred(x.ends(), y.ends(), size, first, palette)?)
    };
    let mut legend = Legend::below();
    for (group, _) in GROUPS.iter().zip(present).filter(|(_, present)| *present) {
        let style = class_style(group);
        let style = if split { style } else { ClassStyle::plain(style.colour) };
        legend = legend.patch(style, legend_text(group));
    }
    Ok(Figure::new(panel).size(680.0, 620.0).title(title).legend(legend))
}

/// The groups of the motions at a point, each once, in the order of the legend where all are shown.
fn groups(point: &MapPoint) -> Vec<usize> {
    let mut groups: Vec<usize> = Vec::new();
    for motion in &point.motions {
        let group = legend_group(&motion.verdict.label());
        let class = GROUPS.iter().position(|g| *g == group).unwrap_or(GROUPS.len() - 1);
        if !groups.contains(&class) {
            groups.push(class);
        }
    }
    groups
}
