//! Cycles that stick, from the release that determines them.
//!
//! For $`|\delta| < 1`$ the mass leaves a stop at rest, at the phase $`\pi - \arcsin\delta`$: one state, whatever came before.
//! So what follows a release is one motion, and if it sticks to that stop again, it is periodic from then on. Nothing
//! has to converge, and both multipliers are 0: a neighbour that sticks forgets how it differed.

use super::cycle::{Cycle, CyclePoint, RestSpan};
use crate::contact::sticking::release_phase;
use crate::math::Multiplier;
use crate::motion::{EventKind, ImpactState, Motion};
use crate::system::{Oscillator, Side};
use crate::verdict::{Count, Label};

/// Events followed before it counts as not coming back. A chatter takes some fifteen impacts at restitution 1/2.
pub const DEFAULT_EVENTS: u32 = 4_000;

/// The cycle that the release from the stop on `side` leads back to, within `events` events; `None` if the stop never
/// releases the mass or the motion does not stick to it again.
///
/// ```
/// use vibroimpact::{Oscillator, Side, orbit};
/// let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5)?;
/// let cycle = orbit::from_release(&osc, Side::Upper, orbit::DEFAULT_EVENTS).unwrap();
/// assert_eq!(cycle.label.to_string(), "inf/1");
/// assert!((cycle.rests[0].release - (std::f64::consts::PI + 0.5_f64.asin())).abs() < 1e-15);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn from_release(osc: &Oscillator, side: Side, events: u32) -> Option<Cycle> {
    release_phase(osc, side)?;
    let mut points: Vec<CyclePoint> = Vec::new();
    let mut rests: Vec<RestSpan> = Vec::new();
    // time of the last impact, while its interval is open
    let mut open: Option<f64> = None;
    for event in Motion::released(osc, side).take(events as usize) {
        if let (Some(since), EventKind::Impact { .. } | EventKind::Stick { .. }) = (open, event.kind)
            && let Some(last) = points.last_mut()
        {
            last.interval = event.time - since;
        }
        match event.kind {
            EventKind::Impact { velocity_before, .. } => {
                let state = ImpactState { phase: event.phase, velocity: velocity_before, side: event.side };
                points.push(CyclePoint { state, interval: f64::INFINITY });
                open = Some(event.time);
            }
            EventKind::Stick { chatter, .. } => {
                rests.push(RestSpan { side: event.side, chatter, begin: event.phase, release: f64::NAN });
                open = None;
            }
            EventKind::Release => {
                rests.last_mut()?.release = event.phase;
                if event.side == side {
                    return cycle(osc, points, rests, event.time);
                }
            }
            EventKind::Graze { .. } => {}
        }
    }
    None
}

fn cycle(osc: &Oscillator, points: Vec<CyclePoint>, rests: Vec<RestSpan>, length: f64) -> Option<Cycle> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a count of forcing periods, saturating
    let periods = (length / osc.period()).round() as u32;
    let impacts = if rests.iter().any(|rest| rest.chatter) {
        Count::Infinite
    } else {
        Count::Finite(u32::try_from(points.len()).unwrap_or(u32::MAX))
    };
    let label = Label { impacts, periods };
    let multipliers = [Multiplier::default(); 2];
    (periods > 0).then_some(Cycle { label, points, rests, multipliers, residual: 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flights_impacts_and_rest_fill_whole_periods() {
        for (inverse, gap, eps) in [(1.11, -0.5, 0.5), (0.9, -0.9, 0.7), (2.5, 0.25, 0.5), (1.3, 0.3, 0.0)] {
            let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap();
            let cycle = from_release(&osc, Side::Upper, DEFAULT_EVENTS).unwrap();
            assert_eq!(cycle.label.impacts == Count::Infinite, eps > 0.0);
            let ahead = |a: f64, b: f64| crate::system::phase::wrap(b - a) / osc.beta();
            let [rest] = cycle.rests.as_slice() else { panic!("one rest") };
            let first = ahead(rest.release, cycle.points[0].state.phase);
            let struck: f64 = cycle.points.iter().map(|p| p.interval).sum();
            let turns = (first + struck + ahead(rest.begin, rest.release)) / osc.period();
            // the flight before the first impact may itself be longer than a period
            assert!((turns - turns.round()).abs() < 1e-12, "1/beta {inverse} gap {gap}: {turns}");
        }
    }

    #[test]
    fn no_release_no_cycle() {
        for gap in [-1.5, 1.5] {
            let osc = Oscillator::new(0.9, gap, 0.5).unwrap();
            assert_eq!(from_release(&osc, Side::Upper, DEFAULT_EVENTS), None);
        }
        // released, but never to stick again: the motion ends in 1/1
        let osc = Oscillator::from_inverse_beta(0.6, 0.75, 0.5).unwrap();
        assert_eq!(from_release(&osc, Side::Upper, DEFAULT_EVENTS), None);
    }
}
