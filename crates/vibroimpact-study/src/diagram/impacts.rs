//! The impacts of a motion after its transient.

use super::follow::{AfterTransient, DiagramPoint, MotionKind, SAME, budget};
use vibroimpact::flight::SearchLimits;
use vibroimpact::motion::{End, EventKind, ImpactState, MAX_TOUCHES, Motion};
use vibroimpact::system::phase;
use vibroimpact::verdict::graze_limit::Fading;
use vibroimpact::{Oscillator, Start};

/// Follows the motion of `osc` from `start` for `transient` impacts and returns the next `keep` impacts, or fewer if
/// they repeat. A motion that ends has no points.
pub(super) fn after_transients(osc: &Oscillator, start: Start, transient: u64, keep: u64) -> AfterTransient {
    let budget = budget(transient, keep);
    let mut motion = Motion::new(osc, start);
    let mut points: Vec<DiagramPoint> = Vec::new();
    let (mut events, mut struck, mut touches) = (0, 0, 0);
    let mut fading = Fading::default();
    while motion.steps() + events < budget {
        let Some(event) = motion.next() else {
            return ended(osc, &motion, start, transient);
        };
        events += 1;
        let interval = motion.leg().map_or(0.0, |leg| leg.duration);
        match event.kind {
            EventKind::Impact { velocity_before: velocity, .. } => {
                (struck, touches) = (struck + 1, 0);
                let state = ImpactState { phase: event.phase, velocity, side: event.side };
                if fading.strikes(osc, state, interval) {
                    return halfway(osc, motion, start, MotionKind::NoImpact);
                }
                if struck <= transient {
                    continue;
                }
                let point = DiagramPoint::Impact { stop: state.side.place(), phase: state.phase, speed: velocity };
                let again = points.first().is_some_and(|first| same(first, &point));
                if !again {
                    points.push(point);
                }
                if again || struck - transient >= keep {
                    return AfterTransient { kind: MotionKind::Impacts, points, last: state.rebound(osc) };
                }
            }
            EventKind::Stick { chatter: true, .. } if !points.is_empty() => {
                fading.rests();
                points.push(DiagramPoint::Chatter { stop: event.side.place(), phase: event.phase });
            }
            EventKind::Graze { .. } => {
                touches += 1;
                let state = ImpactState { phase: event.phase, velocity: 0.0, side: event.side };
                if fading.strikes(osc, state, interval) || touches > MAX_TOUCHES {
                    return halfway(osc, motion, start, MotionKind::NoImpact);
                }
            }
            EventKind::Stick { .. } | EventKind::Release => fading.rests(),
        }
    }
    halfway(osc, motion, start, MotionKind::Undecided)
}

fn same(a: &DiagramPoint, b: &DiagramPoint) -> bool {
    match (a, b) {
        (
            DiagramPoint::Impact { phase: p, speed: u, stop: here },
            DiagramPoint::Impact { phase: q, speed: w, stop: there },
        ) => here == there && phase::difference(*q, *p).abs() <= SAME && (w - u).abs() <= SAME * u.abs(),
        _ => false,
    }
}

/// The result of a motion without further events: its kind, and its state after `transient` periods of the last flight
/// or rest.
fn ended(osc: &Oscillator, motion: &Motion<'_>, start: Start, transient: u64) -> AfterTransient {
    #[allow(clippy::cast_precision_loss)] // at most 1e6
    let later = transient.max(1) as f64 * osc.period();
    let (kind, later) = match motion.end() {
        Some(End::Never(_)) => (MotionKind::NoImpact, later),
        Some(End::Stuck(_)) => (MotionKind::Stuck, later),
        // the search reached its horizon; the next case is a search that used up its steps before
        Some(End::NoneFor(time)) if time >= 0.999 * SearchLimits::default().horizon(osc) => {
            (MotionKind::NoImpact, later.min(time))
        }
        Some(End::NoneFor(time)) => (MotionKind::Undecided, later.min(time)),
        None => (MotionKind::Undecided, 0.0),
    };
    let last = motion.leg().map_or(start, |leg| leg.start(osc, later));
    AfterTransient { kind, points: Vec::new(), last }
}

/// Stops following the motion. The last state is half-way to the next event.
fn halfway(osc: &Oscillator, mut motion: Motion<'_>, start: Start, kind: MotionKind) -> AfterTransient {
    let part = if motion.next().is_some() { 0.5 } else { 0.0 };
    let last = motion.leg().map_or(start, |leg| leg.start(osc, if part > 0.0 { part * leg.duration } else { 0.0 }));
    AfterTransient { kind, points: Vec::new(), last }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::scenario;

    fn velocities(found: &AfterTransient) -> Vec<f64> {
        let mut list: Vec<f64> = found
            .points
            .iter()
            .filter_map(|point| match point {
                DiagramPoint::Impact { speed, .. } => Some(*speed),
                _ => None,
            })
            .collect();
        list.sort_by(f64::total_cmp);
        list
    }

    /// The cycles at S, found by Newton's method (`vibro orbit`); 1/1 is also known in closed form.
    #[test]
    fn a_cycle_is_shown_once_with_its_very_velocities() {
        let osc = scenario::S.oscillator();
        let two = after_transients(&osc, Start::at_rest(&osc), 500, 64);
        let one = after_transients(&osc, Start { x: 0.75, v: -1.4, phase: 1.19 }, 500, 64);
        for (found, expected) in
            [(&two, vec![0.777_626_654_634_881_8, 2.644_018_587_785_435]), (&one, vec![2.797_349_151_953_767_4])]
        {
            let got = velocities(found);
            assert_eq!(got.len(), expected.len(), "{got:?}");
            assert!(got.iter().zip(&expected).all(|(g, e)| (g - e).abs() < 1e-12), "{got:?}");
        }
        let DiagramPoint::Impact { phase, .. } = one.points[0] else { panic!() };
        assert!((phase - 1.190_509_613_787_888_5).abs() < 1e-12);
        // the motion started from the last state is the same motion
        assert_eq!(velocities(&after_transients(&osc, one.last, 0, 64)).len(), 1);
    }

    #[test]
    fn without_return_as_many_as_asked_for() {
        let osc = scenario::U.oscillator();
        assert_eq!(after_transients(&osc, Start::at_rest(&osc), 50, 30).points.len(), 30);
    }

    #[test]
    fn ends_are_results() {
        // the amplitude of the motion is smaller than the gap
        let free = Oscillator::new(1.0 / 0.7, 4.0, 0.5).unwrap();
        let found = after_transients(&free, Start::at_rest(&free), 500, 64);
        assert_eq!((found.kind, found.points.len()), (MotionKind::NoImpact, 0));
        // the force presses the mass onto the stop for ever; the start is away from the stop
        let pressed = Oscillator::new(0.9, -1.5, 0.5).unwrap();
        let found = after_transients(&pressed, Start { x: -3.0, v: 0.0, phase: 0.0 }, 0, 64);
        assert_eq!((found.kind, found.points.len(), found.last.x, found.last.v), (MotionKind::Stuck, 0, -1.5, 0.0));
        // a motion that only grazes
        let grazing = Oscillator::new(2.0, 3.0, 0.5).unwrap();
        let found = after_transients(&grazing, Start { x: 3.0, v: 0.0, phase: 2.0 }, 0, 64);
        assert_eq!(found.kind, MotionKind::NoImpact);
        assert!(found.last.x < 3.0);
    }

    /// Impacts of ever smaller speed give "no impact", however short the transient, and not impacts of 1e-5.
    #[test]
    fn impacts_that_fade_away_are_none() {
        let osc = scenario::Q.oscillator();
        let mut none = 0;
        for k in 0..60 {
            let start = Start { x: 1.5 - 0.05 * f64::from(k), v: 0.3 + 0.02 * f64::from(k), phase: 0.0 };
            for transient in [10, 15, 20, 500] {
                let found = after_transients(&osc, start, transient, 5);
                none += u32::from(found.kind == MotionKind::NoImpact);
                let fastest = velocities(&found).pop();
                assert!(fastest.is_none_or(|u| u > 1e-4), "{start:?}: {found:?}");
            }
        }
        assert!(none > 20, "{none}");
    }

    /// A complete chatter in each forcing period: decreasing speeds, and the end of the chatter at speed 0.
    #[test]
    fn a_chatter_has_its_end() {
        let osc = Oscillator::from_inverse_beta(1.11, -0.5, 0.5).unwrap();
        let found = after_transients(&osc, Start::at_rest(&osc), 500, 64);
        assert_eq!(found.kind, MotionKind::Impacts);
        let ends = found.points.iter().filter(|p| matches!(p, DiagramPoint::Chatter { stop: 0, .. })).count();
        assert_eq!(ends, 1, "one period of it: {:?}", found.points);
    }
}
