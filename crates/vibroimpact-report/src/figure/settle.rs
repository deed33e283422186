//! The figure of a settled motion: a few of its periods.

use crate::Asked;
use crate::figure::{label, title, waveform};
use vibroimpact::motion::{EventKind, ImpactState, Motion};
use vibroimpact::verdict::{Settled, Verdict};
use vibroimpact::{Oscillator, Start};
use vibroimpact_plot::Figure;

/// Approximate number of forcing periods shown.
const SHOWN: f64 = 6.0;

/// Maximum number of events shown. At a low frequency of the force a forcing period may have billions of events.
const MOST_EVENTS: usize = 200_000;

/// The figure of `vibro settle`: the motion after the transient.
pub(crate) fn figure(osc: &Oscillator, start: Start, settled: &Settled, asked: &Asked) -> Figure {
    let (from, span) = steady(osc, start, settled);
    let label = label(&settled.verdict.label());
    let name = format!("{}: {label}", title(asked));
    waveform::figure(osc, from, span, &asked.units, name)
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
