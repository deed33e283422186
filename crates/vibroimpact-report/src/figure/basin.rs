//! The figure of a basin: each start in the colour of the motion to which it leads. Over one axis it is a strip of starts.

use crate::figure::plane::{Plane, PlaneAxis, Sides};
use crate::figure::variant;
use crate::{ReportError, Units, Varied};
use vibroimpact::math::sort_by;
use vibroimpact::verdict::System;
use vibroimpact_plot::{ClassStyle, Colour, Figure, FigureAxis, Legend, Panel, Raster, Rect, Rects, class_style};
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

/// The figure of `vibro basin`. Starts beyond a rigid stop are left blank.
pub(crate) fn figure<S: System, V: Varied, F>(
    found: &Basin<S, V, F>,
    units: &Units,
    title: String,
) -> Result<Figure, ReportError> {
    let motion = |m: usize| BasinMotion { label: found.motions[m].verdict.label().into_owned(), share: found.share(m) };
    let motions: Vec<BasinMotion> = (0..found.motions.len()).map(motion).collect();
    draw(&Sides::of(&found.plan.axes, units)?, &motions, found.cells.clone(), title)
}

/// Draws a basin over one or two axes. `cells` has the index of the motion of each start; other numbers are left blank.
///
/// # Errors
/// [`ReportError::Plot`] if the number of cells is not the number of starts.
pub fn draw(sides: &Sides, motions: &[BasinMotion], cells: Vec<u16>, title: String) -> Result<Figure, ReportError> {
    let (colours, legend) = colours(motions);
    let figure = match sides {
        Sides::Line(side) => Figure::new(strip(side, &cells, &colours)),
        Sides::Plane(plane) => Figure::new(panel(plane, cells, colours)?).size(680.0, 620.0),
    };
    Ok(figure.title(title).legend(legend))
}

/// The colours of the motions, and the legend with their shares.
fn colours(motions: &[BasinMotion]) -> (Vec<Colour>, Legend) {
    let mut by_share: Vec<usize> = (0..motions.len()).collect();
    sort_by(&mut by_share, |a, b| motions[*b].share.total_cmp(&motions[*a].share));
    let mut colours = vec![Colour::hex(0x9a_9a9a); motions.len()];
    let mut legend = Legend::below();
    let mut used: Vec<&str> = Vec::new();
    for (rank, &m) in by_share.iter().enumerate() {
        let label = motions[m].label.as_str();
        let twins = used.iter().filter(|other| **other == label).count();
        used.push(label);
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
    (colours, legend)
}

/// The starts over one axis, as bars of full height, in the form of a map over one axis.
fn strip(axis: &PlaneAxis, cells: &[u16], colours: &[Colour]) -> Panel {
    let mut rects = Rects::new(colours.iter().map(|colour| ClassStyle::plain(*colour)).collect::<Vec<_>>());
    for (k, class) in cells.iter().map(|cell| usize::from(*cell)).enumerate().filter(|(_, m)| *m < colours.len()) {
        rects.rects.push(Rect { x: axis.cell(k), y: (0.0, 1.0), class });
    }
    Panel::new(axis.axis(), FigureAxis::new("share of starts").range(0.0, 1.0)).with(rects)
}

/// The starts over a plane.
fn panel(plane: &Plane, cells: Vec<u16>, colours: Vec<Colour>) -> Result<Panel, ReportError> {
    let panel = Panel::new(plane.x.axis(), plane.y.axis());
    let columns = plane.x.count();
    Ok(match (plane.x.even(), plane.y.even()) {
        (Some(x), Some(y)) => panel.with(Raster::centred(x, y, (columns, plane.y.count()), cells, colours)?),
        _ => {
            let mut rects = Rects::new(colours.iter().map(|colour| ClassStyle::plain(*colour)).collect::<Vec<_>>());
            for (k, cell) in cells.iter().enumerate().filter(|(_, cell)| usize::from(**cell) < colours.len()) {
                rects.cell(plane.x.cell(k % columns), plane.y.cell(k / columns), &[usize::from(*cell)]);
            }
            panel.with(rects)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_plot::Mark;
    use vibroimpact_study::{Span, Values};

    #[test]
    fn starts_over_one_axis_are_bars_of_full_height() {
        let side = PlaneAxis::new("x", &Values::Span("0:2:3".parse::<Span>().unwrap())).unwrap();
        let motion = |label: &str, share| BasinMotion { label: label.to_owned(), share };
        // two motions of one label, and a start that was not computed
        let motions = [motion("1/1", 0.3), motion("1/1", 0.4)];
        let cells = vec![1, u16::MAX, 0];
        let figure = draw(&Sides::Line(side), &motions, cells, String::new()).unwrap();
        let Mark::Rects(rects) = &figure.panels[0].marks[0] else { panic!("bars") };
        let bars: Vec<_> = rects.rects.iter().map(|rect| (rect.class, rect.x, rect.y)).collect();
        assert_eq!(bars, [(1, (-0.5, 0.5), (0.0, 1.0)), (0, (1.5, 2.5), (0.0, 1.0))]);
        let legend = figure.legend.unwrap();
        assert_eq!(legend.entries.len(), 2);
        let (colours, _) = colours(&motions);
        assert_ne!(colours[0], colours[1]);
    }
}
