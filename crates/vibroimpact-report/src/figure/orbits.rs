//! The figure of the orbits with a label: phase and speed of each closing.

use crate::Units;
use crate::figure::{label, variant};
use core::f64::consts::TAU;
use vibroimpact::orbit::{Orbit, machine::Cycle};
use vibroimpact_plot::{Figure, FigureAxis, Legend, Panel, Points, SERIES};

/// The size of a dot, and how much larger each orbit's are than those of the one after it: orbits may share closings.
const SIZE: f64 = 6.0;
const LARGER: f64 = 2.5;
/// Colours of orbits: without black and yellow, which is too light for a dot.
const USABLE: usize = 6;

/// An orbit: its words in the legend, and phases and speeds.
type Dots = (String, Vec<f64>, Vec<f64>);

/// Of an oscillator, in its units. Inadmissible solutions are left out.
#[must_use]
pub fn figure(found: &[Orbit], units: &Units, title: String) -> Figure {
    let orbits = found.iter().enumerate().filter(|(_, orbit)| orbit.physical).map(|(k, orbit)| {
        let points = orbit.cycle.points.iter();
        let (phases, speeds) = points.map(|at| (at.state.phase, at.state.velocity * units.velocity())).unzip();
        (words(k, &orbit.cycle.label.to_string(), orbit.cycle.stability().name()), phases, speeds)
    });
    draw(orbits.collect(), units.named("speed before the impact", "m/s"), title)
}

/// Of a machine.
#[must_use]
pub fn of_machine(found: &[Cycle], title: String) -> Figure {
    let orbits = found.iter().enumerate().map(|(k, cycle)| {
        let closings = cycle.events.iter().filter(|event| event.closes());
        let (phases, speeds) = closings.map(|event| (event.phase, event.speed)).unzip();
        (words(k, &cycle.label.to_string(), cycle.stability().name()), phases, speeds)
    });
    draw(orbits.collect(), "speed of closing".to_owned(), title)
}

fn words(k: usize, of: &str, stability: &str) -> String {
    format!("orbit {}: {}, {stability}", k + 1, label(of))
}

fn draw(orbits: Vec<Dots>, ordinate: String, title: String) -> Figure {
    let fastest = orbits.iter().flat_map(|(_, _, speeds)| speeds).copied().fold(0.0, f64::max);
    let top = if fastest > 0.0 { 1.05 * fastest } else { 1.0 };
    let mut panel =
        Panel::new(FigureAxis::new("phase (rad)").range(0.0, TAU), FigureAxis::new(ordinate).range(0.0, top));
    let mut legend = Legend::below();
    let count = orbits.len();
    for (k, (name, phases, speeds)) in orbits.into_iter().enumerate() {
        #[allow(clippy::cast_precision_loss)] // a few orbits
        let size = SIZE + LARGER * (count - 1 - k).min(6) as f64;
        let colour = variant(SERIES[k % USABLE], k / USABLE);
        legend = legend.points(&Points::new([], [], colour).size(SIZE), name);
        panel.add(Points::new(phases, speeds, colour).size(size));
    }
    Figure::new(panel).title(title).legend(legend)
}
