//! The figure of a response: branches as curves, stable solid, neutral dashed and dotted and unstable dashed, and the motions of both sweeps.

use crate::figure::branch::{motion_line, of_motion};
use crate::figure::{label, series};
use crate::task::response::ResponseView;
use vibroimpact::verdict::Stability;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Panel, Points, Stroke, class_style};
use vibroimpact_study::ResponseRow;

/// Width of a branch.
const WIDTH: f64 = 2.6;
/// Size and colour of the dots of the sweeps with rising and with falling values.
const LARGE: f64 = 8.0;
const LIGHT: Colour = Colour::hex(0xc4_c4c4);
const SMALL: f64 = 4.0;
const DARK: Colour = Colour::hex(0x60_6060);

/// How the parts with each stability are drawn.
const DASHES: [(Stability, Dash); 3] =
    [(Stability::Stable, Dash::Solid), (Stability::Neutral, Dash::DashDot), (Stability::Unstable, Dash::Dashed)];

/// The parts of all branches with one label with one stability, separated by `NaN`.
type BranchLine = ((String, Stability), Vec<f64>, Vec<f64>);

/// The figure of `vibro response`, with this title. Inadmissible solutions are left out.
pub(crate) fn figure(view: &ResponseView<'_>, title: String) -> Figure {
    let (found, (from, to)) = (view.found, view.ends());
    let mut panel =
        Panel::new(FigureAxis::new(view.axis.clone()).range(from, to), FigureAxis::new(view.ordinate.clone()));
    let mut legend = Legend::below();
    let place = |row: &ResponseRow| (view.parameter(row), view.shown(row));
    // the sweeps lie below the branches; where both have the same motion, the small dot is inside the large one
    let sweeps: [(&str, &[ResponseRow], f64, Colour); 2] =
        [("sweep up", &found.up, LARGE, LIGHT), ("sweep down", &found.down, SMALL, DARK)];
    for (_, rows, size, colour) in sweeps {
        let (xs, ys): (Vec<f64>, Vec<f64>) = rows.iter().map(place).filter(|(_, y)| y.is_finite()).unzip();
        let points = Points::new(xs, ys, colour).size(size);
        panel.add(points);
    }
    let mut lines: Vec<BranchLine> = Vec::new();
    for rows in &found.branches {
        for pair in rows.windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            // an event separates two parts, so a step takes its look from the end that is no event
            let one = if b.event.is_some() && a.event.is_none() { a } else { b };
            let Some(stability) = one.stability.filter(|_| one.admissible) else { continue };
            let key = (one.label.clone(), stability);
            let at = lines.iter().position(|(other, ..)| *other == key).unwrap_or_else(|| {
                lines.push((key, Vec::new(), Vec::new()));
                lines.len() - 1
            });
            let (_, xs, ys) = &mut lines[at];
            let (begin, end) = (place(a), place(b));
            if xs.last() != Some(&begin.0) || ys.last() != Some(&begin.1) {
                xs.extend([f64::NAN, begin.0]);
                ys.extend([f64::NAN, begin.1]);
            }
            xs.push(end.0);
            ys.push(end.1);
        }
    }
    let mut labels: Vec<String> = Vec::new();
    for ((name, _), ..) in &lines {
        if !labels.contains(name) {
            labels.push(name.clone());
        }
    }
    for (k, name) in labels.iter().enumerate() {
        let colour = if of_motion(name) { class_style(name).colour } else { series(k) };
        for (stability, dash) in DASHES {
            for (_, xs, ys) in lines.iter().filter(|((other, own), ..)| other == name && *own == stability) {
                motion_line(&mut panel, (xs.clone(), ys.clone()), name, Stroke::new(colour).width(WIDTH).dash(dash));
            }
        }
        legend = legend.line(Stroke::new(colour).width(WIDTH), label(name));
    }
    for (stability, dash) in DASHES {
        if stability != Stability::Stable && lines.iter().any(|((_, own), ..)| *own == stability) {
            legend = legend.line(Stroke::new(Colour::BLACK).width(WIDTH).dash(dash), stability.name());
        }
    }
    for (name, _, size, colour) in sweeps {
        legend = legend.points(&Points::new([], [], colour).size(size), name);
    }
    Figure::new(panel).size(680.0, 520.0).title(title).legend(legend)
}
