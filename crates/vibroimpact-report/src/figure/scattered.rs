//! The motions at points that are no grid, in the colours of their labels, over the two numbers that vary first.

use crate::figure::point_motion::legend;
use crate::varied::Varied;
use crate::{ReportError, Units};
use std::borrow::Cow;
use vibroimpact_plot::{Colour, Figure, FigureAxis, Key, Panel, Points, class_style};
use vibroimpact_study::PointsPlan;

/// The largest number of points that are drawn in full size, and the sizes of few and of more points.
const FEW: usize = 2_000;
const LARGE: f64 = 8.0;
const SMALL: f64 = 4.0;

/// Draws the label of the motion at each point of a plan; a point without a motion is left out. A single number has no ordinate.
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
    let labels = labels.take(count).enumerate();
    let motions = labels.filter_map(|(k, label)| Some(((at(0, k), at(1, k)), label?)));
    Ok(draw((FigureAxis::new(across), up), count, motions).title(title))
}

/// Draws motions at places; there are so many points.
pub fn draw<'a>(
    (across, up): (FigureAxis, FigureAxis),
    count: usize,
    motions: impl Iterator<Item = ((f64, f64), Cow<'a, str>)>,
) -> Figure {
    let size = if count > FEW { SMALL } else { LARGE };
    // the rim makes light colours visible on white paper
    let dots = |label: &str| Points::new(vec![], vec![], class_style(label).colour).size(size).rim(Colour::GREY);
    let mut places: Vec<(String, Vec<f64>, Vec<f64>)> = Vec::new();
    for ((x, y), label) in motions {
        let class = places.iter().position(|(known, ..)| **known == *label).unwrap_or_else(|| {
            places.push((label.clone().into_owned(), Vec::new(), Vec::new()));
            places.len() - 1
        });
        places[class].1.push(x);
        places[class].2.push(y);
    }
    let (mut panel, mut labels) = (Panel::new(across, up), Vec::new());
    for (label, xs, ys) in places {
        panel = panel.with(Points { xs, ys, ..dots(&label) });
        labels.push(label);
    }
    let legend = legend(labels.iter().map(String::as_str), |label| Key::Point(dots(label).style));
    Figure::new(panel).size(680.0, 620.0).legend(legend)
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
