//! The bifurcation diagram: impact velocities of orbits over the parameter, or their positions at phase 0. Stable
//! orbits are solid, neutral ones dashed and dotted, and unstable ones dashed. Events are marked, and the orbit diagram from simulation is behind.

use crate::figure::diagram::backdrop;
use crate::figure::styles::BRANCH_MARKS;
use crate::figure::tracks::{Look, Shown, Track, TrackPoint};
use crate::figure::{along, label, series, variant};
use crate::json::branch::{BranchObject, START};
use crate::{ReportError, ShownValue, Units, Varied};
use std::collections::BTreeMap;
use vibroimpact_plot::{
    Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, Shape, Stroke, class_style, legend_group,
};
use vibroimpact_study::diagram::Diagram;
use vibroimpact_study::{Cut, counted};

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
/// Maximum number of labels in the legend.
const NAMED: usize = 12;
/// Colour of the other labels.
const OTHERS: Colour = Colour::hex(0x50_5050);

/// What is drawn besides the branches.
pub(crate) struct Picture<'a, V, S> {
    /// The line, and the units of the results.
    pub(crate) cut: &'a Cut<V>,
    pub(crate) units: &'a Units,
    /// What is shown of each cycle, and its name.
    pub(crate) shown: Shown,
    pub(crate) ordinate: String,
    /// The orbit diagram of the same from simulation.
    pub(crate) behind: Option<&'a Diagram<V, S>>,
    /// Whether inadmissible solutions are drawn.
    pub(crate) inadmissible: bool,
}

/// The figure of `vibro branch`: branches along a line, with the orbit diagram from simulation behind.
pub(crate) fn figure<V: Varied, S: ShownValue>(
    branches: &[BranchObject<'_>],
    picture: &Picture<'_, V, S>,
    title: String,
) -> Result<Figure, ReportError> {
    let Picture { cut, units, shown, ordinate, behind, inadmissible } = picture;
    let ((from, to), unit) = (cut.ends, cut.vary.unit(units));
    let abscissa = FigureAxis::new(along(cut, units)).range(from.min(to) * unit, from.max(to) * unit);
    let mut panel = Panel::new(abscissa, FigureAxis::new(ordinate.clone()));
    if let Some(diagram) = behind {
        for dots in backdrop(diagram, units, GREY)? {
            panel.add(dots);
        }
    }
    let tracks: Vec<Track> = branches.iter().flat_map(|branch| Track::of(branch, *shown)).collect();
    let legend = draw(&mut panel, &tracks, *inadmissible);
    // a dot of the cloud is too small for the legend
    let simulation = behind.map(|_| Points::new([], [], GREY).size(7.0));
    let legend = simulation.iter().fold(legend, |legend, dots| legend.points(dots, "simulation"));
    Ok(Figure::new(panel).size(680.0, 520.0).title(title).legend(legend))
}

/// Draws branches with their events, and returns the legend.
fn draw(panel: &mut Panel, tracks: &[Track], show_virtual: bool) -> Legend {
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
    for (kind, points) in marks(tracks, show_virtual) {
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

/// A colour for each label: that of the motion on maps, or one of a series for the labels of machines. First are the labels that
/// the legend names, those with the longest ranges, in the order of first appearance on the branches; the others follow.
fn colours(tracks: &[Track]) -> Vec<(String, Colour)> {
    let mut labels: Vec<(String, f64)> = Vec::new();
    for points in tracks.iter().map(|track| &track.points) {
        for (k, point) in points.iter().enumerate() {
            let before = k.checked_sub(1).map(|k| &points[k]).filter(|before| before.label == point.label);
            let way = before.map_or(0.0, |before| (point.value - before.value).abs());
            match labels.iter_mut().find(|(label, _)| *label == point.label) {
                Some((_, range)) => *range += way,
                None => labels.push((point.label.clone(), way)),
            }
        }
    }
    let mut ranges: Vec<f64> = labels.iter().map(|(_, range)| *range).collect();
    ranges.sort_by(|a, b| b.total_cmp(a));
    let least = ranges.get(NAMED - 1).copied().unwrap_or(0.0);
    let (named, others): (Vec<_>, Vec<_>) = labels.into_iter().partition(|(_, range)| *range >= least);
    let colour = |k: usize, label: &str| match k {
        _ if of_motion(label) => class_style(label).colour,
        k if k < NAMED => series(k),
        _ => OTHERS,
    };
    let all = named.into_iter().chain(others).enumerate();
    all.map(|(k, (label, _))| (label.clone(), colour(k, &label))).collect()
}

/// The marks of events, by kind.
fn marks(tracks: &[Track], show_virtual: bool) -> BTreeMap<&'static str, Points> {
    let mut places: BTreeMap<&'static str, (Shape, Vec<f64>, Vec<f64>)> = BTreeMap::new();
    for (track, point) in tracks.iter().flat_map(|track| track.points.iter().map(move |point| (track, point))) {
        let Some((kind, shape, ordinates)) = point.event.and_then(|event| mark(track, point, event)) else { continue };
        if point.look == Look::Virtual && !show_virtual {
            continue;
        }
        let (_, xs, ys) = places.entry(kind).or_insert((shape, Vec::new(), Vec::new()));
        xs.extend(ordinates.iter().map(|_| point.value));
        ys.extend(ordinates);
    }
    // both sides begin at the start
    if let Some(start) = tracks.iter().find_map(|track| track.points.first().filter(|point| point.start)) {
        let ordinates = start.ordinates();
        let xs = ordinates.iter().map(|_| start.value).collect();
        places.insert(START, (Shape::Circle, xs, ordinates));
    }
    let count: usize = places.values().map(|(_, xs, _)| xs.len()).sum();
    let wide = if count > MANY { SMALL_MARK } else { MARK };
    let style = |kind: &str, (shape, xs, ys): (Shape, Vec<f64>, Vec<f64>)| {
        let colour = if kind == START { Colour::BLACK } else { Colour::WHITE };
        Points::new(xs, ys, colour).shape(shape).size(wide).rim(Colour::BLACK)
    };
    places.into_iter().map(|(kind, place)| (kind, style(kind, place))).collect()
}

/// The name and the shape of the mark of an event, and its ordinates: those of all impacts or states, or velocity zero
/// where an impact appears or disappears.
fn mark(track: &Track, point: &TrackPoint, event: &str) -> Option<(&'static str, Shape, Vec<f64>)> {
    let (kind, shape, at_zero) = BRANCH_MARKS.iter().find(|(name, ..)| *name == event)?;
    let ordinates = if *at_zero && !track.positions { vec![0.0] } else { point.ordinates() };
    Some((kind, *shape, ordinates))
}
