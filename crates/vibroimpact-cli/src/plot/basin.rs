//! The basin: each start in the colour of the motion it leads to.

use crate::exit::Failure;
use crate::plot::variant;
use vibroimpact_plot::{Axis, ClassStyle, Colour, Figure, Legend, Panel, Raster, class_style, legend_group};
use vibroimpact_study::{Basin, Span};

/// Motions with an entry of their own in the legend.
const NAMED: usize = 12;

pub(crate) fn figure(
    basin: &Basin,
    (x, v): (&Span, &Span),
    (x_name, v_name): (&str, &str),
    title: String,
) -> Result<Figure, Failure> {
    let mut by_share: Vec<usize> = (0..basin.motions.len()).collect();
    by_share.sort_by_key(|m| core::cmp::Reverse(basin.motions[*m].count));
    let mut colours = vec![Colour::hex(0x9a_9a9a); basin.motions.len()];
    let mut legend = Legend::below();
    let mut used: Vec<&str> = Vec::new();
    for (rank, &m) in by_share.iter().enumerate() {
        let label = basin.motions[m].verdict.label();
        let group = legend_group(&label);
        let twins = used.iter().filter(|other| **other == group).count();
        used.push(group);
        if rank >= NAMED {
            continue;
        }
        colours[m] = variant(class_style(&label).colour, twins);
        let share = crate::report::text::percent(basin.share(m));
        let name = crate::plot::label(&label);
        legend = legend.patch(ClassStyle::plain(colours[m]), format!("{name}, {share}"));
    }
    if basin.motions.len() > NAMED {
        let rest = format!("{} others", basin.motions.len() - NAMED);
        legend = legend.patch(ClassStyle::plain(Colour::hex(0x9a_9a9a)), rest);
    }
    let count = |span: &Span| span.count() as usize;
    let size = (count(x), count(v));
    let raster = Raster::centred(x.ends(), v.ends(), size, basin.cells.clone(), colours)?;
    let panel = Panel::new(axis(x_name, x), axis(v_name, v)).with(raster);
    Ok(Figure::new(panel).size(680.0, 620.0).title(title).legend(legend))
}

/// An axis that shows the cells around the first and last value whole.
pub(crate) fn axis(name: &str, span: &Span) -> Axis {
    let (a, b) = span.ends();
    let half = half_cell(span);
    Axis::new(name).range(a.min(b) - half, a.max(b) + half)
}

/// Half the distance of two values.
pub(crate) fn half_cell(span: &Span) -> f64 {
    let (a, b) = span.ends();
    if span.count() > 1 { (b / 2.0 - a / 2.0).abs() / f64::from(span.count() - 1) } else { 0.5 }
}
