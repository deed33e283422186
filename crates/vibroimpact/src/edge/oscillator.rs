//! The border between two motions of an oscillator.

use super::track::{Bordered, EdgeError};
use crate::motion::{Event, ImpactState, Motion, states_at};
use crate::orbit::{Cycle, cycle_distance, shoot};
use crate::system::{Oscillator, Start};
use crate::verdict::{SettleOptions, Verdict, settle_while};

/// The most impacts of a cycle that is looked for.
const IMPACTS: usize = 1000;

impl Bordered for Oscillator {
    type Start = Start;

    fn lap(&self) -> f64 {
        self.period()
    }

    fn between(&self, from: &Start, to: &Start, part: f64) -> Start {
        let (lowest, highest) = Start::room(self);
        // a mean of two numbers may be rounded beyond a stop
        let x = (from.x + part * (to.x - from.x)).clamp(lowest, highest);
        Start { x, v: from.v + part * (to.v - from.v), phase: from.phase }
    }

    fn phase(&self, start: &Start) -> f64 {
        start.phase
    }

    fn after(&self, start: &Start, (time, phase): (f64, f64)) -> Option<Start> {
        Some(Start { phase, ..states_at(self, *start, &[time]).pop()?? })
    }

    fn distance(&self, one: &Start, other: &Start) -> f64 {
        let size = [one.x, one.v, other.x, other.v].into_iter().fold(0.0, |most: f64, of| most.max(of.abs()));
        let apart = (one.x - other.x).abs().max((one.v - other.v).abs());
        if apart == 0.0 { 0.0 } else { apart / size }
    }

    fn verdict(&self, start: &Start, options: &SettleOptions, go_on: &dyn Fn() -> bool) -> Result<Verdict, EdgeError> {
        let settled = settle_while(self, *start, options, go_on).ok_or(EdgeError::Stopped)?;
        Ok(settled.verdict)
    }

    /// A cycle that sticks is stable, so none of those is a saddle.
    fn cycles_near(&self, start: &Start, laps: u32) -> Vec<Cycle> {
        let until = self.period() * f64::from(laps);
        let events = Motion::new(self, *start).take_while(|event| event.time < until).take(IMPACTS);
        let arrivals: Option<Vec<ImpactState>> = events.map(|event| event.arrival()).collect();
        let arrivals = arrivals.unwrap_or_default();
        let (Some(first), Ok(count)) = (arrivals.first().copied(), u32::try_from(arrivals.len())) else {
            return Vec::new();
        };
        shoot(self, first, count, laps).into_iter().collect()
    }

    fn is_forced(&self) -> bool {
        true
    }

    fn passes(&self, cycle: &Cycle, start: &Start, distance: f64) -> bool {
        let next = Motion::new(self, *start).next().and_then(|event: Event| event.arrival());
        next.is_some_and(|state| cycle.points.iter().any(|point| cycle_distance(&point.state, &state) <= distance))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::edge::{EdgeOptions, edge};
    use crate::scenario;

    /// The starts at x = 0 nearest to rest that lead to 1/1 and to 2/1.
    pub(in super::super) fn starts() -> [Start; 2] {
        let osc = scenario::S.oscillator();
        ["1/1", "2/1"].map(|label| {
            let start = |k: i32| Start { x: 0.0, v: 0.05 * f64::from(k), phase: 0.0 };
            let leads = |start: &Start| {
                crate::verdict::settle(&osc, *start, &SettleOptions::default()).verdict.label() == label
            };
            (0..40).flat_map(|k| [start(k), start(-k)]).find(leads).unwrap()
        })
    }

    #[test]
    fn the_saddle_lies_between_both_motions() {
        let osc = scenario::S.oscillator();
        let found = edge(&osc, &starts(), &EdgeOptions::default()).unwrap();
        let Some(Verdict::Periodic(saddle)) = found.saddle.clone() else { panic!("a saddle") };
        assert!(!saddle.stable() && saddle.residual < 1e-11, "{saddle:?}");
        let labels = found.sides.each_ref().map(Verdict::label);
        assert_ne!(labels[0], labels[1]);
        // a little faster and a little slower than on the saddle: the motions on both sides
        let beside = [1.0 - 1e-6, 1.0 + 1e-6].map(|part| {
            let mut impact = saddle.points[0].state;
            impact.velocity *= part;
            let start = Start { x: osc.gap(), v: -0.5 * impact.velocity, phase: impact.phase };
            crate::verdict::settle(&osc, start, &SettleOptions::default()).verdict
        });
        let reached = |side: &Verdict| beside.iter().any(|of| of.same_as(side, 1e-6));
        assert!(found.sides.iter().all(reached), "{labels:?} {:?}", beside.each_ref().map(Verdict::label));
    }

    #[test]
    fn the_pair_stays_on_both_sides_of_the_border() {
        let osc = scenario::S.oscillator();
        let options = EdgeOptions { laps: 12, ..EdgeOptions::default() };
        let found = edge(&osc, &starts(), &options).unwrap();
        for point in &found.track {
            let verdict = crate::verdict::settle(&osc, point.state, &options.settle).verdict;
            assert!(verdict.same_as(&found.sides[0], 1e-6) && point.apart < 1e-5, "{point:?}");
        }
    }

    #[test]
    fn starts_without_a_border_are_refused() {
        let osc = scenario::S.oscillator();
        let same = edge(&osc, &[starts()[0]; 2], &EdgeOptions::default());
        assert!(matches!(same, Err(EdgeError::SameMotion(_))), "{same:?}");
        let other = Start { phase: 1.0, ..starts()[1] };
        assert!(matches!(edge(&osc, &[starts()[0], other], &EdgeOptions::default()), Err(EdgeError::Phases(..))));
    }
}
