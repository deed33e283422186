//! The states of a motion at phase 0 of each forcing period, after its transient.

use super::follow::{AfterTransient, DiagramPoint, MotionKind, SAME, budget};
use core::f64::consts::TAU;
use vibroimpact::flight::SearchLimits;
use vibroimpact::motion::{End, EventKind, Motion, Path};
use vibroimpact::{Oscillator, Start};

/// Follows the motion of `osc` from `start` for `transient` forcing periods and returns the next `keep` states at phase
/// 0, or fewer if they repeat.
///
/// The motion is followed as one, and not period by period, so that a long flight is searched only once.
#[allow(clippy::cast_precision_loss)] // counts of at most 1.1e6
pub(super) fn after_transients(osc: &Oscillator, start: Start, transient: u64, keep: u64) -> AfterTransient {
    let (budget, period) = (budget(transient, keep), osc.period());
    // far enough that no flight has to be searched twice
    let limits = SearchLimits::default();
    let limits = SearchLimits { periods: limits.periods.max((transient + keep + 2) as f64), ..limits };
    let mut motion = Motion::with_limits(osc, start, limits);
    let first = if start.phase > 0.0 { (TAU - start.phase) / osc.beta() } else { 0.0 };
    let mut shown = Shown::default();
    let (mut events, mut number) = (0, 0);
    while motion.steps() + events < budget {
        let event = motion.next();
        events += 1;
        let Some(leg) = motion.leg() else { break };
        let known = match motion.end() {
            Some(End::NoneFor(time)) => time,
            _ => leg.duration,
        };
        loop {
            let time = first + number as f64 * period;
            if time > leg.begin + known {
                break;
            }
            let state = leg.at_phase(osc, time - leg.begin, 0.0, known);
            number += 1;
            let again = number > transient && shown.see(state, matches!(leg.path, Path::Rest(_)));
            if again || number >= transient + keep {
                return AfterTransient { kind: shown.kind(), points: shown.points, last: state };
            }
        }
        match event {
            None => break,
            Some(event) => shown.struck |= !shown.points.is_empty() && matches!(event.kind, EventKind::Impact { .. }),
        }
    }
    let last = motion.leg().map_or(start, |leg| leg.start(osc, 0.0));
    AfterTransient { kind: MotionKind::Undecided, points: Vec::new(), last }
}

/// The states to show, and what happened while they were collected.
#[derive(Default)]
struct Shown {
    points: Vec<DiagramPoint>,
    struck: bool,
    flew: bool,
}

impl Shown {
    /// Adds a state. Returns whether it equals the first one.
    fn see(&mut self, state: Start, rests: bool) -> bool {
        self.flew |= !rests;
        let same = |a: f64, b: f64| (a - b).abs() <= SAME * (1.0 + a.abs());
        if let Some(DiagramPoint::State { x, v: Some(v) }) = self.points.first()
            && same(*x, state.x)
            && same(*v, state.v)
        {
            return true;
        }
        self.points.push(DiagramPoint::State { x: state.x, v: Some(state.v) });
        false
    }

    const fn kind(&self) -> MotionKind {
        match (self.struck, self.flew) {
            (true, _) => MotionKind::Impacts,
            (false, true) => MotionKind::NoImpact,
            (false, false) => MotionKind::Stuck,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::{motion::stroboscopic_map, scenario};

    fn states(found: &AfterTransient) -> Vec<(f64, f64)> {
        found
            .points
            .iter()
            .filter_map(|point| match point {
                DiagramPoint::State { x, v } => Some((*x, (*v)?)),
                _ => None,
            })
            .collect()
    }

    /// The same states computed in another way, period by period with the map of the core.
    #[test]
    fn as_the_stroboscopic_map() {
        let osc = scenario::U.oscillator();
        let start = Start { x: 0.1, v: 0.2, phase: 0.0 };
        let got = states(&after_transients(&osc, start, 3, 20));
        let mut state = start;
        let mut expected = Vec::new();
        for k in 0..23 {
            if k >= 3 {
                expected.push((state.x, state.v));
            }
            state = stroboscopic_map(&osc, state, 1000).unwrap().state;
        }
        assert_eq!(got.len(), 20);
        for (g, e) in got.iter().zip(&expected) {
            assert!((g.0 - e.0).abs() < 1e-9 && (g.1 - e.1).abs() < 1e-9, "{g:?} {e:?}");
        }
    }

    #[test]
    fn periods_are_counted_in_forcing_periods() {
        for (point, n) in [(scenario::S, 1), (scenario::T, 2), (scenario::N, 1)] {
            let osc = point.oscillator();
            let found = after_transients(&osc, Start { phase: 3.0, ..Start::at_rest(&osc) }, 500, 64);
            assert_eq!((found.kind, found.points.len()), (MotionKind::Impacts, n), "{}", point.name);
            let state = found.last;
            let next = stroboscopic_map(&osc, state, 100).unwrap().state;
            assert!(n > 1 || ((next.x - state.x).abs() < 1e-9 && (next.v - state.v).abs() < 1e-9));
        }
    }

    #[test]
    fn without_impacts_there_are_states_all_the_same() {
        let osc = Oscillator::new(0.5, 2.0, 0.5).unwrap().with_damping(0.2).unwrap();
        let found = after_transients(&osc, Start::at_rest(&osc), 100, 64);
        assert_eq!((found.kind, found.points.len()), (MotionKind::NoImpact, 1));
        let free = Start::free_motion(&osc).unwrap();
        assert!((found.last.x - free.x).abs() < 1e-13 && (found.last.v - free.v).abs() < 1e-13);
        let pressed = Oscillator::new(0.9, -1.5, 0.5).unwrap();
        let found = after_transients(&pressed, Start { x: -3.0, v: 0.0, phase: 1.0 }, 100, 64);
        assert_eq!((found.kind, states(&found)), (MotionKind::Stuck, vec![(-1.5, 0.0)]));
    }
}
