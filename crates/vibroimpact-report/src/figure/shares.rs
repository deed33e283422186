//! The motions over one parameter: the shares of starts that lead to each, as stacked bars.

use crate::figure::plane::PlaneAxis;
use crate::figure::point_motion::{PointMotions, legend};
use vibroimpact_plot::{ClassStyle, Figure, FigureAxis, Key, Panel, Rect, Rects, class_style};

/// Draws the shares of the motions at each value of an axis, from the first label of the legend upwards.
#[must_use]
pub fn draw(side: &PlaneAxis, motions: &PointMotions, title: String) -> Figure {
    let order = motions.in_order();
    let mut rects = Rects::new(motions.labels.iter().map(|label| class_style(label)).collect::<Vec<ClassStyle>>());
    for (k, point) in motions.points.iter().enumerate() {
        let mut low = 0.0;
        for &class in &order {
            let share: f64 = point.iter().filter(|motion| motion.class == class).map(|motion| motion.share).sum();
            if share > 0.0 {
                rects.rects.push(Rect { x: side.cell(k), y: (low, low + share), class });
                low += share;
            }
        }
    }
    let present = order.into_iter().filter(|class| rects.rects.iter().any(|rect| rect.class == *class));
    let labels: Vec<&str> = present.map(|class| motions.labels[class].as_str()).collect();
    let panel = Panel::new(side.axis(), FigureAxis::new("share of starts").range(0.0, 1.0)).with(rects);
    Figure::new(panel).title(title).legend(legend(labels.into_iter(), |label| Key::Patch(class_style(label))))
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
        let mut all = PointMotions::default();
        for point in [vec![("2/1", 0.75), ("1/1", 0.25)], vec![("1/1", 0.5), ("2/1", 0.25), ("1/1", 0.25)]] {
            all.push(point.into_iter().map(|(label, share)| (label, share, Value::Undefined)));
        }
        let figure = draw(&side, &all, String::new());
        let Mark::Rects(rects) = &figure.panels[0].marks[0] else { panic!("bars") };
        let bars: Vec<_> = rects.rects.iter().map(|rect| (rect.class, rect.x, rect.y)).collect();
        let (first, second) = ((-0.5, 0.5), (0.5, 1.5));
        // 2/1 is the first label that there is
        assert_eq!(
            bars,
            [(1, first, (0.0, 0.25)), (0, first, (0.25, 1.0)), (1, second, (0.0, 0.75)), (0, second, (0.75, 1.0))]
        );
        let texts: Vec<&str> =
            figure.legend.iter().flat_map(|of| &of.entries).map(|entry| entry.label.as_str()).collect();
        assert_eq!(texts, ["1/1", "2/1"]);
    }
}
