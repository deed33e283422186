//! The end of a collapse: impacts on several stops in turn that accumulate, as those of a heavy body on a light one on a
//! table.
//!
//! When the same stops are struck in the same order again and again and all speeds fall by one factor in each round, so do
//! the rounds themselves last shorter by a factor. The rest of the time is the geometric sum, and the structure is then at
//! rest on all of these stops, if all of them push. Velocities of the gaps that are left are taken away as by impacts
//! without rebound.

use super::event::MachineEventKind;
use super::motion::MachineMotion;
use super::rounds::Slow;
use crate::math::add_scaled;
use crate::regime::{ContactState, GuardKind};

/// A collapse is summed when its impacts are below this part of the largest one.
const SLOWEST: f64 = 1e-8;
/// A sum is taken if the fastest mode moves by no more than this angle; what it leaves out is of the square.
const SHORT: f64 = 1e-7;

impl MachineMotion<'_> {
    /// Notes a slow impact on a stop that has opened again, and sums the collapse that it belongs to, if there is one.
    pub(super) fn slow_impact(&mut self, stop: usize, speed: f64) {
        self.slow.push(Slow { stop, speed, time: self.time(), count: self.count });
        if speed > SLOWEST * self.largest_impact {
            return;
        }
        if let Some((stops, left)) = self.slow.round()
            && self.collapse(&stops, left).is_some()
        {
            self.slow.clear();
        }
    }

    /// Brings the structure to rest on these stops after a time; `None` if it does not stay there.
    fn collapse(&mut self, stops: &[usize], left: f64) -> Option<()> {
        let mut there = self.place.clone();
        stops.iter().for_each(|j| there.states[*j] = ContactState::Resting);
        let structure = self.structures.get(self.machine, &self.normal, &there.states)?;
        if left * structure.fastest() > SHORT {
            return None;
        }
        let turns = there.turns(&self.normal);
        for j in stops {
            let held = structure.held.iter().position(|place| place == j)?;
            let (gap, rate) = self.place.gap_and_rate(&self.normal, &turns, *j);
            add_scaled(&mut there.x, gap, &structure.across[held]);
            add_scaled(&mut there.v, rate, &structure.across[held]);
        }
        there.known.retain(|(kind, _)| !matches!(kind, GuardKind::Gap(j) if stops.contains(j)));
        let flight = there.flight(&self.normal, structure.clone());
        let mut held = structure.held.iter().zip(&structure.reactions);
        let all = self.machine.stops().len();
        if held.any(|(place, reaction)| *place < all && flight.first(reaction).0 <= 0.0) {
            return None;
        }
        self.rest_after(there, &flight, left, (MachineEventKind::Collapse, stops))
    }
}
