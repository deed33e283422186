//! The figure of a curve of events in the plane of its two parameters, with its points of codimension two.

use crate::Varied;
use crate::figure::label;
use crate::figure::styles::{CURVE_COLOURS, CURVE_MARKS};
use crate::solutions::{CurvePointView, CurveView};
use std::collections::BTreeMap;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, Stroke};
use vibroimpact_study::Stretch;

/// Size of a mark.
const MARK: f64 = 13.0;
/// Width of the curve.
const WIDTH: f64 = 2.8;

/// The figure of `vibro curve`.
#[must_use]
pub fn figure<V: Varied>(view: &CurveView<'_, V>, title: String) -> Figure {
    let CurveView { plan, units, points, .. } = view;
    let axis = |stretch: &Stretch<V>| {
        let unit = stretch.parameter.unit(units);
        FigureAxis::new(stretch.parameter.axis(units)).range(stretch.from * unit, stretch.to * unit)
    };
    let of = view.label.to_string();
    // a motion with friction only has no impact that could name it
    let name = if of == "0" { plan.kind.name().to_owned() } else { format!("{} of {}", plan.kind.name(), label(&of)) };
    let colour = CURVE_COLOURS.iter().find(|(kind, _)| *kind == plan.kind).map_or(Colour::BLACK, |(_, colour)| *colour);
    let mut panel = Panel::new(axis(&plan.vary), axis(&plan.and));
    let mut legend = Legend::below();
    for (admissible, dash) in [(true, Dash::Solid), (false, Dash::Dotted)] {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        let mut last = false;
        for pair in points.windows(2) {
            // an event separates two parts, so a step takes its look from the end that is no event
            let one = if pair[1].event.is_some() && pair[0].event.is_none() { &pair[0] } else { &pair[1] };
            let belongs = one.admissible == admissible;
            if belongs && !last {
                xs.extend([f64::NAN, pair[0].values[0]]);
                ys.extend([f64::NAN, pair[0].values[1]]);
            }
            if belongs {
                xs.push(pair[1].values[0]);
                ys.push(pair[1].values[1]);
            }
            last = belongs;
        }
        if xs.is_empty() {
            continue;
        }
        let look = if admissible { "" } else { ", inadmissible" };
        let stroke = Stroke::new(colour).width(WIDTH).dash(dash);
        legend = legend.line(stroke, format!("{name}{look}"));
        panel.add(Line { xs, ys, stroke });
    }
    for (kind, points) in marks(points) {
        legend = legend.points(&points, kind);
        panel.add(points);
    }
    if let Some(CurvePointView { values: [x, y], .. }) = points.get(view.begin) {
        let points = Points::new([*x], [*y], Colour::BLACK).size(8.0);
        legend = legend.points(&points, "found on the branch");
        panel.add(points);
    }
    Figure::new(panel).size(680.0, 520.0).title(title).legend(legend)
}

/// The marks of points of codimension two, by kind. Ends of the curve have no marks.
fn marks(points: &[CurvePointView<'_>]) -> BTreeMap<&'static str, Points> {
    let mut marks: BTreeMap<&'static str, Points> = BTreeMap::new();
    for point in points {
        let Some((name, _)) = point.event else { continue };
        let Some((_, shape)) = CURVE_MARKS.iter().find(|(known, _)| *known == name) else { continue };
        let points = marks
            .entry(name)
            .or_insert_with(|| Points::new([], [], Colour::WHITE).shape(*shape).size(MARK).rim(Colour::BLACK));
        points.xs.push(point.values[0]);
        points.ys.push(point.values[1]);
    }
    marks
}
