//! The motions at points that are no grid, in the colours of their labels, over the two numbers that vary first.

use super::map::LabelledCells;
use crate::varied::Varied;
use crate::{ReportError, Units};
use std::borrow::Cow;
use vibroimpact_plot::{Figure, FigureAxis, Panel, Points, class_style};
use vibroimpact_study::PointsPlan;

/// The largest number of points that are drawn in full size, and the size of more points.
const FEW: usize = 2_000;
const SMALL: f64 = 4.0;

/// Draws the label of the motion at each point; a point without a motion is left out. A single number has no ordinate.
///
/// # Errors
/// [`ReportError::Scattered`] if nothing varies.
pub(crate) fn figure<'a, V: Varied + Into<Cow<'static, str>>>(
    points: &PointsPlan<V>,
    labels: impl Iterator<Item = Option<Cow<'a, str>>>,
    units: &Units,
    title: String,
) -> Result<Figure, ReportError> {
    let (width, count) = (points.width(), usize::try_from(points.count()).unwrap_or(usize::MAX));
    let name = |column: usize| (column < width).then(|| points.vary(column).axis(units));
    let across = name(0).ok_or(ReportError::Scattered)?;
    let up = name(1).map_or_else(|| FigureAxis::new("").range(-1.0, 1.0).ticks([]), FigureAxis::new);
    let at = |column: usize, k: usize| {
        let there = (0..width).fold(*units, |units, of| points.vary(of).units_at(&units, points.at(of, k)));
        if column < width { points.at(column, k) * points.vary(column).unit(&there) } else { 0.0 }
    };
    let mut cells = LabelledCells::default();
    let mut places: Vec<(String, Vec<f64>, Vec<f64>)> = Vec::new();
    for (k, label) in labels.take(count).enumerate().filter_map(|(k, label)| Some((k, label?))) {
        let class = places.iter().position(|(known, ..)| **known == *label).unwrap_or_else(|| {
            places.push((label.clone().into_owned(), Vec::new(), Vec::new()));
            places.len() - 1
        });
        places[class].1.push(at(0, k));
        places[class].2.push(at(1, k));
        cells.push(core::iter::once((label, 1.0)));
    }
    let mut panel = Panel::new(FigureAxis::new(across), up);
    for (label, xs, ys) in places {
        let dots = Points::new(xs, ys, class_style(&label).colour);
        panel = panel.with(if count > FEW { dots.size(SMALL) } else { dots });
    }
    Ok(Figure::new(panel).size(680.0, 620.0).title(title).legend(cells.legend(class_style)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_plot::Mark;
    use vibroimpact_study::ListedColumn;

    #[test]
    fn each_label_has_its_points() {
        let column = |vary: &str, values: [f64; 3]| ListedColumn { vary: vary.to_owned(), values: values.to_vec() };
        let both = vec![column("frequency", [1.0, 2.0, 3.0]), column("q.head", [4.0, 5.0, 6.0])];
        let labels = || ["1/1", "2/1", "1/1"].into_iter().map(|label| Some(label.into()));
        let draw = |points| figure(&PointsPlan::Listed(points), labels(), &Units::default(), String::new());
        let drawn = draw(both.clone()).unwrap();
        let marks: Vec<_> = drawn.panels[0].marks.iter().collect();
        let [Mark::Points(ones), Mark::Points(twos)] = marks.as_slice() else { panic!("{marks:?}") };
        assert_eq!((ones.xs.as_slice(), ones.ys.as_slice()), (&[1.0, 3.0][..], &[4.0, 6.0][..]));
        assert_eq!((twos.xs.as_slice(), twos.ys.as_slice()), (&[2.0][..], &[5.0][..]));
        assert!(drawn.to_svg().contains(">2/1<") && draw(both[..1].to_vec()).is_ok());
        assert!(matches!(draw(Vec::new()), Err(ReportError::Scattered)));
    }
}
