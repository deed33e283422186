//! The figure of an orbit diagram: a dot for every impact or state over the parameter, with the two sweeps in two
//! colours.
//!
//! Where both sweeps have the same cycle, the small dot of one lies inside the large dot of the other, so both colours
//! are visible. Motions that do not repeat have small dots in both sweeps.

use crate::figure::{along, extremes, plane::PlaneAxis};
use crate::units::shown;
use crate::{ReportError, ShownValue, Units, Varied};
use std::collections::HashSet;
use vibroimpact_plot::{ClassStyle, Colour, Figure, FigureAxis, Legend, Panel, Points, Raster, Rects, SERIES};
use vibroimpact_study::diagram::{Diagram, DiagramPoint, DiagramStep, Sweep, SweepDirection};
use vibroimpact_study::{Values, counted};

/// Maximum number of dots, which gives a file of a few megabytes. With more dots a raster is drawn instead.
const MOST_DOTS: usize = 50_000;
/// Maximum number of columns of the raster, so that each has a pixel in print.
const MOST_COLUMNS: usize = 800;
/// Number of rows of the raster.
const CELL_ROWS: usize = 400;
/// Number of rows, finer than the eye can resolve, for the thinning of dots: of all dots in a row at the same value,
/// one is drawn.
const ROWS: f64 = 2000.0;
/// Size of a large dot relative to a small one.
const LARGE: f64 = 1.9;

/// The dots of one colour: number of the value, and ordinate.
struct Cloud {
    name: String,
    colour: Colour,
    large: Vec<(u32, f64)>,
    small: Vec<(u32, f64)>,
}

/// The dots of the motion at one value.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The number of the value.
    pub index: u32,
    /// How its start was chosen.
    pub sweep: Sweep,
    /// Whether the motion repeats, that is, has fewer points than the plan allows.
    pub repeats: bool,
    /// The ordinates.
    pub ys: Vec<f64>,
}

/// The figure of `vibro diagram`.
pub(crate) fn figure<V: Varied, S: ShownValue>(
    found: &Diagram<V, S>,
    units: &Units,
    title: String,
) -> Result<Figure, ReportError> {
    let plan = &found.plan;
    let over = shown(&plan.over, plan.vary.unit(units))?;
    let side = PlaneAxis::new(along(&plan.cut(), units), &over)?;
    let axes = (&side, FigureAxis::new(plan.show.ordinate(units)));
    let figure = draw(&motions(found, units), (&over, plan.direction, &plan.vary.mark(units)), axes)?;
    Ok(figure.title(title))
}

/// Draws a dot for every point.
///
/// # Errors
/// [`ReportError::Plot`] for a raster that cannot be drawn.
pub fn draw(
    motions: &[Motion],
    (over, direction, symbol): (&Values, SweepDirection, &str),
    (side, ordinate): (&PlaneAxis, FigureAxis),
) -> Result<Figure, ReportError> {
    let mut clouds = clouds(motions, direction, symbol);
    let range = spread(motions.iter().flat_map(|motion| motion.ys.iter().copied()));
    for cloud in &mut clouds {
        thin(&mut cloud.large, range);
        thin(&mut cloud.small, range);
    }
    let panel = Panel::new(side.axis(), ordinate.range(range.0, range.1));
    let dots: usize = clouds.iter().map(|cloud| cloud.large.len() + cloud.small.len()).sum();
    let (panel, legend) =
        if dots > MOST_DOTS { as_cells(panel, &clouds, (over, side), range)? } else { as_dots(panel, clouds, over) };
    Ok(Figure::new(panel).legend(legend))
}

/// All dots of a diagram in one colour, to be drawn behind curves. Dots of motions that repeat are wider than a curve.
pub(super) fn backdrop<V: Varied, S: ShownValue>(
    found: &Diagram<V, S>,
    units: &Units,
    colour: Colour,
) -> Result<[Points; 2], ReportError> {
    let (motions, over) = (motions(found, units), shown(&found.plan.over, found.plan.vary.unit(units))?);
    let range = spread(motions.iter().flat_map(|motion| motion.ys.iter().copied()));
    Ok([(true, WIDE), (false, NARROW)].map(|(repeating, size)| {
        let shown = motions.iter().filter(|motion| motion.repeats == repeating);
        let mut dots: Vec<(u32, f64)> = shown.flat_map(|motion| motion.ys.iter().map(|y| (motion.index, *y))).collect();
        thin(&mut dots, range);
        let (xs, ys): (Vec<f64>, Vec<f64>) = dots.into_iter().map(|(k, y)| (over.at(k as usize), y)).unzip();
        Points::new(xs, ys, colour).size(size)
    }))
}

/// Sizes of the dots behind curves.
const WIDE: f64 = 7.0;
const NARROW: f64 = 2.6;

/// The ordinate of a point, in these units and that of a quantity.
fn ordinate_of(point: &DiagramPoint, units: &Units, quantity: f64) -> f64 {
    match point {
        DiagramPoint::Impact { speed, .. } => speed * units.velocity(),
        DiagramPoint::Chatter { .. } => 0.0,
        DiagramPoint::State { x, .. } => x * units.length(),
        DiagramPoint::Value(value) => value * quantity,
    }
}

/// The dots of an orbit diagram.
fn motions<V: Varied, S: ShownValue>(found: &Diagram<V, S>, units: &Units) -> Vec<Motion> {
    let plan = &found.plan;
    let motion = |step: &DiagramStep| {
        let units = plan.vary.units_at(units, plan.over.at(step.index as usize));
        let quantity = plan.show.quantity_unit(&units);
        Motion {
            index: step.index,
            sweep: step.sweep,
            repeats: step.repeats(plan.keep),
            ys: step.points.iter().map(|point| ordinate_of(point, &units, quantity)).collect(),
        }
    };
    found.steps.iter().map(motion).collect()
}

fn clouds(motions: &[Motion], direction: SweepDirection, symbol: &str) -> Vec<Cloud> {
    let cloud = |name: String, colour| Cloud { name, colour, large: Vec::new(), small: Vec::new() };
    let rising = || cloud(format!("{symbol} rising"), SERIES[0]);
    let falling = || cloud(format!("{symbol} falling"), SERIES[1]);
    let mut clouds = match direction {
        SweepDirection::Up => vec![rising()],
        SweepDirection::Down => vec![falling()],
        SweepDirection::Both => vec![rising(), falling()],
        SweepDirection::Scatter { starts, .. } => {
            vec![cloud(format!("{} at each value", counted(starts, "start")), SERIES[0])]
        }
    };
    let both = clouds.len() > 1;
    for motion in motions {
        let above = usize::from(both && motion.sweep == Sweep::Down);
        let cloud = &mut clouds[above];
        let list = if both && above == 0 && motion.repeats { &mut cloud.large } else { &mut cloud.small };
        list.extend(motion.ys.iter().map(|y| (motion.index, *y)));
    }
    clouds
}

/// The range of all values, with a margin.
fn spread(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = extremes(values);
    if low > high {
        return (0.0, 1.0);
    }
    // if all values are equal to rounding, the range is proportional to the value
    let size = low.abs().max(high.abs());
    let air = match size {
        // zero to rounding
        _ if size < 1e-14 => 1.0,
        _ if high - low > 1e-9 * size => 0.04 * (high - low),
        _ => 0.5 * size,
    };
    (low - air, high + air)
}

/// Keeps one dot, the first one, for each row and value.
fn thin(dots: &mut Vec<(u32, f64)>, (low, high): (f64, f64)) {
    let mut seen = HashSet::new();
    #[allow(clippy::cast_possible_truncation)] // between 0 and ROWS
    dots.retain(|(k, y)| seen.insert((*k, (ROWS * ((y - low) / (high - low))) as i32)));
}

fn as_dots(mut panel: Panel, clouds: Vec<Cloud>, over: &Values) -> (Panel, Legend) {
    // about the distance between two values on the page, within limits for visibility
    #[allow(clippy::cast_precision_loss)] // a million at most
    let size = (850.0 / over.count() as f64).clamp(2.4, 6.0);
    let mut legend = Legend::below();
    for cloud in clouds {
        let points = |dots: &[(u32, f64)], size: f64| {
            let (xs, ys): (Vec<f64>, Vec<f64>) = dots.iter().map(|(k, y)| (over.at(*k as usize), *y)).unzip();
            Points::new(xs, ys, cloud.colour).size(size)
        };
        let small = points(&cloud.small, size);
        legend = legend.points(&small, cloud.name);
        panel.add(points(&cloud.large, LARGE * size));
        panel.add(small);
    }
    (panel, legend)
}

/// The number of value `k` in rising order (and its inverse, which is the same function).
fn rising(over: &Values, k: usize) -> usize {
    let (a, b) = over.ends();
    if a <= b { k } else { over.count() - 1 - k }
}

/// The classes of the cells of a raster, row by row from below, and the number of columns: that of the values of a range, or less
/// by an integer factor. A class is the number of a cloud; cells without a dot have [`u16::MAX`].
fn cells(clouds: &[Cloud], (over, side): (&Values, &PlaneAxis), range: (f64, f64)) -> (usize, Vec<u16>) {
    let values = over.count();
    let columns = match over {
        Values::Span(_) => values / values.div_ceil(MOST_COLUMNS),
        // listed values may be close to each other
        Values::Listed(_) => MOST_COLUMNS,
    };
    let rows = CELL_ROWS;
    let mut cells = vec![(u16::MAX, false); columns * rows];
    let across = side.range();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)] // a few hundred
    let place = |at: f64, (low, high): (f64, f64), count: usize| {
        ((((at - low) / (high - low)) * count as f64) as usize).min(count - 1)
    };
    let column = |k: u32| {
        if side.logarithmic() {
            rising(over, k as usize) * columns / values
        } else {
            place(over.at(k as usize), across, columns)
        }
    };
    for (class, cloud) in (0_u16..).zip(clouds) {
        for (dots, small) in [(&cloud.large, false), (&cloud.small, true)] {
            let reach = usize::from(!small);
            for (k, y) in dots {
                let (i, j) = (column(*k), place(*y, range, rows));
                for j in j.saturating_sub(reach)..(j + reach + 1).min(rows) {
                    for i in i.saturating_sub(reach)..(i + reach + 1).min(columns) {
                        let cell = &mut cells[j * columns + i];
                        // where small dots of two sweeps meet, both colours are shown in a checkerboard
                        if !(small && cell.1 && (i + j) % 2 == 0) {
                            *cell = (class, small);
                        }
                    }
                }
            }
        }
    }
    (columns, cells.into_iter().map(|(class, _)| class).collect())
}

/// The same diagram as a raster.
fn as_cells(
    panel: Panel,
    clouds: &[Cloud],
    (over, side): (&Values, &PlaneAxis),
    range: (f64, f64),
) -> Result<(Panel, Legend), ReportError> {
    let (columns, classes) = cells(clouds, (over, side), range);
    let (values, rows, across) = (over.count(), CELL_ROWS, side.range());
    let legend = clouds
        .iter()
        .fold(Legend::below(), |legend, cloud| legend.patch(ClassStyle::plain(cloud.colour), cloud.name.clone()));
    let colours: Vec<Colour> = clouds.iter().map(|cloud| cloud.colour).collect();
    if side.logarithmic() {
        // on a logarithmic axis, columns of equal width do not have equal ranges of the parameter
        let edge = |i: usize| match (i * values).div_ceil(columns) {
            first if first < values => side.cell(rising(over, first)).0,
            _ => across.1,
        };
        let height = |j: usize| range.0 + (range.1 - range.0) * j as f64 / rows as f64;
        let mut rects = Rects::new(colours.into_iter().map(ClassStyle::plain).collect::<Vec<_>>());
        for (j, row) in classes.chunks(columns).enumerate() {
            let mut i = 0;
            for run in row.chunk_by(|a, b| a == b) {
                let next = i + run.len();
                if run[0] != u16::MAX {
                    rects.cell((edge(i), edge(next)), (height(j), height(j + 1)), &[usize::from(run[0])]);
                }
                i = next;
            }
        }
        return Ok((panel.with(rects), legend));
    }
    Ok((panel.with(Raster::new(across, range, (columns, rows), classes, colours)?), legend))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cells of listed values are at their values, however many values there are.
    #[test]
    fn listed_values_have_cells_at_their_places() {
        let list = vec![0.0, 0.01, 0.02, 1.0, 5.0];
        let over = Values::Listed(list.clone());
        let side = PlaneAxis::new("x", &over).unwrap();
        let dots: Vec<(u32, f64)> = (0..5).map(|k| (k, 0.5)).collect();
        let cloud = Cloud { name: "up".into(), colour: SERIES[0], large: Vec::new(), small: dots };
        let (columns, classes) = cells(&[cloud], (&over, &side), (0.0, 1.0));
        assert_eq!(classes.len(), columns * CELL_ROWS);
        let filled: Vec<usize> = (0..classes.len()).filter(|k| classes[*k] == 0).map(|k| k % columns).collect();
        let (low, high) = side.range();
        let width = (high - low) / columns as f64;
        // the first three are closer to each other than two columns
        let (near, far) = filled.split_at(filled.len() - 2);
        assert!((1..=3).contains(&near.len()) && near.iter().all(|i| (*i as f64) < 0.03 / width + 1.0), "{filled:?}");
        for (i, value) in far.iter().zip(&list[3..]) {
            let (left, right) = (low + width * *i as f64, low + width * (*i as f64 + 1.0));
            assert!(left <= *value && *value <= right, "{value}: {left} to {right}");
        }
    }
}
