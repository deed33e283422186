//! The phase portrait: velocity over position, with the stops of an oscillator and the jumps at impacts; of a machine a panel for
//! each coordinate.

use crate::figure::waveform::last_event;
use crate::figure::waveform::{extremes, stop_key};
use crate::figure::{first_of, title};
use crate::table::waveform::samples;
use crate::{Asked, ReportError};
use vibroimpact::machine::Machine;
use vibroimpact::motion::sample;
use vibroimpact::{Oscillator, Side, Start, events};
use vibroimpact_plot::{
    COLUMN, Colour, Dash, Figure, FigureAxis, Legend, Line, Panel, Points, SERIES, Stroke, TextSide, Wall, plain,
};

/// Maximum number of samples.
const MOST: usize = 200_000;
/// Maximum number of impacts with a mark each; more marks would merge into a band.
const MARKED: usize = 120;
/// Maximum number of impacts for which thick curves can be distinguished.
const CLEAR: usize = 30;

/// A change of velocity below this fraction of the largest velocity is rounding.
const ROUNDING: f64 = 1e-8;
/// Number of equal steps of a motion of a machine.
const STEPS: f64 = 4000.0;
/// Maximum number of coordinates with a panel each, and of panels beside each other.
const PLANES: usize = 6;
const COLUMNS: usize = 3;
/// Height of a panel of several.
const HEIGHT: f64 = 380.0;

/// Draws the motion from `start` between two times, `from < until`.
#[must_use]
pub fn phase_portrait(asked: &Asked, osc: &Oscillator, start: Start, (from, until): (f64, f64)) -> Figure {
    let units = &asked.units;
    let (begin, at) = last_event(osc, start, from);
    let span = until - at;
    let fine = osc.period().min(core::f64::consts::TAU) / 240.0;
    #[allow(clippy::cast_precision_loss)] // far below 2^53
    let step = fine.max(span / MOST as f64).max(f64::MIN_POSITIVE);
    let wave = sample(osc, begin, span, step, 2 * MOST);
    let (length, speed) = (units.length(), units.velocity());
    let wave = wave.iter().filter(|point| at + point.time >= from);
    let trace = Trace::new(wave.map(|point| (point.time, point.x * length, point.v * speed)));
    let (low, high) = extremes(osc, &trace.xs, length);
    let mut panel = Panel::new(
        FigureAxis::new(units.named("*ξ*", "m")).range(low, high),
        FigureAxis::new(units.named("velocity *ξ*′", "m/s")),
    );
    for (side, stop) in osc.stops() {
        let beyond = if side == Side::Upper { TextSide::Right } else { TextSide::Left };
        panel.add(Wall::new(side.sign() * stop.gap * length, beyond));
    }
    let mut legend = trace.draw(&mut panel).fold(Legend::below(), |legend, (stroke, name)| legend.line(stroke, name));
    if from == 0.0 {
        let at = Points::new([start.x * length], [start.v * speed], Colour::BLACK).size(10.0).rim(Colour::WHITE);
        legend = legend.points(&at, "start");
        panel.add(at);
    }
    Figure::new(panel).size(680.0, 560.0).title(title(asked)).legend(legend.patch(stop_key(), "stop"))
}

/// Draws the motion of a machine from a state over a time.
pub(crate) fn machine_portrait(
    machine: &Machine,
    (start, time): (&events::Start, f64),
    title: String,
) -> Result<Figure, ReportError> {
    let wave: Vec<_> = samples(machine, start, (time, time / STEPS))?.collect();
    let names = &machine.parts().coordinates;
    let shown = names.len().min(PLANES);
    let mut keys: Vec<(Stroke, &'static str)> = Vec::new();
    let panel = |(i, name): (usize, &String)| {
        let [x, v] = ["q", "qdot"].map(|of| FigureAxis::new(format!("{of}.{}", plain(name))));
        let mut panel = Panel::new(x, v);
        let trace = Trace::new(wave.iter().map(|at| (at.time, at.q[i], at.qdot[i])));
        for key in trace.draw(&mut panel) {
            if !keys.iter().any(|(_, name)| *name == key.1) {
                keys.push(key);
            }
        }
        panel
    };
    let panels: Vec<Panel> = names[..shown].iter().enumerate().map(panel).collect();
    let legend = keys.into_iter().fold(Legend::below(), |legend, (stroke, name)| legend.line(stroke, name));
    let columns = panels.len().min(COLUMNS);
    #[allow(clippy::cast_precision_loss)] // a few panels
    let (width, height) = (COLUMN * columns as f64, HEIGHT * panels.len().div_ceil(columns) as f64);
    let title = first_of(title, shown, names.len());
    Ok(Figure::grid(columns, panels).size(width, height).title(title).legend(legend))
}

/// The curve of a motion, which is broken where the velocity jumps, and the position and both velocities of each jump.
struct Trace {
    xs: Vec<f64>,
    vs: Vec<f64>,
    jumps: Vec<(f64, f64, f64)>,
}

impl Trace {
    /// Of the times, positions and velocities of a motion.
    fn new(points: impl Iterator<Item = (f64, f64, f64)> + Clone) -> Self {
        let fastest = points.clone().fold(0.0, |fastest: f64, (.., v)| fastest.max(v.abs()));
        let mut trace = Self { xs: Vec::new(), vs: Vec::new(), jumps: Vec::new() };
        let mut last = (f64::NAN, f64::NAN);
        for (time, x, v) in points {
            if last.0 == time && (last.1 - v).abs() > ROUNDING * fastest {
                trace.jumps.push((x, last.1, v));
                trace.xs.push(f64::NAN);
                trace.vs.push(f64::NAN);
            }
            trace.xs.push(x);
            trace.vs.push(v);
            last = (time, v);
        }
        trace
    }

    /// Draws the curve, and few jumps, and returns their strokes for a legend.
    fn draw(self, panel: &mut Panel) -> impl Iterator<Item = (Stroke, &'static str)> + use<> {
        let line = Line::new(self.xs, self.vs, SERIES[0]).width(if self.jumps.len() <= CLEAR { 2.2 } else { 1.0 });
        let motion = line.stroke;
        panel.add(line);
        let few = (1..=MARKED).contains(&self.jumps.len());
        core::iter::once((motion, "motion")).chain(few.then(|| (draw_jumps(panel, &self.jumps), "impact")))
    }
}

fn draw_jumps(panel: &mut Panel, jumps: &[(f64, f64, f64)]) -> Stroke {
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for (x, before, after) in jumps {
        xs.extend([*x, *x, f64::NAN]);
        ys.extend([*before, *after, f64::NAN]);
    }
    let jump = Line::new(xs, ys, SERIES[1]).width(2.4).dash(Dash::Dashed);
    let stroke = jump.stroke;
    panel.add(jump);
    let ends = |of: fn(&(f64, f64, f64)) -> f64| {
        let (xs, ys): (Vec<f64>, Vec<f64>) = jumps.iter().map(|jump| (jump.0, of(jump))).unzip();
        Points::new(xs, ys, SERIES[1]).size(8.0)
    };
    panel.add(ends(|jump| jump.1).rim(Colour::WHITE));
    let mut after = ends(|jump| jump.2);
    after.style.filled = false;
    panel.add(after);
    stroke
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Units;
    use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};
    use vibroimpact_plot::Mark;
    use vibroimpact_study::SystemPlan;
    use vibroimpact_study::machine::MachineSource;

    /// Every impact is a dashed jump on the stop, from a velocity to -eps times it. The curve itself never passes a
    /// stop.
    #[test]
    fn an_impact_is_a_jump_on_the_stop() {
        let system = SystemPlan::from_inverse_beta(1.3, 0.75, 0.5);
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

    /// One panel for each coordinate, and a jump for each impact in that of the head, which ends at -e times the velocity.
    #[test]
    fn impacts_are_jumps() {
        let source = MachineSource::of_catalogue("two-mass-hammer").unwrap().with("omega", 1.06).unwrap();
        let machine = source.machine().unwrap();
        let found = settle_machine(&machine, &events::Start::default(), &SettleOptions::default()).unwrap();
        let Verdict::Periodic(cycle) = &found.verdict else { panic!("{}", found.verdict.label()) };
        let figure = machine_portrait(&machine, (&cycle.state, cycle.period), "hammer".into()).unwrap();
        assert_eq!(figure.panels.len(), 2);
        let lines: Vec<&Line> = figure.panels[1]
            .marks
            .iter()
            .filter_map(|mark| if let Mark::Line(line) = mark { Some(line) } else { None })
            .collect();
        assert_eq!(lines.len(), 2);
        let ends: Vec<f64> = lines[1].ys.iter().copied().filter(|y| y.is_finite()).collect();
        assert_eq!(ends.len(), 2 * cycle.events.len());
        let closed = (lines[0].xs.iter().rev().find(|x| x.is_finite()).unwrap() - lines[0].xs[0]).abs();
        assert!(closed < 1e-9, "{closed}");
    }
}
