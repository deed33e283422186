//! The figure of a motion of a machine: its coordinates over time with contacts and impacts, and below them the contact
//! forces.

use crate::ReportError;
use crate::figure::{extremes, first_of};
use crate::table::waveform::samples;
use vibroimpact::events::{Event, EventKind, Sample, Start};
use vibroimpact::machine::{Machine, StopLaw};
use vibroimpact::regime::ContactState;
use vibroimpact_plot::{
    ClassStyle, Colour, Dash, Figure, FigureAxis, Hatch, Legend, Line, Panel, Pattern, Points, Rects, SERIES, plain,
};
use vibroimpact_study::Simulated;

/// Number of equal steps: a page is a thousand pixels wide.
const STEPS: f64 = 4000.0;
/// Maximum number of coordinates with a line each, and of forces.
const LINES: usize = 6;
/// Maximum number of impacts with a mark each; more marks would merge into a band.
const MARKED: usize = 2000;
/// Maximum number of events both sides of which are drawn.
const SIDES: usize = 20_000;
/// The hatches of the contacts of several stops.
const HATCHES: [Pattern; 4] = [Pattern::Rising, Pattern::Falling, Pattern::Horizontal, Pattern::Dots];

/// Draws the motion that was simulated.
pub(crate) fn figure(
    machine: &Machine,
    start: &Start,
    found: &Simulated<Event>,
    title: String,
) -> Result<Figure, ReportError> {
    let until = found.shown_until;
    // with so many events their sides are not seen
    let sides = found.events.len() <= SIDES;
    let wave: Vec<Sample> =
        samples(machine, start, (until, until / STEPS))?.filter(|sample| sides || sample.even).collect();
    let times: Vec<f64> = wave.iter().map(|sample| sample.time).collect();
    let coordinates = &machine.parts().coordinates;
    let shown = coordinates.len().min(LINES);
    let (low, high) = range(wave.iter().flat_map(|sample| sample.q[..shown].iter().copied()));
    let mut legend = Legend::below();
    let time = || FigureAxis::new("time").range(0.0, if until > 0.0 { until } else { 1.0 });
    let mut panel = Panel::new(time(), FigureAxis::new("displacement").range(low, high));

    // contacts behind the lines
    let contacts: Vec<(usize, Vec<(f64, f64)>)> = (0..machine.stops().len())
        .map(|stop| (stop, intervals(&wave, stop)))
        .filter(|(_, intervals)| !intervals.is_empty())
        .collect();
    let styles: Vec<ClassStyle> = (0..contacts.len()).map(|k| contact_style(k, contacts.len())).collect();
    let mut bands = Rects::new(styles.clone());
    for (k, (stop, intervals)) in contacts.iter().enumerate() {
        intervals.iter().for_each(|interval| bands.cell(*interval, (low, high), &[k]));
        legend = legend.patch(styles[k], format!("contact with {}", plain(machine.name_of(*stop))));
    }
    panel.add(bands);
    for (i, name) in coordinates[..shown].iter().enumerate() {
        let line = Line::new(times.clone(), wave.iter().map(|sample| sample.q[i]).collect::<Vec<_>>(), SERIES[i]);
        legend = legend.line(line.stroke, plain(name));
        panel.add(line);
    }
    let struck = |event: &&Event| event.kind == EventKind::Impact && event.time <= until;
    let impacts: Vec<(f64, f64)> =
        found.events.iter().filter(struck).flat_map(|event| places(machine, event, shown)).collect();
    if !impacts.is_empty() && impacts.len() <= MARKED {
        let (xs, ys): (Vec<f64>, Vec<f64>) = impacts.into_iter().unzip();
        let size = if xs.len() > 60 { 5.0 } else { 8.0 };
        let marks = Points::new(xs, ys, Colour::BLACK).size(size).rim(Colour::WHITE);
        legend = legend.points(&marks, "impact");
        panel.add(marks);
    }

    let pushing: Vec<usize> =
        (0..machine.stops().len() + machine.joints().len()).filter(|at| has_force(machine, &wave, *at)).collect();
    let pushing = &pushing[..pushing.len().min(LINES)];
    let mut panels = vec![panel];
    if !pushing.is_empty() {
        let (low, high) = range(wave.iter().flat_map(|sample| pushing.iter().map(|at| sample.forces[*at])));
        let mut panel = Panel::new(time(), FigureAxis::new("contact force").range(low, high));
        for (k, at) in pushing.iter().enumerate() {
            let forces: Vec<f64> = wave.iter().map(|sample| sample.forces[*at]).collect();
            // colours go on after those of the coordinates; the second time round lines are dashed
            let place = shown + k;
            let dash = if place < SERIES.len() - 1 { Dash::Solid } else { Dash::Dashed };
            let line = Line::new(times.clone(), forces, SERIES[place % (SERIES.len() - 1)]).dash(dash);
            legend = legend.line(line.stroke, format!("force of {}", plain(machine.name_of(*at))));
            panel.add(line);
        }
        panels.push(panel);
    }
    let title = first_of(title, shown, coordinates.len());
    let height = 400.0 + 260.0 * (panels.len() - 1) as f64;
    Ok(Figure::grid(1, panels).size(1000.0, height).title(title).legend(legend))
}

/// A range that contains the values, with some air.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = extremes(values);
    let air = if high > low { 0.08 * (high - low) } else { 0.5 * low.abs().max(1e-3) };
    (low - air, high + air)
}

/// The times in which a stop is closed or rested on.
fn intervals(wave: &[Sample], stop: usize) -> Vec<(f64, f64)> {
    let closed = |sample: &Sample| matches!(sample.states[stop], ContactState::Closed | ContactState::Resting);
    let mut found: Vec<(f64, f64)> = Vec::new();
    for pair in wave.windows(2).filter(|pair| closed(&pair[0]) && closed(&pair[1])) {
        match found.last_mut() {
            Some((_, end)) if *end == pair[0].time => *end = pair[1].time,
            _ => found.push((pair[0].time, pair[1].time)),
        }
    }
    found
}

/// Light grey, with a hatch where several stops have to be told apart.
fn contact_style(k: usize, of: usize) -> ClassStyle {
    let hatch = (of > 1).then(|| Hatch::new(HATCHES[k % HATCHES.len()], Colour::GREY));
    ClassStyle { colour: Colour::GREY.alpha(if of > 1 { 0.1 } else { 0.25 }), hatch }
}

/// Where an impact is marked: on the coordinates that it moves, if they are one or two, or else on the one that it moves
/// most.
fn places(machine: &Machine, event: &Event, shown: usize) -> Vec<(f64, f64)> {
    let direction = &machine.stops()[event.place].direction[..shown];
    let moved: Vec<usize> = (0..shown).filter(|i| direction[*i] != 0.0).collect();
    let most = moved.iter().copied().reduce(|a, b| if direction[b].abs() > direction[a].abs() { b } else { a });
    let marked: Vec<usize> = if moved.len() <= 2 { moved } else { most.into_iter().collect() };
    marked.into_iter().map(|i| (event.time, event.q[i])).collect()
}

/// Whether a stop or joint has a finite force: compliant stops, stops that are rested on, and joints.
fn has_force(machine: &Machine, wave: &[Sample], at: usize) -> bool {
    machine.stops().get(at).is_none_or(|stop| {
        matches!(stop.law, StopLaw::Compliant { .. })
            || wave.iter().any(|sample| sample.states[at] == ContactState::Resting)
    })
}
