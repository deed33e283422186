//! The end of a chatter on a rigid stop.

use super::event::MachineEventKind;
use super::motion::MachineMotion;
use super::place::Place;
use crate::arc::{Found, MachineFlight, first_event};
use crate::machine::StopLaw;
use crate::math::add_scaled;
use crate::regime::{ContactState, GuardKind, Normal, Structure};

/// A chatter is summed if its first correction is below this part of the sum.
const SMALL: f64 = 1e-6;

impl MachineMotion<'_> {
    /// Sums the chatter on a stop that has just been struck, if its impacts accumulate so soon that the first two terms
    /// of the sum are exact to rounding (A. B. Nordmark and P. T. Piiroinen, doi:10.1007/s11071-008-9463-y).
    pub(super) fn complete(&mut self, j: usize, turns: &[(f64, f64)]) {
        let StopLaw::Rigid { restitution } = self.machine.stops()[j].law else { return };
        let rebound = self.place.gap_and_rate(&self.normal, turns, j).1;
        if restitution >= 1.0 || rebound <= 0.0 {
            return;
        }
        // the fastest rate of the free motion: the terms that are left out are of its square
        let Some(free) = self.structures.get(self.machine, &self.normal, &self.place.states) else { return };
        // the sum over bounces of free bodies under constant forces is exact at any speed: small is what is small beside
        // the bounces before
        if free.fastest() == 0.0 && rebound > SMALL * self.largest_impact {
            return;
        }
        self.place.states[j] = ContactState::Resting;
        let resting = self.structures.get(self.machine, &self.normal, &self.place.states);
        self.place.states[j] = ContactState::Open;
        let Some(structure) = resting else { return };
        let Some(held) = structure.held.iter().position(|place| *place == j) else { return };
        if self.is_far_from_rest(&structure, held, (rebound, restitution), free.fastest(), turns) {
            return;
        }
        let mut states = self.place.states.clone();
        states[j] = ContactState::Resting;
        // the state at rest: the velocity of the gap taken away, the other constraints unchanged
        let mut there = self.place.clone();
        add_scaled(&mut there.v, rebound, &structure.across[held]);
        there.states = states;
        there.known.retain(|(kind, _)| *kind != GuardKind::Gap(j));
        let flight = there.flight(&self.normal, structure.clone());
        let (force, force_rate) = flight.first(&structure.reactions[held]);
        let (mobility, drag) = structure.mobility[held];
        let (a, jerk) = (force * mobility, force_rate * mobility);
        if a <= 0.0 {
            return;
        }
        let k = rebound / a;
        let r = 1.0 - restitution;
        let first = 2.0 * k / r;
        let second = -2.0 * (jerk / a * k + 0.5 * drag * k) / (3.0 * r);
        if second.abs() > SMALL || first * free.fastest().max(drag) > 10.0 * SMALL {
            return;
        }
        let duration = first * (1.0 + second);
        let mut touches = Vec::new();
        // the rebound ends on this stop again, so all later ones, which are smaller, do
        let bounce = self.place.flight(&self.normal, free.clone());
        let next = first_event(&bounce, duration, self.limits.steps, &mut self.buffers, &mut touches);
        let again = |guards: &[usize]| matches!(guards, [g] if free.guards[*g].kind == GuardKind::Gap(j));
        let ends = matches!(next, Found::Zero { ref guards, .. } if again(guards));
        // the time of a rebound whose height is a rounding error of the gap is one too
        let height = 0.5 * rebound * rebound / a;
        let flat = || height < f64::EPSILON * self.place.gap(&self.normal, turns, j).2;
        if !(ends || matches!(next, Found::NoneBefore(_)) && flat()) {
            return;
        }
        self.rest_after(there, &flight, duration, (MachineEventKind::Stick, &[j]));
    }

    /// Brings the structure to rest on stops: to the state `there`, and from it along its flight for the time that the
    /// impacts take that were summed. `None` if an event ends this flight before.
    pub(super) fn rest_after(
        &mut self,
        there: Place,
        flight: &MachineFlight,
        duration: f64,
        (kind, stops): (MachineEventKind, &[usize]),
    ) -> Option<()> {
        let mut touches = Vec::new();
        let found = first_event(flight, duration, self.limits.steps, &mut self.buffers, &mut touches);
        if !matches!(found, Found::NoneBefore(_)) {
            return None;
        }
        self.place = there;
        // the state at rest is that after impacts without rebound
        self.record(&stops.iter().map(|j| (*j, 0.0)).collect::<Vec<_>>());
        if let Some(passage) = &mut self.passage {
            passage.rest = Some((flight.structure.clone(), duration));
        }
        self.move_to(flight, duration);
        self.announce(kind, stops[0], 0.0, stops[1..].to_vec());
        self.largest_impact = 0.0;
        Some(())
    }

    /// Whether a chatter is far from its end, by the reaction at rest here: a first test without a flight.
    fn is_far_from_rest(
        &mut self,
        structure: &Structure,
        held: usize,
        (rebound, restitution): (f64, f64),
        fastest: f64,
        turns: &[(f64, f64)],
    ) -> bool {
        if !self.machine.joints().is_empty() {
            return false;
        }
        let v = &mut self.scratch.v;
        v.clone_from(&self.place.v);
        add_scaled(v, rebound, &structure.across[held]);
        let (mobility, drag) = structure.mobility[held];
        let a = mobility * structure.reaction_at(held, &self.place.x, v, turns);
        let first = 2.0 * rebound / (a * (1.0 - restitution));
        a <= 0.0 || first * fastest.max(drag) > 11.0 * SMALL
    }
}

/// Whether a chatter on a stop that is struck alone, while all others are open, is far from its end: a test without the
/// structure at rest. `fastest` is the rate of the structure.
pub(super) fn is_far_from_an_end(
    place: &Place,
    normal: &Normal,
    (j, restitution): (usize, f64),
    fastest: f64,
    turns: &[(f64, f64)],
) -> bool {
    let approach = &normal.approaches[j];
    let rebound = place.gap_and_rate(normal, turns, j).1;
    // the velocity of the gap taken away changes the acceleration by its drag
    let a = approach.at(&place.x, &place.v, turns) - approach.drag * rebound;
    let first = 2.0 * rebound / (a * (1.0 - restitution));
    a <= 0.0 || first * fastest.max(approach.drag) > 11.0 * SMALL
}
