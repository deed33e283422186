//! The figure of a curve of events in the plane of its two parameters, with its points of codimension two.

use crate::Asked;
use crate::figure::styles::{CURVE_MARKS, EVENT_COLOURS, MACHINE_CURVE_MARKS, MACHINE_EVENT_COLOURS};
use crate::figure::{label, named, title_without};
use std::collections::BTreeMap;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, Shape, Stroke, plain};
use vibroimpact_study::{CurvePlan, EventCurve, MachineEventCurve, Name, Stretch, Variable};

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
    let colour = EVENT_COLOURS.iter().find(|(kind, _)| *kind == plan.kind).map_or(Colour::BLACK, |(_, colour)| *colour);
    let drawn = found.points.iter().map(|point| Drawn {
        at: (point.values.0 * x, point.values.1 * y),
        physical: point.physical,
        event: point.event.map(|event| {
            let name = event.name();
            let shape = CURVE_MARKS.iter().find(|(known, _)| *known == name).map(|(_, shape)| *shape);
            (name, shape)
        }),
    });
    let name = format!("{} of {}", plan.kind.name(), label(plan.label.as_deref().unwrap_or_default().trim()));
    let axes = (axis(&plan.vary, x), axis(&plan.and, y));
    picture(axes, &drawn.collect::<Vec<_>>(), (colour, &name), found.begin).title(title_without(asked, &[p, q]))
}

/// The figure of `vibro curve --machine`.
#[must_use]
pub fn of_machine(found: &MachineEventCurve, plan: &CurvePlan<Variable>, title: String) -> Figure {
    let axis =
        |stretch: &Stretch<Variable>| FigureAxis::new(plain(stretch.parameter.text())).range(stretch.from, stretch.to);
    let colour = MACHINE_EVENT_COLOURS.iter().find(|(kind, _)| *kind == plan.kind);
    let drawn = found.points.iter().map(|point| Drawn {
        at: point.values,
        physical: true,
        event: point.event.map(|event| {
            let name = event.name();
            let shape = MACHINE_CURVE_MARKS.iter().find(|(known, _)| *known == name).map(|(_, shape)| *shape);
            (name, shape)
        }),
    });
    let of = found.label.to_string();
    // a motion with friction only has no impact that could name it
    let name = if of == "0" { plan.kind.name().to_owned() } else { format!("{} of {}", plan.kind.name(), label(&of)) };
    let colour = colour.map_or(Colour::BLACK, |(_, colour)| *colour);
    let axes = (axis(&plan.vary), axis(&plan.and));
    picture(axes, &drawn.collect::<Vec<_>>(), (colour, &name), found.begin).title(title)
}

/// A point of a curve as it is drawn.
struct Drawn {
    at: (f64, f64),
    physical: bool,
    /// The name of an event, and its mark if it has one.
    event: Option<(&'static str, Option<Shape>)>,
}

/// The figure of a curve with this colour and name, whose point number `begin` was found on a branch.
fn picture(axes: (FigureAxis, FigureAxis), points: &[Drawn], (colour, name): (Colour, &str), begin: usize) -> Figure {
    let mut panel = Panel::new(axes.0, axes.1);
    let mut legend = Legend::below();
    for (physical, dash) in [(true, Dash::Solid), (false, Dash::Dotted)] {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        let mut last = false;
        for pair in points.windows(2) {
            // an event separates two parts, so a step takes its look from the end that is no event
            let one = if pair[1].event.is_some() && pair[0].event.is_none() { &pair[0] } else { &pair[1] };
            let belongs = one.physical == physical;
            if belongs && !last {
                xs.extend([f64::NAN, pair[0].at.0]);
                ys.extend([f64::NAN, pair[0].at.1]);
            }
            if belongs {
                xs.push(pair[1].at.0);
                ys.push(pair[1].at.1);
            }
            last = belongs;
        }
        if xs.is_empty() {
            continue;
        }
        let look = if physical { "" } else { ", inadmissible" };
        let stroke = Stroke::new(colour).width(WIDTH).dash(dash);
        legend = legend.line(stroke, format!("{name}{look}"));
        panel.add(Line { xs, ys, stroke });
    }
    for (kind, points) in marks(points) {
        legend = legend.points(&points, kind);
        panel.add(points);
    }
    if let Some(Drawn { at: (x, y), .. }) = points.get(begin) {
        let points = Points::new([*x], [*y], Colour::BLACK).size(8.0);
        legend = legend.points(&points, "found on the branch");
        panel.add(points);
    }
    Figure::new(panel).size(680.0, 520.0).legend(legend)
}

/// The marks of points of codimension two, by kind. Ends of the curve have no marks.
fn marks(points: &[Drawn]) -> BTreeMap<&'static str, Points> {
    let mut marks: BTreeMap<&'static str, Points> = BTreeMap::new();
    for point in points {
        let Some((name, Some(shape))) = point.event else { continue };
        let points = marks
            .entry(name)
            .or_insert_with(|| Points::new([], [], Colour::WHITE).shape(shape).size(MARK).rim(Colour::BLACK));
        points.xs.push(point.at.0);
        points.ys.push(point.at.1);
    }
    marks
}
