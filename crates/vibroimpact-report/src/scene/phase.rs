//! The phase portrait: velocity over position, with the stops and the jumps at impacts.

use crate::Asked;
use crate::figure::settle::last_event;
use crate::figure::title;
use crate::figure::waveform::{extremes, stop_key};
use vibroimpact::motion::{Sample, sample};
use vibroimpact::{Oscillator, Side, Start};
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, SERIES, Wall};

/// Maximum number of samples.
const MOST: usize = 200_000;
/// Maximum number of impacts with a mark each; more marks would merge into a band.
const MARKED: usize = 120;
/// Maximum number of impacts for which thick curves can be distinguished.
const CLEAR: usize = 30;

/// Draws the motion from `start` between two times, `from < until`.
#[must_use]
pub fn phase_portrait(asked: &Asked, osc: &Oscillator, start: Start, (from, until): (f64, f64)) -> Figure {
    let units = &asked.units;
    let (begin, at) = last_event(osc, start, from);
    let span = until - at;
    let fine = osc.period().min(core::f64::consts::TAU) / 240.0;
    #[allow(clippy::cast_precision_loss)] // far below 2^53
    let step = fine.max(span / MOST as f64).max(f64::MIN_POSITIVE);
    let wave: Vec<Sample> =
        sample(osc, begin, span, step, 2 * MOST).into_iter().filter(|point| at + point.time >= from).collect();
    let (length, speed) = (units.length(), units.velocity());
    // the curve is broken at impacts, where the velocity jumps
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    let mut jumps: Vec<(f64, f64, f64)> = Vec::new();
    for (k, point) in wave.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| &wave[k]);
        if let Some(before) = before.filter(|before| before.time == point.time && before.v != point.v) {
            jumps.push((point.x * length, before.v * speed, point.v * speed));
            xs.push(f64::NAN);
            ys.push(f64::NAN);
        }
        xs.push(point.x * length);
        ys.push(point.v * speed);
    }
    let (low, high) = extremes(osc, &xs, length);
    let mut panel = Panel::new(
        FigureAxis::new(units.named("*ξ*", "m")).range(low, high),
        FigureAxis::new(units.named("velocity *ξ*′", "m/s")),
    );
    for (side, stop) in osc.stops() {
        let (at, beyond) = match side {
            Side::Upper => (stop.gap, vibroimpact_plot::TextSide::Right),
            Side::Lower => (-stop.gap, vibroimpact_plot::TextSide::Left),
        };
        panel.add(Wall::new(at * length, beyond));
    }
    let few = jumps.len() <= MARKED;
    let line = Line::new(xs, ys, SERIES[0]).width(if jumps.len() <= CLEAR { 2.2 } else { 1.0 });
    let mut legend = Legend::below().line(line.stroke, "motion");
    panel.add(line);
    if few && !jumps.is_empty() {
        let (mut xs, mut ys) = (Vec::new(), Vec::new());
        for (x, before, after) in &jumps {
            xs.extend([*x, *x, f64::NAN]);
            ys.extend([*before, *after, f64::NAN]);
        }
        let jump = Line::new(xs, ys, SERIES[1]).width(2.4).dash(Dash::Dashed);
        legend = legend.line(jump.stroke, "impact");
        panel.add(jump);
        let ends = |of: fn(&(f64, f64, f64)) -> f64| {
            let (xs, ys): (Vec<f64>, Vec<f64>) = jumps.iter().map(|jump| (jump.0, of(jump))).unzip();
            Points::new(xs, ys, SERIES[1]).size(8.0)
        };
        panel.add(ends(|jump| jump.1).rim(Colour::WHITE));
        panel.add(ends(|jump| jump.2).hollow());
    }
    if from == 0.0 {
        let at = Points::new([start.x * length], [start.v * speed], Colour::BLACK).size(10.0).rim(Colour::WHITE);
        legend = legend.points(&at, "start");
        panel.add(at);
    }
    Figure::new(panel).size(680.0, 560.0).title(title(asked)).legend(legend.patch(stop_key(), "stop"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use vibroimpact_plot::Mark;
    use vibroimpact_study::SystemPlan;

    /// Every impact is a dashed jump on the stop, from a velocity to -eps times it. The curve itself never passes a
    /// stop.
    #[test]
    fn an_impact_is_a_jump_on_the_stop() {
        let system = SystemPlan { inverse_beta: Some(1.3), gap: 0.75, restitution: 0.5, ..SystemPlan::default() };
        let (asked, osc) = (Asked { system, units: Units::default() }, system.oscillator().unwrap());
        for from in [0.0, 40.0] {
            let figure = phase_portrait(&asked, &osc, Start::at_rest(&osc), (from, 80.0));
            let lines = figure.panels[0].marks.iter().filter_map(|mark| match mark {
                Mark::Line(line) => Some(line),
                _ => None,
            });
            let (jumps, curves): (Vec<&Line>, Vec<&Line>) = lines.partition(|line| line.stroke.dash == Dash::Dashed);
            assert_eq!((jumps.len(), curves.len()), (1, 1));
            let places: Vec<f64> = jumps[0].xs.iter().copied().filter(|x| !x.is_nan()).collect();
            assert!(places.len() > 10 && places.iter().all(|x| (x - 0.75).abs() < 1e-12), "{places:?}");
            for jump in jumps[0].ys.chunks(3) {
                assert!(jump[0] > 0.0 && (jump[1] + 0.5 * jump[0]).abs() < 1e-12, "{jump:?}");
            }
            assert!(curves[0].xs.iter().all(|x| x.is_nan() || *x <= 0.75 + 1e-12));
        }
    }
}
