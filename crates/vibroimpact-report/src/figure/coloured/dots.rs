//! A quantity of all coexisting motions over one axis, as dots in the colours of their labels.

use super::Value;
use crate::figure::extremes;
use crate::figure::plane::PlaneAxis;
use crate::figure::point_motion::{PointMotions, legend};
use vibroimpact_plot::{Colour, Figure, FigureAxis, Key, Panel, PointStyle, Points, Shape, class_style};

/// Diameter of dots, and of dots over an axis with more values than [`MANY`].
const LARGE: f64 = 10.0;
const SMALL: f64 = 6.0;
const MANY: usize = 120;
/// Distance of the marks of missing values from the values, relative to the range of values.
const AWAY: f64 = 0.08;

/// Draws the values of all motions at each value of an axis; `name` is that of the quantity. Motions whose value is no finite number have crosses below the
/// others, infinite values triangles above them.
#[must_use]
pub fn draw(side: &PlaneAxis, motions: &PointMotions, name: String, title: String) -> Figure {
    let points = &motions.points;
    let all = || points.iter().enumerate().flat_map(|(k, motions)| motions.iter().map(move |motion| (k, motion)));
    let (low, high) = extremes(all().filter_map(|(_, motion)| motion.value.finite()));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
    let away = AWAY * if high > low { high - low } else { low.abs().max(1e-300) };
    let size = if points.len() > MANY { SMALL } else { LARGE };
    // marks of missing values need room beside the values
    let any = |wanted: &[Value]| all().any(|(_, motion)| wanted.contains(&motion.value));
    let below = match (any(&[Value::Undefined, Value::NotComputed]), any(&[Value::Undecided])) {
        (true, _) => 2.6,
        (false, true) => 1.6,
        (false, false) => 0.6,
    };
    let above = if any(&[Value::Infinite]) { 1.6 } else { 0.6 };
    let range = (low - below * away, high + above * away);
    let ordinate = FigureAxis::new(name).range(range.0, range.1);
    let mut panel = Panel::new(side.axis(), ordinate);
    // the rim makes light colours visible on white paper
    let dots = |label: &str| Points::new(vec![], vec![], class_style(label).colour).size(size).rim(Colour::GREY);
    let mut present: Vec<&str> = Vec::new();
    for class in motions.in_order() {
        let of = all().filter(|(_, motion)| motion.class == class);
        let places = of.filter_map(|(k, motion)| motion.value.finite().map(|value| (side.at(k), value)));
        let (xs, ys): (Vec<f64>, Vec<f64>) = places.unzip();
        if !xs.is_empty() {
            present.push(&motions.labels[class]);
            panel.add(Points { xs, ys, ..dots(&motions.labels[class]) });
        }
    }
    let mut legend = legend(present.into_iter(), |label| Key::Point(dots(label).style));
    for value in Value::MISSING {
        let xs: Vec<f64> = all().filter(|(_, motion)| motion.value == value).map(|(k, _)| side.at(k)).collect();
        if xs.is_empty() {
            continue;
        }
        let (y, shape, colour) = match value {
            Value::Infinite => (high + away, Shape::TriangleUp, Colour::hex(0x93_1f5c)),
            Value::Undecided => (low - away, Shape::Cross, Colour::hex(0xd0_2020)),
            _ => (low - 2.0 * away, Shape::Plus, Colour::GREY),
        };
        // neighbouring marks in a row stay apart
        let style = PointStyle { shape, size: 0.75 * size, colour, filled: true, rim: None };
        let marks = Points { ys: vec![y; xs.len()], xs, style };
        legend = legend.points(&marks, value.look().1);
        panel.add(marks);
    }
    Figure::new(panel).size(680.0, 520.0).title(title).legend(legend)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use vibroimpact_study::{Axis, Parameter, Span};

    #[test]
    fn every_motion_has_a_dot_and_every_missing_value_a_mark() {
        let axis = Axis::parameter(Parameter::Gap, "0:2:3".parse::<Span>().unwrap());
        let mut points = PointMotions::default();
        for point in [
            vec![("1/1", Value::Finite(1.0)), ("2/1", Value::Finite(2.0))],
            vec![("1/1", Value::Finite(1.5)), ("undecided", Value::Undecided)],
            vec![("inf/1", Value::Infinite)],
        ] {
            points.push(point.into_iter().map(|(label, value)| (label, 0.5, value)));
        }
        let side = PlaneAxis::of(&axis, &Units::default()).unwrap();
        let svg = draw(&side, &points, "largest impact speed".to_owned(), String::new()).to_svg();
        // one path for each kind of mark, and one in the legend; the dots have a rim each
        let dots = |group: &str| svg.matches(&format!("fill=\"{}\"/>", class_style(group).colour.to_hex())).count();
        assert_eq!((dots("1/1"), dots("2/1"), dots("inf/n")), (2, 2, 0), "{svg}");
        for text in ["1/1<", "2/1<", "undecided<", "infinite<", "largest impact speed<"] {
            assert!(svg.contains(text), "{text}: {svg}");
        }
        assert!(!svg.contains("not defined<"));
    }
}
