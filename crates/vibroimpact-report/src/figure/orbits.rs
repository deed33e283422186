//! The figure of the orbits with a label: phase and speed of each closing.

use crate::figure::{label, series};
use crate::json::event::{closings, fastest};
use crate::json::orbit::OrbitAnswer;
use core::f64::consts::TAU;
use vibroimpact_plot::{Figure, FigureAxis, Legend, Panel, Points};

/// The size of a dot, and how much larger each orbit's are than those of the one after it: orbits may share closings.
const SIZE: f64 = 6.0;
const LARGER: f64 = 2.5;
/// The phases and speeds of the closings of orbits; `ordinate` is the name of the speeds. Inadmissible solutions are left out.
pub(crate) fn figure(answer: &OrbitAnswer<'_>, ordinate: String, title: String) -> Figure {
    let shown: Vec<_> = answer.orbits.iter().enumerate().filter(|(_, orbit)| orbit.admissible).collect();
    let most = shown.iter().map(|(_, orbit)| fastest(&orbit.motion.cycle)).fold(0.0, f64::max);
    let top = if most > 0.0 { 1.05 * most } else { 1.0 };
    let mut panel =
        Panel::new(FigureAxis::new("phase (rad)").range(0.0, TAU), FigureAxis::new(ordinate).range(0.0, top));
    let mut legend = Legend::below();
    for (k, (number, orbit)) in shown.iter().enumerate() {
        #[allow(clippy::cast_precision_loss)] // a few orbits
        let size = SIZE + LARGER * (shown.len() - 1 - k).min(6) as f64;
        let motion = &orbit.motion;
        let name = format!("orbit {}: {}, {}", number + 1, label(&motion.label), motion.stability.unwrap_or_default());
        legend = legend.points(&Points::new([], [], series(k)).size(SIZE), name);
        let closings = closings(&motion.cycle).map(|at| (at.phase.unwrap_or(0.0), at.speed));
        let (phases, speeds): (Vec<f64>, Vec<f64>) = closings.unzip();
        panel.add(Points::new(phases, speeds, series(k)).size(size));
    }
    Figure::new(panel).title(title).legend(legend)
}
