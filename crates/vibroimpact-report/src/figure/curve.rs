//! The figure of a curve of events in the plane of its two parameters, with its points of codimension two.

use crate::figure::label;
use crate::figure::styles::{CURVE_MARKS, EVENT_COLOURS};
use crate::task::curve::CurveAnswer;
use crate::{Units, Varied};
use std::collections::BTreeMap;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, Stroke};
use vibroimpact_study::{CurvePlan, Stretch};

/// Size of a mark.
const MARK: f64 = 13.0;
/// Width of the curve.
const WIDTH: f64 = 2.8;

/// The figure of `vibro curve`.
pub(crate) fn figure<V: Varied>(
    answer: &CurveAnswer<'_>,
    (plan, units): (&CurvePlan<V>, &Units),
    title: String,
) -> Figure {
    let points = &answer.points;
    let axis = |stretch: &Stretch<V>| {
        let unit = stretch.parameter.unit(units);
        FigureAxis::new(stretch.parameter.axis(units)).range(stretch.from * unit, stretch.to * unit)
    };
    let (kind, of) = (plan.kind.name(), &answer.label);
    // a motion with friction only has no impact that could name it
    let name = if of == "0" { kind.to_owned() } else { format!("{kind} of {}", label(of)) };
    let colour = EVENT_COLOURS.iter().find(|(kind, _)| *kind == plan.kind).map_or(Colour::BLACK, |(_, colour)| *colour);
    let mut panel = Panel::new(axis(&plan.vary), axis(&plan.and));
    let mut legend = Legend::below();
    for (admissible, dash) in [(true, Dash::Solid), (false, Dash::Dotted)] {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        let mut last = false;
        for (k, pair) in points.windows(2).enumerate() {
            // an event separates two parts, so a step takes its look from the end that is no event
            let is_event = |place| answer.event_at(place).is_some();
            let one = if is_event(k + 1) && !is_event(k) { &pair[0] } else { &pair[1] };
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
    for (kind, points) in marks(answer) {
        legend = legend.points(&points, kind);
        panel.add(points);
    }
    if let Some([x, y]) = points.get(answer.through.point).map(|point| point.values) {
        let points = Points::new([x], [y], Colour::BLACK).size(8.0);
        legend = legend.points(&points, "found on the branch");
        panel.add(points);
    }
    Figure::new(panel).size(680.0, 520.0).title(title).legend(legend)
}

/// The marks of points of codimension two, by kind. Ends of the curve have no marks.
fn marks(answer: &CurveAnswer<'_>) -> BTreeMap<&'static str, Points> {
    let mut marks: BTreeMap<&'static str, Points> = BTreeMap::new();
    for event in &answer.events {
        let Some((_, shape)) = CURVE_MARKS.iter().find(|(known, _)| *known == event.kind) else { continue };
        let points = marks
            .entry(event.kind)
            .or_insert_with(|| Points::new([], [], Colour::WHITE).shape(*shape).size(MARK).rim(Colour::BLACK));
        points.xs.push(event.values[0]);
        points.ys.push(event.values[1]);
    }
    marks
}
