//! The figure of a waveform, position over time with the stops and the impacts; and of a settled motion, a few of its periods.

use crate::figure::{label, title};
use crate::{Asked, Units};
use vibroimpact::motion::{EventKind, ImpactState, Motion, sample};
use vibroimpact::verdict::{Settled, Verdict};
use vibroimpact::{Oscillator, Side, Start};
use vibroimpact_plot::{
    ClassStyle, Colour, Figure, FigureAxis, Hatch, Legend, Line, Panel, Pattern, Points, SERIES, Wall,
};

/// Maximum number of samples: a page is a thousand pixels wide.
const MOST: f64 = 400_000.0;
/// Maximum number of impacts with a mark each; more marks would merge into a band.
const MARKED: usize = 5000;

/// Draws the motion from `start` for a time `until`. Times in the figure begin at `from`.
pub(crate) fn figure(
    osc: &Oscillator,
    start: Start,
    (from, until): (f64, f64),
    units: &Units,
    title: String,
) -> Figure {
    let fine = osc.period().min(core::f64::consts::TAU) / 240.0;
    let step = fine.max(until / MOST).max(f64::MIN_POSITIVE);
    let wave = sample(osc, start, until, step, 2_000_000);
    let (length, time) = (units.length(), units.time());
    let xs: Vec<f64> = wave.iter().map(|p| (from + p.time) * time).collect();
    let ys: Vec<f64> = wave.iter().map(|p| p.x * length).collect();
    let (low, high) = extremes(osc, &ys, length);
    let line = Line::new(xs, ys, SERIES[0]);
    let mut legend = Legend::below().line(line.stroke, "position");
    let mut panel = Panel::new(
        FigureAxis::new(units.named("time *τ*", "s")).range(from * time, (from + until) * time),
        FigureAxis::new(units.named("*ξ*", "m")).range(low, high),
    );
    for (side, stop) in osc.stops() {
        let (at, beyond) = match side {
            Side::Upper => (stop.gap, vibroimpact_plot::TextSide::Above),
            Side::Lower => (-stop.gap, vibroimpact_plot::TextSide::Below),
        };
        panel.add(Wall::new(at * length, beyond));
    }
    let (times, places): (Vec<f64>, Vec<f64>) = Motion::new(osc, start)
        .take(100_000)
        .take_while(|event| event.time <= until)
        .filter(|event| matches!(event.kind, EventKind::Impact { .. }))
        .map(|event| {
            let gap = osc.stop(event.side).map_or(0.0, |stop| stop.gap);
            ((from + event.time) * time, event.side.sign() * gap * length)
        })
        .unzip();
    panel.add(line);
    if !times.is_empty() && times.len() <= MARKED {
        let size = if times.len() > 60 { 5.0 } else { 9.0 };
        let impacts = Points::new(times, places, SERIES[1]).size(size).rim(Colour::WHITE);
        legend = legend.points(&impacts, "impact");
        panel.add(impacts);
    }
    Figure::new(panel).size(1000.0, 400.0).title(title).legend(legend.patch(stop_key(), "stop"))
}

/// The entry of a stop in a legend.
pub(crate) fn stop_key() -> ClassStyle {
    ClassStyle { colour: Colour::GREY.alpha(0.12), hatch: Some(Hatch::new(Pattern::Rising, Colour::GREY)) }
}

/// A range of positions that contains the motion and a strip of each stop near it.
pub(crate) fn extremes(osc: &Oscillator, ys: &[f64], length: f64) -> (f64, f64) {
    let low = ys.iter().copied().fold(f64::INFINITY, f64::min);
    let high = ys.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = (high - low).max(1e-12 * low.abs().max(high.abs()));
    let near = |at: f64| (low - size..=high + size).contains(&at);
    let stops: Vec<f64> =
        osc.stops().map(|(side, stop)| side.sign() * stop.gap * length).filter(|at| near(*at)).collect();
    let (low, high) = stops.iter().fold((low, high), |(low, high), at| (low.min(*at), high.max(*at)));
    let air = if high > low { 0.08 * (high - low) } else { 0.5 * length };
    (low - air, high + air)
}

/// Approximate number of forcing periods shown.
const SHOWN: f64 = 6.0;

/// Maximum number of events shown. At a low frequency of the force a forcing period may have billions of events.
const MOST_EVENTS: usize = 200_000;

/// The figure of `vibro settle`: the motion after the transient.
pub(crate) fn settled(osc: &Oscillator, start: Start, settled: &Settled, asked: &Asked) -> Figure {
    let (from, span) = steady(osc, start, settled);
    let label = label(&settled.verdict.label());
    let name = format!("{}: {label}", title(asked));
    figure(osc, from, span, &asked.units, name)
}

/// Number of forcing periods shown of a settled motion.
fn shown(settled: &Settled) -> f64 {
    match &settled.verdict {
        Verdict::Periodic(cycle) => {
            let n = f64::from(cycle.label.periods);
            n * (SHOWN / n).ceil().max(2.0)
        }
        Verdict::Chaotic(_) | Verdict::Undecided(_) => 4.0 * SHOWN,
        _ => SHOWN,
    }
}

/// The part of a settled motion that the figure shows: its state after the last event of the transient, the time of
/// that event, and the duration shown.
pub(crate) fn steady(osc: &Oscillator, start: Start, settled: &Settled) -> (Start, (f64, f64)) {
    let (from, time) = last_event(osc, start, settled.time);
    let span = shown(settled) * osc.period();
    let last = Motion::new(osc, from).take_while(|event| event.time <= span).nth(MOST_EVENTS);
    (from, (time, last.map_or(span, |event| event.time)))
}

/// The state after the last event before a given time, and the time of that event.
pub(crate) fn last_event(osc: &Oscillator, start: Start, until: f64) -> (Start, f64) {
    let (mut state, mut time) = (start, 0.0);
    for event in Motion::new(osc, start).take_while(|event| event.time <= until) {
        let at_stop = ImpactState { phase: event.phase, velocity: 0.0, side: event.side };
        let at_stop = match event.kind {
            EventKind::Impact { velocity_before, .. } => ImpactState { velocity: velocity_before, ..at_stop },
            EventKind::Stick { .. } | EventKind::Release => at_stop,
            EventKind::Graze { .. } => continue,
        };
        (state, time) = (at_stop.rebound(osc), event.time);
    }
    (state, time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::verdict::{SettleOptions, settle};

    /// At beta = 1e-9 there are 1e9 impacts in a forcing period.
    #[test]
    fn what_is_shown_has_an_end() {
        let osc = Oscillator::new(1e-9, 3.9, 0.28).unwrap().with_damping(1e-10).unwrap();
        let start = Start { x: -1.4, v: -5.3, phase: 0.0 };
        let (_, (from, span)) = steady(&osc, start, &settle(&osc, start, &SettleOptions::at_most(200)));
        assert!(from > 100.0 && span > 1e5 && span < 1e-3 * osc.period(), "{from} {span}");
    }
}
