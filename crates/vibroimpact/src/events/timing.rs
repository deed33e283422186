//! Which guards time an event, for its derivative.
//!
//! Neighbours of a motion reach an event earlier or later by what the guards that are zero there say of them. A guard can be zero
//! without that, and events of equal parts can end a contact whose own guard was zero within rounding errors only.

use super::advance::Approach;
use super::motion::Motion;
use crate::arc::MachineFlight;
use crate::regime::GuardKind;

/// Guards that are zero within this time, in radians of the fastest rate, are zero at one time.
const TOGETHER: f64 = 1e-9;

impl Motion<'_> {
    /// The guards whose zero times the event. A gap on which a short flight begins without velocity is zero still, in neighbours too, so
    /// an impact on another stop at this time does not come earlier or later by it.
    pub(super) fn timing(&self, flight: &MachineFlight, guards: &[usize]) -> Vec<usize> {
        // one alone does
        if guards.len() == 1 {
            return guards.to_vec();
        }
        let turns = self.place.turns(&self.normal);
        let times = |g: &usize| match flight.structure.guards[*g].kind {
            GuardKind::Gap(j) if flight.begins_exactly(*g) => {
                let (_, rate) = self.place.gap_and_rate(&self.normal, &turns, j);
                matches!(self.approach(j, rate), Approach::Strikes)
            }
            _ => true,
        };
        let timing: Vec<usize> = guards.iter().copied().filter(times).collect();
        if timing.is_empty() { guards.to_vec() } else { timing }
    }

    /// Adds the guards of contacts that change with those that were found, within rounding errors: forces that reach their limits, and
    /// velocities of joints that are zero. What one of equal parts does it does at its own time in neighbours.
    pub(super) fn time_by_others(&mut self, flight: &MachineFlight, fastest: f64) {
        let Some(passage) = &mut self.passage else { return };
        let (Some(before), Some(after)) = (&passage.before, &passage.after) else { return };
        if !passage.pushed.is_empty() {
            return;
        }
        let structure = &flight.structure;
        let stops = before.surfaces.len();
        let timed: Vec<usize> = passage.guards.iter().map(|g| structure.guards[*g].kind.place(stops)).collect();
        for (g, guard) in structure.guards.iter().enumerate() {
            let at = guard.kind.place(stops);
            let (then, now) = (before.states[at], after.states[at]);
            let changes = match guard.kind {
                GuardKind::Gap(_) | GuardKind::Depth(_) | GuardKind::Force(_) => false,
                GuardKind::Sliding(_) => !then.constrains() && now != then,
                _ => then.constrains() && !now.constrains(),
            };
            if !changes || timed.contains(&at) {
                continue;
            }
            let (value, rate) = before.unguarded_flight(&self.normal, structure.clone()).first(&guard.function);
            if rate < 0.0 && value.abs() * fastest <= TOGETHER * -rate {
                passage.guards.push(g);
            }
        }
        // rounding decides which of them was found, and must not decide which one stands for the event
        passage.guards.sort_unstable();
    }
}
