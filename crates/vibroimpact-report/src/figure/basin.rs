//! The figure of a basin: each start in the colour of the motion to which it leads.

use crate::figure::plane::Plane;
use crate::figure::{title, variant};
use crate::{Asked, ReportError};
use vibroimpact_plot::{ClassStyle, Colour, Figure, Legend, Panel, Raster, Rects, class_style, legend_group};
use vibroimpact_study::{Basin, counted};

/// Maximum number of motions with an entry of their own in the legend.
const NAMED: usize = 12;

/// A motion, and the share of starts that lead to it.
#[derive(Clone, Debug)]
pub struct BasinMotion {
    /// Its label.
    pub label: String,
    /// Its share, from 0 to 1.
    pub share: f64,
}

/// The figure of `vibro basin`.
///
/// # Errors
/// [`ReportError`] if there are not two axes with rising or falling values, or if an axis is too long.
pub fn figure(found: &Basin, asked: &Asked) -> Result<Figure, ReportError> {
    let motion = |m: usize| BasinMotion { label: found.motions[m].verdict.label().into_owned(), share: found.share(m) };
    let motions: Vec<BasinMotion> = (0..found.motions.len()).map(motion).collect();
    let plane = Plane::of(&found.plan.axes, &asked.units)?;
    draw(&plane, &motions, found.cells.clone(), title(asked))
}

/// Draws a basin. `cells` has the index of the motion of each start; other numbers are left blank.
///
/// # Errors
/// [`ReportError::Plot`] if the number of cells is not the number of points of the plane.
pub fn draw(plane: &Plane, motions: &[BasinMotion], cells: Vec<u16>, title: String) -> Result<Figure, ReportError> {
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
        let share = crate::number::percent(motions[m].share);
        let name = crate::figure::label(label);
        legend = legend.patch(ClassStyle::plain(colours[m]), format!("{name}, {share}"));
    }
    if motions.len() > NAMED {
        let rest = counted((motions.len() - NAMED) as u64, "other");
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
