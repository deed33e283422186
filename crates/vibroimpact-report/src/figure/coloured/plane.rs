//! A plane of cells in the colours of a quantity.

use super::Value;
use crate::ReportError;
use crate::figure::extremes;
use crate::figure::plane::Plane;
use vibroimpact_plot::{ClassStyle, ColourBar, Figure, FigureAxis, Legend, Panel, Raster, Rects};

/// Draws cells in the colours of their values, with a colour bar; `name` is that of the quantity. Values that are no finite number have looks of their own,
/// which the legend explains, below the `sentence`. The ends of the colours are those of `ends`, or else the smallest and the largest value.
///
/// # Errors
/// [`ReportError::Plot`] if the number of cells is not the number of points of the plane.
pub fn draw(
    plane: &Plane,
    cells: &[Value],
    (name, sentence): (String, Option<&str>),
    ends: Option<(f64, f64)>,
) -> Result<Figure, ReportError> {
    let range = ends.unwrap_or_else(|| extremes(cells.iter().filter_map(|cell| cell.finite())));
    let bar = ColourBar::new(FigureAxis::new(name).range(range.0, range.1));
    let colours = ColourBar::palette();
    let class = |value: &Value| value.finite().map(|number| bar.step(number));
    let panel = Panel::new(plane.x.axis(), plane.y.axis());
    let panel = match (plane.x.even(), plane.y.even()) {
        (Some(x), Some(y)) => {
            let steps =
                cells.iter().map(|cell| class(cell).and_then(|step| u16::try_from(step).ok()).unwrap_or(u16::MAX));
            let shape = (plane.x.count(), plane.y.count());
            panel.with(Raster::centred(x, y, shape, steps.collect::<Vec<u16>>(), colours)?)
        }
        _ => {
            let styles: Vec<ClassStyle> = colours.into_iter().map(ClassStyle::plain).collect();
            panel.with(runs(plane, cells, &class, styles))
        }
    };
    let place = |value: &Value| Value::MISSING.iter().position(|missing| missing == value);
    let styles = Value::MISSING.map(|value| value.look().0);
    let panel = panel.with(runs(plane, cells, &place, styles.to_vec()));
    let mut legend = Legend::below();
    legend.title = sentence.map(str::to_owned);
    for value in Value::MISSING.into_iter().filter(|value| cells.contains(value)) {
        let (style, text) = value.look();
        legend = legend.patch(style, text);
    }
    let figure = Figure::new(panel).size(680.0, 580.0).legend(legend);
    Ok(if range.0 <= range.1 { figure.colour_bar(bar) } else { figure })
}

/// The cells that have a class, as rectangles; neighbours of one class in a row are one rectangle.
fn runs(plane: &Plane, cells: &[Value], class: &dyn Fn(&Value) -> Option<usize>, styles: Vec<ClassStyle>) -> Rects {
    let mut rects = Rects::new(styles);
    for (j, row) in cells.chunks(plane.x.count()).enumerate() {
        let mut i = 0;
        for run in row.chunk_by(|a, b| class(a) == class(b)) {
            let (first, last) = (plane.x.cell(i), plane.x.cell(i + run.len() - 1));
            i += run.len();
            if let Some(class) = class(&run[0]) {
                // the values of an axis may fall
                rects.cell((first.0.min(last.0), first.1.max(last.1)), plane.y.cell(j), &[class]);
            }
        }
    }
    rects
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::plane::PlaneAxis;
    use vibroimpact_plot::colour_at;
    use vibroimpact_study::Values;

    fn plane(x: &str, y: &str) -> Plane {
        let side = |text: &str| PlaneAxis::new("x", &Values::Span(text.parse().unwrap())).unwrap();
        Plane { x: side(x), y: side(y) }
    }

    /// Values beyond a given range have the colours of its ends.
    #[test]
    fn the_range_can_be_given() {
        let cells = [0.0, 1.0, 2.0, 5.0].map(Value::Finite);
        let of = |ends| draw(&plane("1:2:2", "0:1:2"), &cells, ("speed".to_owned(), None), ends).unwrap();
        let Some(bar) = of(Some((1.0, 2.0))).colour_bar else { panic!("a bar") };
        assert_eq!(bar.axis.range, Some((1.0, 2.0)));
        assert_eq!(cells.map(|cell| bar.step(cell.finite().unwrap())), [0, 0, 255, 255]);
        assert_eq!(of(None).colour_bar.unwrap().axis.range, Some((0.0, 5.0)));
    }

    /// A plane of two by two cells over a logarithmic axis: the smallest value has the dark end, the largest the light
    /// one, and values that are missing have a row in the legend.
    #[test]
    fn the_ends_of_the_colours_are_the_ends_of_the_values() {
        let cells = [Value::Finite(1.0), Value::Finite(3.0), Value::Undecided, Value::Infinite];
        for (x, raster) in [("1:100:2:log", false), ("1:100:2", true)] {
            let name = "largest impact speed".to_owned();
            let svg = draw(&plane(x, "0:1:2"), &cells, (name, Some("a sentence")), None).unwrap().to_svg();
            for text in ["largest impact speed<", "undecided<", "infinite<", "a sentence<", "<linearGradient"] {
                assert!(svg.contains(text), "{text}: {svg}");
            }
            assert!(!svg.contains("not computed<") && !svg.contains("not defined<"));
            assert_eq!(svg.contains("<image"), raster);
            for end in
                [0.0, 1.0].map(|place| format!("shape-rendering=\"crispEdges\" fill=\"{}\"", colour_at(place).to_hex()))
            {
                assert_eq!(svg.contains(&end), !raster, "{end}");
            }
        }
    }

    #[test]
    fn without_any_value_there_is_no_bar() {
        let svg =
            draw(&plane("1:2:2", "0:1:2"), &[Value::NotComputed; 4], ("name".to_owned(), None), None).unwrap().to_svg();
        assert!(!svg.contains("<linearGradient") && svg.contains("not computed<"));
    }

    #[test]
    fn a_row_of_equal_cells_is_one_rectangle_whichever_way_the_axis_runs() {
        for x in ["0:4:5", "4:0:5"] {
            let rects =
                runs(&plane(x, "0:1:2"), &[Value::Undecided; 10], &|_| Some(0), vec![Value::Undecided.look().0]);
            assert_eq!(rects.rects.iter().map(|rect| rect.x).collect::<Vec<_>>(), [(-0.5, 4.5); 2], "{x}");
        }
    }
}
