//! The figure of a curve of events in the plane of its two parameters, with its points of codimension two.

use crate::Asked;
use crate::figure::styles::{CURVE_MARKS, EVENT_COLOURS};
use crate::figure::{label, named, title_without};
use std::collections::BTreeMap;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, Stroke};
use vibroimpact_study::{CurvePlan, EventCurve, Stretch};

/// Size of a mark.
const MARK: f64 = 13.0;
/// Width of the curve.
const WIDTH: f64 = 2.8;

/// The figure of `vibro curve`.
#[must_use]
pub fn figure(found: &EventCurve, plan: &CurvePlan, asked: &Asked) -> Figure {
    let (p, q) = (plan.vary.parameter, plan.and.parameter);
    let (x, y) = (asked.units.of(p), asked.units.of(q));
    let axis = |stretch: &Stretch, unit: f64| {
        FigureAxis::new(named(stretch.parameter, &asked.units)).range(stretch.from * unit, stretch.to * unit)
    };
    let mut panel = Panel::new(axis(&plan.vary, x), axis(&plan.and, y));
    let colour = EVENT_COLOURS.iter().find(|(kind, _)| *kind == plan.kind).map_or(Colour::BLACK, |(_, colour)| *colour);
    let mut legend = Legend::below();
    for (physical, dash) in [(true, Dash::Solid), (false, Dash::Dotted)] {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        let mut last = false;
        for pair in found.points.windows(2) {
            // an event separates two parts, so a step takes its look from the end that is no event
            let one = if pair[1].event.is_some() && pair[0].event.is_none() { &pair[0] } else { &pair[1] };
            let belongs = one.physical == physical;
            if belongs && !last {
                xs.extend([f64::NAN, pair[0].values.0 * x]);
                ys.extend([f64::NAN, pair[0].values.1 * y]);
            }
            if belongs {
                xs.push(pair[1].values.0 * x);
                ys.push(pair[1].values.1 * y);
            }
            last = belongs;
        }
        if xs.is_empty() {
            continue;
        }
        let name = if physical { "" } else { ", inadmissible" };
        let stroke = Stroke::new(colour).width(WIDTH).dash(dash);
        legend = legend.line(stroke, format!("{} of {}{name}", plan.kind.name(), label(plan.label.trim())));
        panel.add(Line { xs, ys, stroke });
    }
    for (kind, points) in marks(found, x, y) {
        legend = legend.points(&points, kind);
        panel.add(points);
    }
    let begin = found.points.get(found.begin).map(|point| (point.values.0 * x, point.values.1 * y));
    if let Some((x, y)) = begin {
        let points = Points::new([x], [y], Colour::BLACK).size(8.0);
        legend = legend.points(&points, "found on the branch");
        panel.add(points);
    }
    Figure::new(panel).size(680.0, 520.0).title(title_without(asked, &[p, q])).legend(legend)
}

/// The marks of points of codimension two, by kind. Ends of the curve have no marks.
fn marks(found: &EventCurve, x: f64, y: f64) -> BTreeMap<&'static str, Points> {
    let mut marks: BTreeMap<&'static str, Points> = BTreeMap::new();
    for point in &found.points {
        let Some((event, shape)) = CURVE_MARKS.iter().find(|(event, _)| point.event == Some(*event)) else { continue };
        let points = marks
            .entry(event.name())
            .or_insert_with(|| Points::new([], [], Colour::WHITE).shape(*shape).size(MARK).rim(Colour::BLACK));
        points.xs.push(point.values.0 * x);
        points.ys.push(point.values.1 * y);
    }
    marks
}
