//! The figure of a response: branches as curves, stable solid, neutral dashed and dotted and unstable dashed, and the motions of both sweeps.

use crate::figure::{label, named, quantity_name, title_without, variant};
use crate::json::response::value;
use crate::{Asked, ReportError};
use vibroimpact::verdict::Stability;
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, SERIES, Stroke};
use vibroimpact_study::{ResponseCurves, ResponsePoint, SweptMotion};

/// Width of a branch.
const WIDTH: f64 = 2.6;
/// Size and colour of the dots of the sweeps with rising and with falling values.
const LARGE: f64 = 8.0;
const LIGHT: Colour = Colour::hex(0xc4_c4c4);
const SMALL: f64 = 4.0;
const DARK: Colour = Colour::hex(0x60_6060);
/// Colours of branches: without black and yellow, which is too light for a line.
const USABLE: usize = 6;

/// How the parts with each stability are drawn.
const DASHES: [(Stability, Dash); 3] =
    [(Stability::Stable, Dash::Solid), (Stability::Neutral, Dash::DashDot), (Stability::Unstable, Dash::Dashed)];

/// The parts of all branches with one label with one stability, separated by `NaN`.
type BranchLine = ((String, Stability), Vec<f64>, Vec<f64>);

/// The figure of `vibro response`. Inadmissible solutions are left out.
///
/// # Errors
/// [`ReportError::Plan`] if a value of the parameter overflows in these units.
pub fn figure(found: &ResponseCurves, asked: &Asked) -> Result<Figure, ReportError> {
    let (units, plan) = (&asked.units, &found.plan);
    let (unit, quantity) = (units.of(plan.vary), plan.quantity);
    let (from, to) = plan.cut().ends;
    let mut panel = Panel::new(
        FigureAxis::new(named(plan.vary, units)).range(from * unit, to * unit),
        FigureAxis::new(quantity_name(quantity, units)),
    );
    let mut legend = Legend::below();
    // the sweeps lie below the branches; where both have the same motion, the small dot is inside the large one
    let sweeps: [(&str, &[SweptMotion], f64, Colour); 2] =
        [("sweep up", &found.up, LARGE, LIGHT), ("sweep down", &found.down, SMALL, DARK)];
    for (_, motions, size, colour) in sweeps {
        let places = motions.iter().map(|motion| {
            let units = units.at(plan.vary, motion.value);
            (motion.value * unit, value(motion.quantities, quantity, &units))
        });
        let (xs, ys): (Vec<f64>, Vec<f64>) = places.filter(|(_, y)| y.is_finite()).unzip();
        let points = Points::new(xs, ys, colour).size(size);
        panel.add(points);
    }
    let mut lines: Vec<BranchLine> = Vec::new();
    for branch in &found.branches {
        for pair in branch.points.windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            // an event separates two parts, so a step takes its look from the end that is no event
            let one = if b.solution.event.is_some() && a.solution.event.is_none() { a } else { b };
            if !one.solution.physical {
                continue;
            }
            let place = |point: &ResponsePoint| {
                let at = point.solution.value;
                (at * unit, value(point.quantities, quantity, &units.at(plan.vary, at)))
            };
            let key = (one.solution.cycle.label.to_string(), one.solution.stability());
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
        let colour = variant(SERIES[k % USABLE], k / USABLE);
        for (stability, dash) in DASHES {
            for (_, xs, ys) in lines.iter().filter(|((other, own), ..)| other == name && *own == stability) {
                let stroke = Stroke::new(colour).width(WIDTH).dash(dash);
                panel.add(Line { xs: xs.clone(), ys: ys.clone(), stroke });
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
    Ok(Figure::new(panel).size(680.0, 520.0).title(title_without(asked, &[plan.vary])).legend(legend))
}
