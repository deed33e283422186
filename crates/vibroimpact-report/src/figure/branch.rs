//! The bifurcation diagram: impact velocities of orbits over the parameter, stable solid and unstable dashed, with the
//! events, over what simulation finds.

use crate::figure::diagram::backdrop;
use crate::figure::tracks::{Curves, Look, velocities};
use crate::figure::{along, label, title_without, variant};
use crate::{Asked, ReportError};
use std::collections::BTreeMap;
use vibroimpact::continuation::{BranchEvent, Point};
use vibroimpact_plot::{Axis, Colour, Dash, Figure, Legend, Line, Panel, Points, SERIES, Shape, Stroke};
use vibroimpact_study::diagram::Diagram;
use vibroimpact_study::{Cut, Followed, Span};

/// What simulation finds.
const GREY: Colour = Colour::hex(0xb0_b0b0);
/// Width of a curve.
const WIDTH: f64 = 2.8;
/// Size of the mark of an event, and where there are many.
const MARK: f64 = 12.0;
const SMALL_MARK: f64 = 7.0;
/// Marks that are many.
const MANY: usize = 40;
/// Labels with a colour of their own.
const NAMED: usize = 12;
/// Colour of the others.
const OTHERS: Colour = Colour::hex(0x50_5050);

/// The figure of `vibro branch`: branches along a line, with simulation behind, and with solutions that are
/// no motions where they are asked for.
///
/// # Errors
/// [`ReportError::Plan`] where the values of the parameter leave the range of numbers in these units.
pub fn figure(
    followed: &[Followed],
    cut: &Cut,
    behind: Option<&Diagram>,
    show_virtual: bool,
    asked: &Asked,
) -> Result<Figure, ReportError> {
    let (unit, speed) = (asked.units.of(cut.vary), asked.units.velocity());
    let (from, to) = cut.ends;
    let mut panel = Panel::new(
        Axis::new(along(cut, &asked.units)).range(from.min(to) * unit, from.max(to) * unit),
        Axis::new(asked.units.named("arrival velocity *u*_−", "m/s")),
    );
    let mut legend = Legend::below();
    if let Some(diagram) = behind {
        let (a, b) = diagram.plan.over.ends();
        let over = Span::new(a * unit, b * unit, diagram.plan.over.count())?;
        for dots in backdrop(diagram, &over, asked, GREY) {
            panel.add(dots);
        }
    }
    let curves: Vec<Curves> = followed.iter().map(|branch| velocities(&branch.points)).collect();
    let colours = colours(followed);
    let mut looks: Vec<Look> = Vec::new();
    for ((label, look), (xs, ys)) in curves.into_iter().flatten() {
        if look == Look::Virtual && !show_virtual {
            continue;
        }
        if !looks.contains(&look) {
            looks.push(look);
        }
        let colour = colours.iter().find(|(name, _)| *name == label).map_or(Colour::BLACK, |(_, colour)| *colour);
        let xs: Vec<f64> = xs.into_iter().map(|x| x * unit).collect();
        let ys: Vec<f64> = ys.into_iter().map(|y| y * speed).collect();
        let (width, dash) = pen(look);
        panel.add(Line::new(xs, ys, colour).width(width).dash(dash));
    }
    for (name, colour) in colours.iter().take(NAMED) {
        legend = legend.line(Stroke::new(*colour).width(WIDTH), label(name));
    }
    if colours.len() > NAMED {
        legend = legend.line(Stroke::new(OTHERS).width(WIDTH), format!("{} others", colours.len() - NAMED));
    }
    looks.sort_unstable();
    for look in looks {
        let name = match look {
            Look::Stable => "stable",
            Look::Unstable => "unstable",
            Look::Virtual => "no motion",
        };
        let (width, dash) = pen(look);
        legend = legend.line(Stroke::new(Colour::BLACK).width(width).dash(dash), name);
    }
    for (kind, points) in marks(followed, show_virtual, unit, speed) {
        legend = legend.points(&points, kind);
        panel.add(points);
    }
    if behind.is_some() {
        // a dot of the cloud is too small for a key
        legend = legend.points(&Points::new([], [], GREY).size(7.0), "simulation");
    }
    Ok(Figure::new(panel)
        .size(680.0, 520.0)
        .title(title_without(&asked.system, &cut.parameters().collect::<Vec<_>>()))
        .legend(legend))
}

const fn pen(look: Look) -> (f64, Dash) {
    match look {
        Look::Stable => (WIDTH, Dash::Solid),
        Look::Unstable => (WIDTH, Dash::Dashed),
        Look::Virtual => (1.4, Dash::Dotted),
    }
}

/// A colour for each label, in the order in which the branches come to them.
fn colours(followed: &[Followed]) -> Vec<(String, Colour)> {
    // without black, the colour of marks, and yellow, which is too light for a thin line
    const USABLE: usize = 6;
    let mut labels: Vec<String> = Vec::new();
    for point in followed.iter().flat_map(|branch| &branch.points) {
        let label = point.cycle.label.to_string();
        if !labels.contains(&label) {
            labels.push(label);
        }
    }
    let colour = |k: usize| if k < NAMED { variant(SERIES[k % USABLE], k / USABLE) } else { OTHERS };
    labels.into_iter().enumerate().map(|(k, label)| (label, colour(k))).collect()
}

/// The marks of events by kind.
fn marks(followed: &[Followed], show_virtual: bool, unit: f64, speed: f64) -> BTreeMap<&'static str, Points> {
    let mut places: BTreeMap<&'static str, (Shape, Vec<f64>, Vec<f64>)> = BTreeMap::new();
    for point in followed.iter().flat_map(|branch| &branch.points) {
        let Some((shape, velocities)) = point.event.and_then(|event| mark(point, &event)) else { continue };
        if !point.physical && !show_virtual {
            continue;
        }
        let kind = point.event.map_or("", |event| event.name());
        let (_, xs, ys) = places.entry(kind).or_insert((shape, Vec::new(), Vec::new()));
        xs.extend(velocities.iter().map(|_| point.value * unit));
        ys.extend(velocities.iter().map(|velocity| velocity * speed));
    }
    let count: usize = places.values().map(|(_, xs, _)| xs.len()).sum();
    let size = if count > MANY { SMALL_MARK } else { MARK };
    let style = |(shape, xs, ys): (Shape, Vec<f64>, Vec<f64>)| {
        Points::new(xs, ys, Colour::WHITE).shape(shape).size(size).rim(Colour::BLACK)
    };
    places.into_iter().map(|(kind, place)| (kind, style(place))).collect()
}

/// The form of an event's mark, and the velocities it stands at: those of all impacts, or zero where one comes or goes.
fn mark(point: &Point, event: &BranchEvent) -> Option<(Shape, Vec<f64>)> {
    let all = || point.cycle.points.iter().map(|p| p.state.velocity).collect();
    Some(match event {
        BranchEvent::Fold => (Shape::Square, all()),
        BranchEvent::Flip => (Shape::Diamond, all()),
        BranchEvent::BranchPoint => (Shape::Circle, all()),
        BranchEvent::Grazing { .. } => (Shape::TriangleUp, vec![0.0]),
        BranchEvent::SoftLanding { .. } => (Shape::Plus, vec![0.0]),
        BranchEvent::LossOfContact { .. } => (Shape::TriangleDown, vec![0.0]),
        BranchEvent::EndOfRest { .. } | BranchEvent::RestForEver { .. } | BranchEvent::Chatter { .. } => {
            (Shape::Cross, vec![0.0])
        }
        _ => return None,
    })
}
