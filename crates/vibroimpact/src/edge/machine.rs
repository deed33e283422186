//! The border between two motions of a machine.

use super::track::{Bordered, EdgeError};
use crate::events::{ContactStart, Limits, Motion, Place, Start, states_at};
use crate::machine::Machine;
use crate::orbit::machine::Cycle;
use crate::orbit::{Count, MachineFrame, near_returns, passing};
use crate::verdict::{SettleOptions, Verdict, settle_machine_while};
use core::f64::consts::TAU;

/// The closings of the cycles that are looked for without forcing.
const CLOSINGS: [Count; 4] = [Count::Finite(1), Count::Finite(2), Count::Finite(3), Count::Infinite];

/// The state of a start; `None` for one that is not allowed.
fn place(machine: &Machine, start: &Start) -> Option<Place> {
    Some(Motion::new(machine, start, Limits::default()).ok()?.place().clone())
}

fn mixed(from: &[f64], to: &[f64], part: f64) -> Vec<f64> {
    from.iter().zip(to).map(|(from, to)| from + part * (to - from)).collect()
}

/// The contacts of both states, if they are the same, with surfaces between theirs. Otherwise they follow from the coordinates.
fn contacts(from: &[ContactStart], to: &[ContactStart], part: f64) -> Vec<ContactStart> {
    let alike = |(a, b): (&ContactStart, &ContactStart)| a.place == b.place && a.state == b.state;
    if from.len() != to.len() || !from.iter().zip(to).all(alike) {
        return Vec::new();
    }
    let between = |(a, b): (&ContactStart, &ContactStart)| ContactStart {
        surface: a.surface + part * (b.surface - a.surface),
        ..*a
    };
    from.iter().zip(to).map(between).collect()
}

impl Bordered for Machine {
    type Start = Start;

    fn lap(&self) -> f64 {
        let slowest = || MachineFrame::new(self).open().and_then(|open| open.slowest()).unwrap_or(1.0);
        self.period().unwrap_or_else(|| TAU / slowest())
    }

    fn between(&self, from: &Start, to: &Start, part: f64) -> Start {
        let full = |values: &[f64]| if values.is_empty() { vec![0.0; self.n()] } else { values.to_vec() };
        let way = |from: &[f64], to: &[f64]| mixed(&full(from), &full(to), part);
        let contacts = contacts(&from.contacts, &to.contacts, part);
        let free = contacts.is_empty();
        let (q, qdot) = (way(&from.q, &to.q), way(&from.qdot, &to.qdot));
        let start = Start { q, qdot, phase: from.phase, contacts, exact: Vec::new() };
        // a mean of two numbers may be rounded beyond a stop
        if free { start.within_stops(self) } else { start }
    }

    fn phase(&self, start: &Start) -> f64 {
        start.phase
    }

    fn after(&self, start: &Start, (time, phase): (f64, f64)) -> Option<Start> {
        let after = states_at(self, start, &[time]).ok()?.pop()??;
        Some(Start { phase, ..after.start() })
    }

    fn distance(&self, one: &Start, other: &Start) -> f64 {
        let (Some(a), Some(b)) = (place(self, one), place(self, other)) else { return f64::INFINITY };
        let frame = MachineFrame::new(self);
        let (sizes, others) = (frame.sizes(&a), frame.sizes(&b));
        frame.distance(&a, &b, (sizes.0.max(others.0), sizes.1.max(others.1)))
    }

    fn verdict(
        &self,
        start: &Start,
        options: &SettleOptions,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Verdict<Self>, EdgeError> {
        Ok(settle_machine_while(self, start, options, go_on)?.ok_or(EdgeError::Stopped)?.verdict)
    }

    fn cycles_near(&self, start: &Start, laps: u32) -> Vec<Cycle> {
        let frame = MachineFrame::new(self);
        let Some(from) = place(self, start) else { return Vec::new() };
        if self.is_forced() {
            return Cycle::near(&frame, &from, laps).into_iter().collect();
        }
        let guesses = CLOSINGS.into_iter().flat_map(|closings| {
            let motion = frame.resume(from.clone()).limited(frame.limits().time);
            near_returns(&frame, motion, closings)
        });
        guesses.filter_map(|(guess, time)| Cycle::returning(&frame, &guess, time)).collect()
    }

    fn is_forced(&self) -> bool {
        self.period().is_some()
    }

    fn passes(&self, cycle: &Cycle, start: &Start, distance: f64) -> bool {
        let frame = MachineFrame::new(self);
        let passed = place(self, start).and_then(|from| Some(passing(&frame, &from, cycle)?.2));
        passed.is_some_and(|apart| apart <= distance)
    }
}
