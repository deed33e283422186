//! The bifurcation diagram: impact velocities of orbits over the parameter, or their positions at phase 0. Stable
//! orbits are solid, neutral ones dashed and dotted, and unstable ones dashed. Events are marked, and the orbit diagram from simulation is behind.

use crate::branch_quantity::BranchQuantity;
use crate::figure::diagram::backdrop;
use crate::figure::styles::BRANCH_MARKS;
use crate::figure::tracks::{Followed as What, Look, Track, TrackPoint};
use crate::figure::{along, label, series, title_without, variant};
use crate::{Asked, ReportError, ShownValue, Units};
use std::collections::BTreeMap;
use vibroimpact::continuation::machine::SolutionPoint;
use vibroimpact_plot::{
    Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, Shape, Stroke, class_style, legend_group, plain,
};
use vibroimpact_study::diagram::{Diagram, Show};
use vibroimpact_study::{Cut, Followed, counted};

/// Colour of the orbit diagram from simulation.
const GREY: Colour = Colour::hex(0xb0_b0b0);
/// Width of a curve.
const WIDTH: f64 = 2.8;
/// Colour of the rim of a curve, because the colours of some motions are light, and its width on both sides together.
const RIM: Colour = Colour::hex(0x40_4040);
const RIM_WIDTH: f64 = 1.6;
/// Size of the mark of an event, and its size if there are many marks.
const MARK: f64 = 12.0;
const SMALL_MARK: f64 = 7.0;
/// Number of marks above which they are small.
const MANY: usize = 40;
/// Maximum number of labels with a colour of their own.
const NAMED: usize = 12;
/// Colour of the other labels.
const OTHERS: Colour = Colour::hex(0x50_5050);

/// The figure of `vibro branch`: branches along a line, with the orbit diagram from simulation behind, and with
/// inadmissible solutions if requested. Impact velocities or positions are shown as in the orbit diagram; without one,
/// impact velocities.
///
/// # Errors
/// [`ReportError::Plan`] if a value of the parameter overflows in these units.
pub fn figure(
    followed: &[Followed],
    cut: &Cut,
    behind: Option<&Diagram>,
    show_virtual: bool,
    asked: &Asked,
) -> Result<Figure, ReportError> {
    let show = behind.map_or(Show::Velocity, |diagram| diagram.plan.show);
    let oscillator = |value: f64| cut.oscillator(&asked.system, value).ok();
    let what = match show {
        // a branch has no figure over a quantity; `vibro response` draws that
        Show::Velocity | Show::Quantity(_) => What::Velocity,
        Show::Strobe => What::Position(&oscillator),
    };
    // the unit of the ordinate where the parameter has this value
    let size = |value: f64| {
        let units = asked.units.at(cut.vary, value);
        if show == Show::Strobe { units.length() } else { units.velocity() }
    };
    let unit = asked.units.of(cut.vary);
    let (from, to) = cut.ends;
    let mut panel = Panel::new(
        FigureAxis::new(along(cut, &asked.units)).range(from.min(to) * unit, from.max(to) * unit),
        FigureAxis::new(show.ordinate(&asked.units)),
    );
    if let Some(diagram) = behind {
        for dots in backdrop(diagram, &asked.units, GREY)? {
            panel.add(dots);
        }
    }
    let tracks: Vec<Track> = followed.iter().map(|branch| Track::of(&branch.points, what)).collect();
    let mut legend = draw(&mut panel, &tracks, show_virtual, (unit, &size));
    if behind.is_some() {
        legend = with_simulation(legend);
    }
    Ok(Figure::new(panel)
        .size(680.0, 520.0)
        .title(title_without(asked, &cut.names().copied().collect::<Vec<_>>()))
        .legend(legend))
}

/// The figure of `vibro branch --machine`: the speeds of the closings of all stops along a line, or a [quantity](BranchQuantity)
/// of each cycle, with the orbit diagram of the same from simulation behind, if it is given.
///
/// # Errors
/// As [`figure`].
pub fn of_machine<'a>(
    branches: impl Iterator<Item = &'a [SolutionPoint]>,
    cut: &Cut<String>,
    (quantity, behind): (Option<&BranchQuantity<'_>>, Option<&Diagram<String, String>>),
    title: String,
) -> Result<Figure, ReportError> {
    let (from, to) = cut.ends;
    let units = Units::default();
    let abscissa = FigureAxis::new(along(cut, &units)).range(from.min(to), from.max(to));
    let ordinate = quantity.map_or_else(|| "speed of closing".to_owned(), |quantity| plain(&quantity.path));
    let mut panel = Panel::new(abscissa, FigureAxis::new(ordinate));
    if let Some(diagram) = behind {
        for dots in backdrop(diagram, &units, GREY)? {
            panel.add(dots);
        }
    }
    let track = |points| match quantity {
        None => Track::of_machine(points),
        Some(quantity) => Track::of_quantity(points, |point| quantity.at(point)),
    };
    let tracks: Vec<Track> = branches.map(track).collect();
    let legend = draw(&mut panel, &tracks, false, (1.0, &|_| 1.0));
    let legend = if behind.is_some() { with_simulation(legend) } else { legend };
    Ok(Figure::new(panel).size(680.0, 520.0).title(title).legend(legend))
}

/// The legend with the dots of the orbit diagram behind.
fn with_simulation(legend: Legend) -> Legend {
    // a dot of the cloud is too small for the legend
    legend.points(&Points::new([], [], GREY).size(7.0), "simulation")
}

/// Draws branches with their events, with the units of both axes, and returns the legend.
fn draw(panel: &mut Panel, tracks: &[Track], show_virtual: bool, (unit, size): (f64, &dyn Fn(f64) -> f64)) -> Legend {
    let mut legend = Legend::below();
    let colours = colours(tracks);
    let mut looks: Vec<Look> = Vec::new();
    for ((label, look), (xs, ys)) in tracks.iter().flat_map(Track::curves) {
        if look == Look::Virtual && !show_virtual {
            continue;
        }
        if !looks.contains(&look) {
            looks.push(look);
        }
        let colour = colours.iter().find(|(name, _)| *name == label).map_or(Colour::BLACK, |(_, colour)| *colour);
        let ys: Vec<f64> = ys.into_iter().zip(&xs).map(|(y, x)| y * size(*x)).collect();
        let xs: Vec<f64> = xs.into_iter().map(|x| x * unit).collect();
        let (width, dash) = pen(look);
        motion_line(panel, (xs, ys), &label, Stroke::new(colour).width(width).dash(dash));
    }
    for (name, colour) in colours.iter().take(NAMED) {
        legend = legend.line(Stroke::new(*colour).width(WIDTH), label(name));
    }
    if colours.len() > NAMED {
        legend = legend.line(Stroke::new(OTHERS).width(WIDTH), counted((colours.len() - NAMED) as u64, "other"));
    }
    looks.sort_unstable();
    for look in looks {
        let name = match look {
            Look::Stable => "stable",
            Look::Neutral => "neutral",
            Look::Unstable => "unstable",
            Look::Virtual => "inadmissible",
        };
        let (width, dash) = pen(look);
        legend = legend.line(Stroke::new(Colour::BLACK).width(width).dash(dash), name);
    }
    for (kind, points) in marks(tracks, show_virtual, (unit, size)) {
        legend = legend.points(&points, kind);
        panel.add(points);
    }
    legend
}

const fn pen(look: Look) -> (f64, Dash) {
    match look {
        Look::Stable => (WIDTH, Dash::Solid),
        Look::Neutral => (WIDTH, Dash::DashDot),
        Look::Unstable => (WIDTH, Dash::Dashed),
        Look::Virtual => (1.4, Dash::Dotted),
    }
}

/// Adds a line of a motion. Lines in the colour of the motion on maps have a rim, for which dashes have no room.
pub(super) fn motion_line(panel: &mut Panel, (xs, ys): (Vec<f64>, Vec<f64>), label: &str, stroke: Stroke) {
    let colour = match stroke.dash {
        Dash::Solid if of_motion(label) => {
            panel.add(Line::new(xs.clone(), ys.clone(), RIM).width(stroke.width + RIM_WIDTH));
            stroke.colour
        }
        _ if of_motion(label) => variant(stroke.colour, 1),
        _ => stroke.colour,
    };
    panel.add(Line { xs, ys, stroke: Stroke { colour, ..stroke } });
}

/// Whether a label is that of a motion m/n, which has the same colour in all figures.
pub(super) fn of_motion(label: &str) -> bool {
    legend_group(label) != "other"
}

/// A colour for each label, in the order of first appearance on the branches: that of the motion on maps, or one of a
/// series for the labels of machines.
fn colours(tracks: &[Track]) -> Vec<(String, Colour)> {
    let mut labels: Vec<String> = Vec::new();
    for point in tracks.iter().flat_map(|track| &track.points) {
        if !labels.contains(&point.label) {
            labels.push(point.label.clone());
        }
    }
    let colour = |k: usize, label: &str| match k {
        _ if of_motion(label) => class_style(label).colour,
        k if k < NAMED => series(k),
        _ => OTHERS,
    };
    labels.into_iter().enumerate().map(|(k, label)| (label.clone(), colour(k, &label))).collect()
}

/// The marks of events, by kind.
fn marks(
    tracks: &[Track],
    show_virtual: bool,
    (unit, size): (f64, &dyn Fn(f64) -> f64),
) -> BTreeMap<&'static str, Points> {
    let mut places: BTreeMap<&'static str, (Shape, Vec<f64>, Vec<f64>)> = BTreeMap::new();
    for (track, point) in tracks.iter().flat_map(|track| track.points.iter().map(move |point| (track, point))) {
        let Some((kind, shape, ordinates)) = point.event.and_then(|event| mark(track, point, event)) else { continue };
        if point.look == Look::Virtual && !show_virtual {
            continue;
        }
        let (_, xs, ys) = places.entry(kind).or_insert((shape, Vec::new(), Vec::new()));
        xs.extend(ordinates.iter().map(|_| point.value * unit));
        ys.extend(ordinates.iter().map(|ordinate| ordinate * size(point.value)));
    }
    let count: usize = places.values().map(|(_, xs, _)| xs.len()).sum();
    let wide = if count > MANY { SMALL_MARK } else { MARK };
    let style = |(shape, xs, ys): (Shape, Vec<f64>, Vec<f64>)| {
        Points::new(xs, ys, Colour::WHITE).shape(shape).size(wide).rim(Colour::BLACK)
    };
    places.into_iter().map(|(kind, place)| (kind, style(place))).collect()
}

/// The name and the shape of the mark of an event, and its ordinates: those of all impacts or states, or velocity zero
/// where an impact appears or disappears.
fn mark(track: &Track, point: &TrackPoint, event: &str) -> Option<(&'static str, Shape, Vec<f64>)> {
    let (kind, shape, at_zero) = BRANCH_MARKS.iter().find(|(name, ..)| *name == event)?;
    let ordinates = if *at_zero && !track.positions { vec![0.0] } else { point.ordinates() };
    Some((kind, *shape, ordinates))
}
