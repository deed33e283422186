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
