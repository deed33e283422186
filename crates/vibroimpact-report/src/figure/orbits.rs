//! The figure of the orbits with a label: phase and speed of each closing.

use crate::figure::{label, series};
use crate::solutions::OrbitView;
use core::f64::consts::TAU;
use vibroimpact_plot::{Figure, FigureAxis, Legend, Panel, Points};

/// The size of a dot, and how much larger each orbit's are than those of the one after it: orbits may share closings.
const SIZE: f64 = 6.0;
const LARGER: f64 = 2.5;
/// The phases and speeds of the closings of orbits; `ordinate` is the name of the speeds. Inadmissible solutions are left out.
#[must_use]
pub fn figure(orbits: &[OrbitView<'_>], ordinate: String, title: String) -> Figure {
    let shown: Vec<_> = orbits.iter().enumerate().filter(|(_, orbit)| orbit.admissible).collect();
    let fastest = shown.iter().flat_map(|(_, orbit)| orbit.cycle.closings()).map(|at| at.speed).fold(0.0, f64::max);
    let top = if fastest > 0.0 { 1.05 * fastest } else { 1.0 };
    let mut panel =
        Panel::new(FigureAxis::new("phase (rad)").range(0.0, TAU), FigureAxis::new(ordinate).range(0.0, top));
    let mut legend = Legend::below();
    for (k, (number, OrbitView { cycle, .. })) in shown.iter().enumerate() {
        #[allow(clippy::cast_precision_loss)] // a few orbits
        let size = SIZE + LARGER * (shown.len() - 1 - k).min(6) as f64;
        let name = format!("orbit {}: {}, {}", number + 1, label(&cycle.label().to_string()), cycle.stability().name());
        legend = legend.points(&Points::new([], [], series(k)).size(SIZE), name);
        let (phases, speeds): (Vec<f64>, Vec<f64>) = cycle.closings().iter().map(|at| (at.phase, at.speed)).unzip();
        panel.add(Points::new(phases, speeds, series(k)).size(size));
    }
    Figure::new(panel).title(title).legend(legend)
}
