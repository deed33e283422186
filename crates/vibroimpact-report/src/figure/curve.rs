//! The figure of a curve of events in the plane of its two parameters, with its points of codimension two.

use crate::figure::styles::{CURVE_COLOURS, CURVE_MARKS};
use crate::figure::{label, title_without};
use crate::json::curve::values;
use crate::{Asked, Units, Varied};
use std::collections::BTreeMap;
use vibroimpact::continuation::machine;
use vibroimpact::continuation::{CurvePoint, machine::SolutionPoint};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, Shape, Stroke};
use vibroimpact_study::{CurvePlan, EventCurve, Stretch};

/// Size of a mark.
const MARK: f64 = 13.0;
/// Width of the curve.
const WIDTH: f64 = 2.8;

/// The figure of `vibro curve`.
#[must_use]
pub fn figure(found: &EventCurve, plan: &CurvePlan, asked: &Asked) -> Figure {
    let title = title_without(asked, &[plan.vary.parameter, plan.and.parameter]);
    let event = |point: &CurvePoint| point.event.map(|event| event.name());
    let drawn = found.points.iter().map(|point| Drawn::new(point.values, point.physical, event(point)));
    let label = plan.label.as_deref().unwrap_or_default().trim();
    draw(found, (plan, &asked.units), drawn, label).title(title)
}

/// The same of a machine.
#[must_use]
pub fn of_machine(
    found: &EventCurve<Cycle, SolutionPoint, machine::CurvePoint>,
    plan: &CurvePlan<String>,
    title: String,
) -> Figure {
    let event = |point: &machine::CurvePoint| point.event.map(|event| event.name());
    let drawn = found.points.iter().map(|point| Drawn::new(point.values, true, event(point)));
    let label = found.chosen.cycle.label.to_string();
    draw(found, (plan, &Units::default()), drawn, &label).title(title)
}

/// A curve of an orbit with this label.
fn draw<C, E, P, V: Varied>(
    found: &EventCurve<C, E, P>,
    (plan, units): (&CurvePlan<V>, &Units),
    drawn: impl Iterator<Item = Drawn>,
    of: &str,
) -> Figure {
    let axis = |stretch: &Stretch<V>| {
        let unit = stretch.parameter.unit(units);
        FigureAxis::new(stretch.parameter.axis(units)).range(stretch.from * unit, stretch.to * unit)
    };
    let drawn = drawn.map(|point| Drawn { at: values(point.at, plan, units).into(), ..point });
    // a motion with friction only has no impact that could name it
    let name = if of == "0" { plan.kind.name().to_owned() } else { format!("{} of {}", plan.kind.name(), label(of)) };
    let colour = CURVE_COLOURS.iter().find(|(kind, _)| *kind == plan.kind).map_or(Colour::BLACK, |(_, colour)| *colour);
    picture((axis(&plan.vary), axis(&plan.and)), &drawn.collect::<Vec<_>>(), (colour, &name), found.begin)
}

/// A point of a curve as it is drawn.
struct Drawn {
    at: (f64, f64),
    physical: bool,
    /// The name of an event, and its mark if it has one.
    event: Option<(&'static str, Option<Shape>)>,
}

impl Drawn {
    fn new(at: (f64, f64), physical: bool, event: Option<&'static str>) -> Self {
        let mark = |name| CURVE_MARKS.iter().find(|(known, _)| *known == name).map(|(_, shape)| *shape);
        Self { at, physical, event: event.map(|name| (name, mark(name))) }
    }
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
