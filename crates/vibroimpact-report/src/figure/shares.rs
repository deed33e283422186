//! The motions over one parameter: the shares of starts that lead to each, as stacked bars.

use crate::figure::plane::PlaneAxis;
use crate::figure::point_motion::PointMotion;
use vibroimpact_plot::{Figure, FigureAxis, GROUPS, Legend, Panel, Rect, Rects, class_style, legend_text};

/// Draws the shares of the groups of motions at each value of an axis, from the first group of the legend upwards.
#[must_use]
pub fn draw(side: &PlaneAxis, points: &[Vec<PointMotion>], title: String) -> Figure {
    let mut rects = Rects::new(GROUPS.map(class_style).to_vec());
    let mut present = [false; GROUPS.len()];
    for (k, motions) in points.iter().enumerate() {
        let mut low = 0.0;
        for (class, present) in present.iter_mut().enumerate() {
            let share: f64 = motions.iter().filter(|motion| motion.group == class).map(|motion| motion.share).sum();
            if share > 0.0 {
                *present = true;
                rects.rects.push(Rect { x: side.cell(k), y: (low, low + share), class });
                low += share;
            }
        }
    }
    let mut legend = Legend::below();
    for (group, _) in GROUPS.iter().zip(present).filter(|(_, present)| *present) {
        legend = legend.patch(class_style(group), legend_text(group));
    }
    let panel = Panel::new(side.axis(), FigureAxis::new("share of starts").range(0.0, 1.0)).with(rects);
    Figure::new(panel).title(title).legend(legend)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::coloured::Value;
    use vibroimpact_plot::Mark;
    use vibroimpact_study::{Span, Values};

    #[test]
    fn bars_are_stacked_in_the_order_of_the_legend() {
        let side = PlaneAxis::new("gap", &Values::Span("0:1:2".parse::<Span>().unwrap())).unwrap();
        let motion = |group, share| PointMotion { group, share, value: Value::Undefined };
        let points = [vec![motion(2, 0.75), motion(1, 0.25)], vec![motion(1, 0.5), motion(2, 0.25), motion(1, 0.25)]];
        let figure = draw(&side, &points, String::new());
        let Mark::Rects(rects) = &figure.panels[0].marks[0] else { panic!("bars") };
        let bars: Vec<_> = rects.rects.iter().map(|rect| (rect.class, rect.x, rect.y)).collect();
        let (first, second) = ((-0.5, 0.5), (0.5, 1.5));
        assert_eq!(
            bars,
            [(1, first, (0.0, 0.25)), (2, first, (0.25, 1.0)), (1, second, (0.0, 0.75)), (2, second, (0.75, 1.0))]
        );
        assert_eq!(figure.legend.unwrap().entries.len(), 2);
    }
}
