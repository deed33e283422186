//! The figure of the sections of an attractor of a machine: phase and speed of its closings of stops, and its states at phase 0 in
//! the plane of each coordinate and its velocity.

use crate::figure::section::{LARGE, dots, fitted, phases};
use crate::figure::series;
use vibroimpact::machine::Machine;
use vibroimpact_plot::{COLUMN, Colour, Figure, Legend, Panel, plain};
use vibroimpact_study::SectionPoints;

/// Maximum number of coordinates with a panel each.
const PLANES: usize = 5;
/// Maximum number of panels below each other.
const ROWS: usize = 3;
/// Height of a panel.
const HEIGHT: f64 = 380.0;

/// The figure of `vibro lyapunov --machine`.
#[must_use]
pub fn figure(found: &SectionPoints, machine: &Machine, title: String) -> Figure {
    let coordinates = &machine.parts().coordinates;
    let shown = coordinates.len().min(PLANES);
    let speeds: Vec<f64> = found.closings.iter().map(|closing| closing.speed).collect();
    let across = phases(found.closings.iter().map(|closing| closing.phase));
    let ordinate = fitted("speed of closing".into(), &speeds, size(&speeds));
    let mut panel = Panel::new(across, ordinate).caption("closings of stops");
    let mut legend = Legend::below();
    for (k, stop) in machine.stops().iter().enumerate() {
        let at = found.closings.iter().filter(|closing| closing.place == k);
        let (xs, ys): (Vec<f64>, Vec<f64>) = at.map(|closing| (closing.phase, closing.speed)).unzip();
        let points = dots(xs, ys, series(k));
        // a dot of the cloud is too small for the legend
        legend = legend.points(&points.clone().size(LARGE), plain(&stop.name));
        panel.add(points);
    }
    let list = |of: &dyn Fn(usize) -> f64| (0..found.strobes.len()).map(of).collect::<Vec<f64>>();
    // lengths and velocities are small or large relative to those of all coordinates
    let largest = |of: &dyn Fn(&vibroimpact::events::Start) -> Vec<f64>| {
        size(&found.strobes.iter().flat_map(of).collect::<Vec<f64>>())
    };
    let (length, speed) = (largest(&|state| state.q.clone()), largest(&|state| state.qdot.clone()));
    let plane = |(i, name): (usize, &String)| {
        let (xs, ys) = (list(&|k| found.strobes[k].q[i]), list(&|k| found.strobes[k].qdot[i]));
        let name = plain(name);
        let axes = (fitted(format!("q.{name}"), &xs, length), fitted(format!("qdot.{name}"), &ys, speed));
        Panel::new(axes.0, axes.1).caption("states at phase 0").with(dots(xs, ys, Colour::BLACK))
    };
    let planes = coordinates[..shown].iter().enumerate().map(plane);
    let panels: Vec<Panel> = core::iter::once(panel).chain(planes).collect();
    let columns = panels.len().div_ceil(ROWS);
    #[allow(clippy::cast_precision_loss)] // a few panels
    let (width, height) = (COLUMN * columns as f64, HEIGHT * panels.len().div_ceil(columns) as f64);
    let title = if coordinates.len() > shown {
        format!("{title}: the first {shown} of {} coordinates", coordinates.len())
    } else {
        title
    };
    let figure = Figure::grid(columns, panels).size(width, height).title(title);
    if machine.stops().len() > 1 { figure.legend(legend) } else { figure }
}

/// The largest absolute value; 1 if all are 0.
fn size(values: &[f64]) -> f64 {
    let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    if largest > 0.0 { largest } else { 1.0 }
}
