//! A quantity of all coexisting motions over one axis, as dots in the colours of their labels.

use super::Value;
use crate::figure::plane::PlaneAxis;
use crate::figure::point_motion::PointMotion;
use vibroimpact_plot::{
    Colour, Figure, FigureAxis, GROUPS, Legend, Panel, PointStyle, Points, Shape, class_style, legend_text,
};

/// Diameter of dots, and of dots over an axis with more values than [`MANY`].
const LARGE: f64 = 10.0;
const SMALL: f64 = 6.0;
const MANY: usize = 120;
/// Distance of the marks of missing values from the values, relative to the range of values.
const AWAY: f64 = 0.08;

/// Draws the values of all motions at each value of an axis; `name` is that of the quantity. Motions whose value is no finite number have crosses below the
/// others, infinite values triangles above them.
#[must_use]
pub fn draw(side: &PlaneAxis, points: &[Vec<PointMotion>], name: String, title: String) -> Figure {
    let all = || points.iter().enumerate().flat_map(|(k, motions)| motions.iter().map(move |motion| (k, motion)));
    let numbers = || all().filter_map(|(_, motion)| motion.value.finite());
    let (low, high) = (numbers().fold(f64::INFINITY, f64::min), numbers().fold(f64::NEG_INFINITY, f64::max));
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
    let mut legend = Legend::below();
    for (number, group) in GROUPS.iter().enumerate() {
        let of = all().filter(|(_, motion)| motion.group == number);
        let places = of.filter_map(|(k, motion)| motion.value.finite().map(|value| (side.at(k), value)));
        let (xs, ys): (Vec<f64>, Vec<f64>) = places.unzip();
        if xs.is_empty() {
            continue;
        }
        // the rim makes light colours visible on white paper
        let dots = Points::new(xs, ys, class_style(group).colour).size(size).rim(Colour::GREY);
        legend = legend.points(&dots, legend_text(group));
        panel.add(dots);
    }
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
        let motion = |group, value| PointMotion { group, share: 0.5, value };
        let points = [
            vec![motion(1, Value::Finite(1.0)), motion(2, Value::Finite(2.0))],
            vec![motion(1, Value::Finite(1.5)), motion(15, Value::Undecided)],
            vec![motion(12, Value::Infinite)],
        ];
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
