//! The contacts of a start, given to a motion that has not all digits of its state, and whether they agree with it.

use super::event::ContactStart;
use super::motion::Motion;
use super::place::standing_back;
use super::state::contact_error;
use crate::machine::{Fault, MachineError};
use crate::math::{add_scaled, dot};
use crate::regime::{ContactState, GuardKind, compliant};

/// A contact may miss its stop, or its velocity 0, by this part of their terms: numbers may be given with few digits.
const NEAR: f64 = 1e-6;
/// Rounding errors of a start.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// What a contact of a start does at once.
enum Beginning {
    /// Nothing: it has its state.
    Done,
    /// It is a stop that closes.
    Closing,
    /// It is a stop whose state follows from coordinates and velocities.
    Unknown,
}

impl Motion<'_> {
    /// Gives contacts the states of the start: those that have them, and those of them that are stops which close at once.
    pub(super) fn give_states(
        &mut self,
        contacts: &[ContactStart],
        turns: &[(f64, f64)],
    ) -> Result<(Vec<usize>, Vec<usize>), MachineError> {
        let (mut given, mut closing) = (Vec::new(), Vec::new());
        for contact in contacts {
            match self.give_state(contact, turns)? {
                Beginning::Unknown => continue,
                Beginning::Closing => closing.push(contact.place),
                Beginning::Done => {}
            }
            given.push(contact.place);
        }
        Ok((given, closing))
    }

    /// Gives a contact the state of the start.
    fn give_state(&mut self, contact: &ContactStart, turns: &[(f64, f64)]) -> Result<Beginning, MachineError> {
        let ContactStart { place: at, state, surface } = *contact;
        let stops = self.machine.stops();
        let place = &mut self.place;
        place.states[at] = state;
        let Some(stop) = stops.get(at) else {
            let joint = at - stops.len();
            let (speed, size) = place.sliding(self.machine, &self.normal, joint);
            let still = speed.abs() <= ROUNDED * size;
            match state {
                ContactState::Holding if speed.abs() > NEAR * size => {
                    return Err(contact_error(
                        self.machine,
                        at,
                        format!("the joint slides at {speed} and does not hold"),
                    ));
                }
                ContactState::Holding => {
                    // exactly the velocity of its belt: the rest is rounding of the given numbers
                    let w = &self.normal.directions[at];
                    add_scaled(&mut place.v, -speed / dot(w, w), w);
                }
                // it begins to slide now: its velocity is zero and has no error
                _ if still => place.note(GuardKind::Sliding(joint), 1),
                ContactState::Forward if speed > 0.0 => {}
                ContactState::Backward if speed < 0.0 => {}
                _ => {
                    return Err(contact_error(self.machine, at, format!("the joint slides the other way, at {speed}")));
                }
            }
            return Ok(Beginning::Done);
        };
        let (gap, rate, size, rate_size) = place.gap(&self.normal, turns, at);
        let still = rate.abs() <= ROUNDED * rate_size;
        match state {
            ContactState::Resting | ContactState::Touching => {
                if gap.abs() > NEAR * size.max(stop.gap.abs()) || rate.abs() > NEAR * rate_size {
                    let what =
                        format!("the gap of the stop is {gap} and its rate {rate}: the structure does not rest on it");
                    return Err(contact_error(self.machine, at, what));
                }
                // exactly onto the stop
                self.normal.move_by(&[(at, gap)], &mut place.x);
                self.normal.move_by(&[(at, rate)], &mut place.v);
            }
            ContactState::Closed if gap > ROUNDED * size => {
                return Err(contact_error(self.machine, at, format!("the stop has the gap {gap} and is not closed")));
            }
            ContactState::Closed => {
                // it has just closed: the depth is zero, and so is its rate if it is still
                if gap.abs() <= ROUNDED * size && (still || rate < 0.0) {
                    place.note(GuardKind::Depth(at), if still { 2 } else { 1 });
                }
            }
            _ => {
                // only damped stops that open by force have a surface
                let back = standing_back(&stop.law, surface).filter(|_| surface > 0.0);
                place.surfaces[at] = back;
                let (distance, rate) = (gap + surface, rate - back.map_or(0.0, |back| back.rate * back.size));
                let on = distance.abs() <= ROUNDED * (size + surface);
                if distance < 0.0 && !on {
                    if compliant(&stop.law).is_none() {
                        return Err(MachineError::new(format!("stop.{}", stop.name), Fault::Beyond(-distance)));
                    }
                    // the structure pushes the surface: where this is, follows from where the structure is
                    place.surfaces[at] = None;
                    return Ok(Beginning::Unknown);
                }
                // it closes at once
                if on && !still && rate < 0.0 {
                    return Ok(Beginning::Closing);
                }
                // it has just opened: the zero here is no event
                if on {
                    place.note(GuardKind::Gap(at), if still { 2 } else { 1 });
                }
            }
        }
        Ok(Beginning::Done)
    }

    /// Whether the contacts of a start agree with it: no guard is below zero by more than rounding.
    pub(super) fn check_guards(&mut self) -> Result<(), MachineError> {
        let Some(structure) = self.structures.get(self.machine, &self.normal, &self.place.states) else {
            return Ok(());
        };
        let flight = self.place.flight(&self.normal, structure.clone());
        for (g, guard) in structure.guards.iter().enumerate() {
            let (value, size) = flight.start_of_guard(g);
            if value < -NEAR * size {
                let at = guard.kind.place(self.machine.stops().len());
                let what = match guard.kind {
                    GuardKind::Gap(_) => format!("the coordinates lie {} beyond the stop, which is not open", -value),
                    GuardKind::Depth(_) => format!("the stop has the gap {} and is not closed", -value),
                    GuardKind::Force(_) => format!("the stop would pull with {} and is not closed", -value),
                    GuardKind::Reaction(_) => {
                        format!("the stop would pull with {}: the structure does not rest on it", -value)
                    }
                    GuardKind::Preload(_) => "the stop is pushed in: the structure does not rest on it".to_owned(),
                    GuardKind::Sliding(_) => "the joint slides the other way".to_owned(),
                    GuardKind::LimitForward(_) | GuardKind::LimitBackward(_) => {
                        format!("the force on the joint is above its limit by {}: it does not hold", -value)
                    }
                };
                return Err(contact_error(self.machine, at, what));
            }
        }
        Ok(())
    }
}
