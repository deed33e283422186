//! The basin: each start in the colour of the motion it leads to.

use crate::exit::Failure;
use crate::plot::plane::Plane;
use crate::plot::variant;
use vibroimpact_plot::{ClassStyle, Colour, Figure, Legend, Panel, Raster, Rects, class_style, legend_group};

/// Motions with an entry of their own in the legend.
const NAMED: usize = 12;

/// A motion and the share of starts that lead to it.
pub(crate) struct Motion {
    pub(crate) label: String,
    pub(crate) share: f64,
}

/// `cells` holds the number of its motion for each start.
pub(crate) fn figure(plane: &Plane, motions: &[Motion], cells: Vec<u16>, title: String) -> Result<Figure, Failure> {
    let mut by_share: Vec<usize> = (0..motions.len()).collect();
    by_share.sort_by(|a, b| motions[*b].share.total_cmp(&motions[*a].share));
    let mut colours = vec![Colour::hex(0x9a_9a9a); motions.len()];
    let mut legend = Legend::below();
    let mut used: Vec<&str> = Vec::new();
    for (rank, &m) in by_share.iter().enumerate() {
        let label = motions[m].label.as_str();
        let group = legend_group(label);
        let twins = used.iter().filter(|other| **other == group).count();
        used.push(group);
        if rank >= NAMED {
            continue;
        }
        colours[m] = variant(class_style(label).colour, twins);
        let share = crate::report::text::percent(motions[m].share);
        let name = crate::plot::label(label);
        legend = legend.patch(ClassStyle::plain(colours[m]), format!("{name}, {share}"));
    }
    if motions.len() > NAMED {
        let rest = format!("{} others", motions.len() - NAMED);
        legend = legend.patch(ClassStyle::plain(Colour::hex(0x9a_9a9a)), rest);
    }
    let panel = Panel::new(plane.x.axis(), plane.y.axis());
    let columns = plane.x.count();
    let panel = match (plane.x.even(), plane.y.even()) {
        (Some(x), Some(y)) => panel.with(Raster::centred(x, y, (columns, plane.y.count()), cells, colours)?),
        _ => {
            let mut rects = Rects::new(colours.iter().map(|colour| ClassStyle::plain(*colour)).collect::<Vec<_>>());
            for (k, cell) in cells.iter().enumerate().filter(|(_, cell)| usize::from(**cell) < motions.len()) {
                rects.cell(plane.x.cell(k % columns), plane.y.cell(k / columns), &[usize::from(*cell)]);
            }
            panel.with(rects)
        }
    };
    Ok(Figure::new(panel).size(680.0, 620.0).title(title).legend(legend))
}
