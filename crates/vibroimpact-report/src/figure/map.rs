//! The figure of a map: each point of the parameter plane in the colours of its coexisting motions.

use crate::figure::plane::{Plane, Sides};
use crate::figure::point_motion::{PointMotion, PointMotions, legend};
use crate::figure::shares;
use crate::{FieldName, ReportError, Units, Varied};
use vibroimpact_plot::{ClassStyle, Colour, Figure, Key, Line, Panel, Raster, Rects, class_style};
use vibroimpact_study::RegionMap;

/// With more points than this, the parts of a cell would be too small to be visible; coexisting motions are stripes across
/// several cells.
const SPLIT: usize = 40_000;

/// Period of the stripes of coexisting motions, in cells.
const STRIPE: usize = 12;

/// Distance of the lines that hatch undecided cells, in cells.
const HATCH: usize = 7;

impl PointMotions {
    /// The class of each cell of a raster: where motions coexist, stripes from the lower right to the upper left whose
    /// widths are the shares; undecided cells are crossed by lines of the class after all others.
    fn striped(&self, columns: usize) -> Vec<u16> {
        let undecided = self.labels.iter().position(|label| label == "undecided");
        let class = |(k, cell): (usize, &Vec<PointMotion>)| {
            let (column, row) = (k % columns, k / columns);
            #[allow(clippy::cast_precision_loss)] // below the period
            let mut rest = (((column + row) % STRIPE) as f64 + 0.5) / STRIPE as f64;
            let mut shown = None;
            for motion in cell {
                shown = Some(motion.class);
                rest -= motion.share;
                if rest < 0.0 {
                    break;
                }
            }
            let lines = (column + row).is_multiple_of(HATCH) || column % HATCH == row % HATCH;
            let shown = if shown.is_some() && shown == undecided && lines { Some(self.labels.len()) } else { shown };
            shown.and_then(|class| u16::try_from(class).ok()).unwrap_or(u16::MAX)
        };
        self.points.iter().enumerate().map(class).collect()
    }

    /// The colours of the classes of [`Self::striped`].
    fn palette(&self) -> Vec<Colour> {
        let line = class_style("undecided").hatch.map_or(Colour::BLACK, |hatch| hatch.colour);
        self.labels.iter().map(|label| class_style(label).colour).chain([line]).collect()
    }

    /// Lines between neighbouring cells with different first motions.
    fn boundaries(&self, plane: &Plane) -> Line {
        let columns = plane.x.count();
        let first = |k: usize| self.points.get(k).and_then(|cell| cell.first()).map(|motion| motion.class);
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        let mut segment = |x: (f64, f64), y: (f64, f64)| {
            xs.extend([x.0, x.1, f64::NAN]);
            ys.extend([y.0, y.1, f64::NAN]);
        };
        for k in 0..self.points.len() {
            let (x, y) = (plane.x.cell(k % columns), plane.y.cell(k / columns));
            if (k + 1) % columns > 0 && first(k + 1) != first(k) {
                segment((x.1, x.1), y);
            }
            if k + columns < self.points.len() && first(k + columns) != first(k) {
                segment(x, (y.1, y.1));
            }
        }
        Line::new(xs, ys, Colour::BLACK).width(1.0)
    }
}

/// The figure of `vibro map`: a plane, or the shares of the motions over one axis; and whether cells are divided between motions
/// that coexist, and whether lines are drawn between cells with different motions.
pub(crate) fn figure<V: Varied, F: FieldName>(
    found: &RegionMap<V, F>,
    units: &Units,
    title: String,
    divided: (bool, bool),
) -> Result<Figure, ReportError> {
    let motions = PointMotions::of_map(found, None, units);
    match Sides::of(&found.axes, units)? {
        Sides::Line(side) => Ok(shares::draw(&side, &motions, title)),
        Sides::Plane(plane) => draw_with(&plane, &motions, title, divided),
    }
}

/// Draws a map, and says as `figure` what is drawn.
///
/// # Errors
/// As [`draw`].
pub fn draw_with(
    plane: &Plane,
    motions: &PointMotions,
    title: String,
    (stripes, boundaries): (bool, bool),
) -> Result<Figure, ReportError> {
    let cells = motions.by_label(if stripes { usize::MAX } else { 1 });
    let lines = boundaries.then(|| cells.boundaries(plane));
    let mut figure = draw(plane, &cells, title)?;
    if let (Some(lines), Some(panel)) = (lines, figure.panels.first_mut()) {
        panel.add(lines);
    }
    Ok(figure)
}

/// Draws a map.
///
/// # Errors
/// [`ReportError::Plot`] if the number of cells is not the number of points of the plane.
pub fn draw(plane: &Plane, cells: &PointMotions, title: String) -> Result<Figure, ReportError> {
    let split = cells.points.len() <= SPLIT;
    let panel = Panel::new(plane.x.axis(), plane.y.axis());
    let columns = plane.x.count();
    let panel = match (plane.x.even(), plane.y.even()) {
        (Some(x), Some(y)) if !split => {
            let shape = (columns, plane.y.count());
            panel.with(Raster::centred(x, y, shape, cells.striped(columns), cells.palette())?)
        }
        _ => {
            let styles: Vec<ClassStyle> = cells.labels.iter().map(|label| class_style(label)).collect();
            let mut rects = Rects::new(styles);
            for (k, cell) in cells.points.iter().enumerate().filter(|(_, cell)| !cell.is_empty()) {
                let classes: Vec<usize> = cell.iter().map(|motion| motion.class).collect();
                rects.cell(plane.x.cell(k % columns), plane.y.cell(k / columns), &classes);
            }
            panel.with(rects)
        }
    };
    let legend = legend(cells.labels.iter().map(String::as_str), |label| Key::Patch(class_style(label)));
    Ok(Figure::new(panel).size(680.0, 620.0).title(title).legend(legend))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::coloured::Value;
    use crate::figure::plane::PlaneAxis;
    use vibroimpact_plot::Mark;
    use vibroimpact_study::{Span, Values};

    fn plane(columns: u32, rows: u32) -> Plane {
        let side = |name: &str, count: u32| {
            PlaneAxis::new(name, &Values::Span(format!("0:1:{count}").parse::<Span>().unwrap())).unwrap()
        };
        Plane { x: side("inverse_beta", columns), y: side("gap", rows) }
    }

    fn cells(of: &[&[&str]]) -> PointMotions {
        let mut cells = PointMotions::default();
        for labels in of {
            cells.push(labels.iter().map(|label| (*label, 1.0 / labels.len() as f64, Value::Undefined)));
        }
        cells
    }

    #[test]
    fn labels_of_one_group_have_colours_and_entries_of_their_own() {
        let figure = draw(&plane(2, 2), &cells(&[&["2/2"], &["3/3", "2/2"], &["0"], &["undecided"]]), String::new());
        let figure = figure.unwrap();
        let Mark::Rects(rects) = &figure.panels[0].marks[0] else { panic!("cells") };
        assert_eq!(rects.rects.iter().map(|rect| rect.class).collect::<Vec<_>>(), [0, 1, 0, 2, 3]);
        assert_eq!(rects.styles, ["2/2", "3/3", "0", "undecided"].map(class_style));
        assert_ne!(rects.styles[0].colour, rects.styles[1].colour);
        let svg = figure.to_svg();
        for text in [">no impact<", ">2/2<", ">3/3<", ">undecided<"] {
            assert!(svg.contains(text), "{text}");
        }
    }

    #[test]
    fn boundaries_run_between_cells_with_different_motions() {
        let plane = plane(2, 2);
        let lines = cells(&[&["1/1"], &["1/1", "0"], &["1/1"], &["2/1"]]).boundaries(&plane);
        // the upper right cell differs from its neighbours to the left and below
        let ends = |k: usize| [(lines.xs[k], lines.ys[k]), (lines.xs[k + 1], lines.ys[k + 1])];
        assert_eq!(lines.xs.len(), 6);
        assert_eq!([ends(0), ends(3)], [[(0.5, 0.5), (1.5, 0.5)], [(0.5, 0.5), (0.5, 1.5)]]);
    }

    /// With many cells coexisting motions are stripes with the widths of their shares, and undecided cells are hatched.
    #[test]
    fn a_raster_has_stripes_and_hatches() {
        let (columns, rows) = (240, 240);
        let mut many = PointMotions::default();
        for k in 0..columns * rows {
            let two = [("1/1", 0.75, Value::Undefined), ("0", 0.25, Value::Undefined)];
            let one = [("undecided", 1.0, Value::Undecided)];
            many.push(if k % columns < 120 { two.as_slice() } else { &one }.iter().copied());
        }
        let classes = many.striped(columns);
        let (mut counts, mut line) = ([0_u32; 4], 0_usize);
        for (k, class) in classes.iter().enumerate() {
            counts[usize::from(*class)] += 1;
            line += usize::from(k % columns < 120 && *class == 1);
        }
        assert_eq!((counts[0], line), (120 * 240 * 3 / 4, 120 * rows / 4));
        let part = f64::from(counts[3]) / f64::from(counts[2] + counts[3]);
        assert!((part - 13.0 / 49.0).abs() < 0.01, "{part}");
        let side = |n: usize| u32::try_from(n).unwrap();
        let figure = draw(&plane(side(columns), side(rows)), &many, String::new()).unwrap();
        assert!(matches!(figure.panels[0].marks[0], Mark::Raster(_)));
    }

    #[test]
    fn groups_are_named_where_there_are_many_labels() {
        let mut many = PointMotions::default();
        (5..25).for_each(|m| many.push([(format!("{m}/1").as_str(), 1.0, Value::Undefined)].into_iter()));
        let figure = draw(&plane(10, 2), &many, String::new()).unwrap();
        assert_eq!(figure.legend.as_ref().unwrap().entries.len(), 1);
        let Mark::Rects(rects) = &figure.panels[0].marks[0] else { panic!("cells") };
        assert_eq!(rects.styles[1], class_style("6/1"));
    }

    #[test]
    fn labels_of_one_style_share_an_entry() {
        let figure = draw(&plane(2, 2), &cells(&[&["12/2"], &["15/3"], &["13/3"], &["15/3"]]), String::new()).unwrap();
        assert_eq!(class_style("12/2"), class_style("15/3"));
        let texts: Vec<&str> =
            figure.legend.iter().flat_map(|legend| &legend.entries).map(|entry| &*entry.label).collect();
        assert_eq!(texts, ["12/2, 15/3", "13/3"]);
    }
}
