//! The figure of both sections of an attractor, one above the other: phase and speed of its impacts, and its states at
//! phase 0.

use crate::Asked;
use crate::figure::title;
use crate::number::short;
use core::f64::consts::PI;
use vibroimpact::chaos::Section;
use vibroimpact::{Oscillator, Side, Stop};
use vibroimpact_plot::{COLUMN, Colour, Figure, FigureAxis, Legend, Panel, Points, SERIES, Tick};
use vibroimpact_study::SystemPlan;

/// Maximum number of distinct points that are drawn as large dots.
const FEW: usize = 200;
/// Two points are the same if they differ by less than this fraction of the range.
const SAME: f64 = 1e-6;
/// Diameter of a large dot, and of a dot in a cloud.
pub(super) const LARGE: f64 = 9.0;
const SMALL: f64 = 2.6;

/// The figure of `vibro lyapunov`.
#[must_use]
pub fn figure(found: &Section, osc: &Oscillator, asked: &Asked) -> Figure {
    let units = &asked.units;
    let speeds: Vec<f64> = found.impacts.iter().map(|impact| impact.velocity * units.velocity()).collect();
    let ordinate = fitted(units.named("arrival velocity *u*_−", "m/s"), &speeds, units.velocity());
    let phases = phases(found.impacts.iter().map(|impact| impact.phase));
    let mut above = Panel::new(phases, ordinate).caption("impacts");
    let second = osc.stop(Side::Lower);
    let of_second = |stop: Stop| {
        format!("second stop, *δ*_2 = {}, *ε*_2 = {}", short(stop.gap), short(stop.restitution)).replace('-', "−")
    };
    let mut legend = Legend::below();
    for (side, colour) in [(Side::Upper, SERIES[0]), (Side::Lower, SERIES[1])] {
        let name = match (side, second) {
            (Side::Upper, _) => "stop".into(),
            (Side::Lower, Some(stop)) => of_second(stop),
            (Side::Lower, None) => continue,
        };
        let at = found.impacts.iter().filter(|impact| impact.side == side);
        let (xs, ys): (Vec<f64>, Vec<f64>) = at.map(|at| (at.phase, at.velocity * units.velocity())).unzip();
        let points = dots(xs, ys, colour);
        // a dot of the cloud is too small for the legend
        legend = legend.points(&points.clone().size(LARGE), name);
        above.add(points);
    }
    let states = found.strobes.iter();
    let (xs, ys): (Vec<f64>, Vec<f64>) = states.map(|at| (at.x * units.length(), at.v * units.velocity())).unzip();
    let across = fitted(units.named("*ξ*", "m"), &xs, units.length());
    let below = Panel::new(across, fitted(units.named("velocity *ξ*′", "m/s"), &ys, units.velocity()))
        .caption("states at phase 0")
        .with(dots(xs, ys, Colour::BLACK));
    // the legend names the second stop; a title with all parameters would be too long for a column
    let title = title(&Asked { system: SystemPlan { second_stop: None, ..asked.system }, ..*asked });
    let figure = Figure::grid(1, vec![above, below]).size(COLUMN, 860.0).title(title);
    if second.is_some() { figure.legend(legend) } else { figure }
}

/// A spread below this fraction of the values, or of a unit of length or velocity, is rounding.
const ROUNDING: f64 = 1e-6;

/// An axis over some values. Values that are equal to rounding are placed in the middle of a range of suitable size, so
/// that they appear as one point. An axis fitted to their last digits would show rounding as structure.
pub(super) fn fitted(name: String, values: &[f64], unit: f64) -> FigureAxis {
    let axis = FigureAxis::new(name);
    let (low, high) = extremes(values.iter().copied());
    let size = low.abs().max(high.abs()).max(unit);
    if high - low > ROUNDING * size || low > high {
        return axis;
    }
    let middle = f64::midpoint(low, high);
    axis.range(middle - 0.5 * size, middle + 0.5 * size)
}

/// The axis of the phase: the full period in fractions of pi, or the part with impacts if that is less than half of it
/// (and more than one point).
pub(super) fn phases(values: impl Iterator<Item = f64>) -> FigureAxis {
    let (low, high) = extremes(values);
    let axis = FigureAxis::new("phase *θ*");
    if (0.01..PI).contains(&(high - low)) {
        return axis;
    }
    let ticks = ["0", "π/2", "π", "3π/2", "2π"];
    axis.range(0.0, 2.0 * PI).ticks((0_u8..).zip(ticks).map(|(k, text)| Tick::new(0.5 * PI * f64::from(k), text)))
}

fn extremes(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// Points as large dots if few are distinct, otherwise as a cloud of small dots.
pub(super) fn dots(xs: Vec<f64>, ys: Vec<f64>, colour: Colour) -> Points {
    let size = if distinct(&xs, &ys) <= FEW { LARGE } else { SMALL };
    Points::new(xs, ys, colour).size(size)
}

/// Number of distinct points.
fn distinct(xs: &[f64], ys: &[f64]) -> usize {
    let cell = |list: &[f64]| {
        let (low, high) = extremes(list.iter().copied());
        let width = SAME * (high - low).max(low.abs()).max(high.abs()).max(f64::MIN_POSITIVE);
        #[allow(clippy::cast_possible_truncation)] // a million cells or so
        let cells: Vec<i64> = list.iter().map(|x| (x / width).round() as i64).collect();
        cells
    };
    let places: std::collections::HashSet<(i64, i64)> = cell(xs).into_iter().zip(cell(ys)).collect();
    places.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use vibroimpact::Start;
    use vibroimpact::motion::ImpactState;

    /// The states of 1/1 differ in their last digits. Each panel shows one dot, and the axes show no digits of
    /// rounding.
    #[test]
    fn f10_rounding_is_no_structure() {
        let system = SystemPlan { inverse_beta: Some(1.3), gap: 0.75, restitution: 0.5, ..SystemPlan::default() };
        let (asked, osc) = (Asked { system, units: Units::default() }, system.oscillator().unwrap());
        for (x, v, velocity) in [(0.3, -1.2, 2.0), (0.0, 1e-17, 1e-9), (0.75, 0.0, 3.0)] {
            let off = |k: u32| f64::from(k % 3) * 1e-15;
            let strobes = (0..9).map(|k| Start { x: x + off(k), v: v + off(k + 1), phase: 0.0 }).collect();
            let impact = |k| ImpactState { phase: 1.0 + off(k), velocity: velocity + off(k), side: Side::Upper };
            let found = Section { impacts: (0..9).map(impact).collect(), strobes };
            let figure = figure(&found, &osc, &asked);
            for axis in figure.panels.iter().flat_map(|panel| [&panel.x, &panel.y]) {
                let (low, high) = axis.range.expect("a range of its own");
                assert!(high - low >= 0.99, "{low} {high}");
            }
        }
        // points that are really distinct are drawn as distinct
        let strobes = [0.3, 0.3001].map(|x| Start { x, v: -1.0, phase: 0.0 }).to_vec();
        let found = Section { impacts: Vec::new(), strobes };
        assert_eq!(figure(&found, &osc, &asked).panels[1].x.range, None);
    }
}
