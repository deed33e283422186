//! The figure of both sections of an attractor: phase and speed of its closings of stops, and its states at phase 0.

use crate::figure::{extremes, first_of, series, title};
use crate::number::short;
use crate::{Asked, Units};
use core::f64::consts::PI;
use vibroimpact::machine::Machine;
use vibroimpact::{Oscillator, Side, Stop};
use vibroimpact_plot::{COLUMN, Colour, Figure, FigureAxis, Legend, Panel, Points, Tick, plain};
use vibroimpact_study::{SectionPoints, SystemPlan};

/// Maximum number of distinct points that are drawn as large dots.
const FEW: usize = 200;
/// Two points are the same if they differ by less than this fraction of the range.
const SAME: f64 = 1e-6;
/// Maximum number of coordinates with a panel each.
const PLANES: usize = 5;
/// Maximum number of panels below each other.
const ROWS: usize = 3;
/// Diameter of a large dot, and of a dot in a cloud.
const LARGE: f64 = 9.0;
const SMALL: f64 = 2.6;

/// How both sections of a system are drawn.
struct Look {
    caption: &'static str,
    /// The name of the speed of a closing.
    ordinate: String,
    /// The stops, with their names.
    stops: Vec<(usize, String)>,
    /// The names of each coordinate and of its velocity.
    planes: Vec<[String; 2]>,
    /// A length, a velocity and a speed of closing that are not rounding.
    sizes: [f64; 3],
    /// The height of a panel.
    height: f64,
}

/// The figure of `vibro lyapunov`.
pub(crate) fn figure(found: &SectionPoints, osc: &Oscillator, asked: &Asked) -> Figure {
    let units = &asked.units;
    let stop = |(side, stop): (Side, Stop)| {
        let name = match side {
            Side::Upper => "stop".to_owned(),
            Side::Lower => {
                let (gap, restitution) = (short(stop.gap), short(stop.restitution));
                format!("second stop, *δ*_2 = {gap}, *ε*_2 = {restitution}").replace('-', "−")
            }
        };
        (side.place(), name)
    };
    let look = Look {
        caption: "impacts",
        ordinate: units.named("arrival velocity *u*_−", "m/s"),
        stops: osc.stops().map(stop).collect(),
        planes: vec![[units.named("*ξ*", "m"), units.named("velocity *ξ*′", "m/s")]],
        sizes: [units.length(), units.velocity(), units.velocity()],
        height: 430.0,
    };
    // the legend names the second stop; a title with all parameters would be too long for a column
    let title = title(&Asked { system: SystemPlan { second_stop: None, ..asked.system }, ..*asked });
    draw(found, look, units).title(title)
}

/// The figure of `vibro lyapunov --machine`: a plane for each coordinate and its velocity.
pub(crate) fn of_machine(found: &SectionPoints, machine: &Machine, title: String) -> Figure {
    let coordinates = &machine.parts().coordinates;
    let shown = coordinates.len().min(PLANES);
    let look = Look {
        caption: "closings of stops",
        ordinate: "speed of closing".to_owned(),
        stops: machine.stops().iter().map(|stop| plain(&stop.name)).enumerate().collect(),
        planes: coordinates[..shown]
            .iter()
            .map(|name| ["q", "qdot"].map(|of| format!("{of}.{}", plain(name))))
            .collect(),
        // lengths and velocities are small or large relative to those of all coordinates
        sizes: [
            largest(found.strobes.iter().flat_map(|state| state.q.iter().copied())),
            largest(found.strobes.iter().flat_map(|state| state.qdot.iter().copied())),
            largest(found.closings.iter().map(|closing| closing.speed)),
        ],
        height: 380.0,
    };
    draw(found, look, &Units::default()).title(first_of(title, shown, coordinates.len()))
}

fn draw(found: &SectionPoints, look: Look, units: &Units) -> Figure {
    let [length, velocity, speed] = look.sizes;
    let speeds: Vec<f64> = found.closings.iter().map(|at| at.speed * units.velocity()).collect();
    let across = phases(found.closings.iter().map(|at| at.state.phase));
    let mut panel = Panel::new(across, fitted(look.ordinate, &speeds, speed)).caption(look.caption);
    let mut legend = Legend::below();
    let several = look.stops.len() > 1;
    for (k, (stop, name)) in look.stops.into_iter().enumerate() {
        let closings = found.closings.iter().zip(&speeds).filter(|(at, _)| at.stop == stop);
        let (phases, speeds) = closings.map(|(at, speed)| (at.state.phase, *speed)).unzip();
        let points = dots(phases, speeds, series(k));
        // a dot of the cloud is too small for the legend
        legend = legend.points(&points.clone().size(LARGE), name);
        panel.add(points);
    }
    let plane = |(i, [x, v]): (usize, [String; 2])| {
        let states = found.strobes.iter().map(|at| (at.q[i] * units.length(), at.qdot[i] * units.velocity()));
        let (xs, vs): (Vec<f64>, Vec<f64>) = states.unzip();
        let panel = Panel::new(fitted(x, &xs, length), fitted(v, &vs, velocity)).caption("states at phase 0");
        panel.with(dots(xs, vs, Colour::BLACK))
    };
    let planes = look.planes.into_iter().enumerate().map(plane);
    let panels: Vec<Panel> = core::iter::once(panel).chain(planes).collect();
    let columns = panels.len().div_ceil(ROWS);
    #[allow(clippy::cast_precision_loss)] // a few panels
    let (width, height) = (COLUMN * columns as f64, look.height * panels.len().div_ceil(columns) as f64);
    let figure = Figure::grid(columns, panels).size(width, height);
    if several { figure.legend(legend) } else { figure }
}

/// The largest absolute value; 1 if all are 0.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    let largest = values.fold(0.0, |largest: f64, value| largest.max(value.abs()));
    if largest > 0.0 { largest } else { 1.0 }
}

/// A spread below this fraction of the values, or of a unit of length or velocity, is rounding.
const ROUNDING: f64 = 1e-6;

/// An axis over some values. Values that are equal to rounding are placed in the middle of a range of suitable size, so
/// that they appear as one point. An axis fitted to their last digits would show rounding as structure.
fn fitted(name: String, values: &[f64], unit: f64) -> FigureAxis {
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
fn phases(values: impl Iterator<Item = f64>) -> FigureAxis {
    let (low, high) = extremes(values);
    let axis = FigureAxis::new("phase *θ*");
    if (0.01..PI).contains(&(high - low)) {
        return axis;
    }
    let ticks = ["0", "π/2", "π", "3π/2", "2π"];
    axis.range(0.0, 2.0 * PI).ticks((0_u8..).zip(ticks).map(|(k, text)| Tick::new(0.5 * PI * f64::from(k), text)))
}

/// Points as large dots if few are distinct, otherwise as a cloud of small dots.
fn dots(xs: Vec<f64>, ys: Vec<f64>, colour: Colour) -> Points {
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
    use vibroimpact::Start;
    use vibroimpact::chaos::Section;
    use vibroimpact::motion::ImpactState;

    /// The states of 1/1 differ in their last digits. Each panel shows one dot, and the axes show no digits of
    /// rounding.
    #[test]
    fn f10_rounding_is_no_structure() {
        let system = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);
        let (asked, osc) = (Asked { system, units: Units::default() }, system.oscillator().unwrap());
        for (x, v, velocity) in [(0.3, -1.2, 2.0), (0.0, 1e-17, 1e-9), (0.75, 0.0, 3.0)] {
            let off = |k: u32| f64::from(k % 3) * 1e-15;
            let strobes = (0..9).map(|k| Start { x: x + off(k), v: v + off(k + 1), phase: 0.0 }).collect();
            let impact = |k| ImpactState { phase: 1.0 + off(k), velocity: velocity + off(k), side: Side::Upper };
            let found = Section { impacts: (0..9).map(impact).collect(), strobes };
            let figure = figure(&SectionPoints::of_oscillator(&osc, &found), &osc, &asked);
            for axis in figure.panels.iter().flat_map(|panel| [&panel.x, &panel.y]) {
                let (low, high) = axis.range.expect("a range of its own");
                assert!(high - low >= 0.99, "{low} {high}");
            }
        }
        // points that are really distinct are drawn as distinct
        let strobes = [0.3, 0.3001].map(|x| Start { x, v: -1.0, phase: 0.0 }).to_vec();
        let found = Section { impacts: Vec::new(), strobes };
        assert_eq!(figure(&SectionPoints::of_oscillator(&osc, &found), &osc, &asked).panels[1].x.range, None);
    }
}
