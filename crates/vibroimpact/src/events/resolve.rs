//! Which stops rest and which joints hold: the contacts that are closed without closing velocity, decided by reactions
//! and accelerations.
//!
//! A stop rests if its reaction pushes, a compliant one under preload if the reaction is below the preload, a joint holds
//! if its force is within its limit; and each contact that does not must open or slide with its own acceleration. All
//! conditions hold together. The combinations are tried in a fixed order, those with most constraints first.

use super::place::{Place, Structures};
use crate::arc::MachineFlight;
use crate::machine::Machine;
use crate::regime::{ContactState, Normal, Observable, compliant};

/// Rounding errors of reactions and accelerations, relative to their terms.
const SMALL: f64 = 1e-11;

/// Chooses the states of the candidates: stops, and joints counted after them, that are closed without velocity. The
/// others keep theirs. Returns the states of all; `None` if no combination is consistent.
pub(super) fn resolve(
    machine: &Machine,
    normal: &Normal,
    structures: &mut Structures,
    place: &Place,
    candidates: &[usize],
) -> Option<Vec<ContactState>> {
    let mut combinations = vec![place.states.clone()];
    for candidate in candidates {
        let with = |states: &Vec<ContactState>, state: ContactState| {
            let mut states = states.clone();
            states[*candidate] = state;
            states
        };
        let options = states_of(machine, *candidate);
        combinations =
            combinations.iter().flat_map(|states| options.iter().map(move |state| with(states, *state))).collect();
    }
    combinations.sort_by_key(|states| states.iter().filter(|state| !state.constrains()).count());
    let mut best: Option<(f64, Vec<ContactState>)> = None;
    for states in combinations {
        let Some(structure) = structures.get(machine, normal, &states) else { continue };
        let there = Place { states: states.clone(), known: Vec::new(), ..place.clone() };
        let flight = there.flight(normal, structure);
        let of = |candidate: &usize| violation(machine, normal, &flight, *candidate, states[*candidate]);
        let worst = candidates.iter().map(of).fold(0.0, f64::max);
        if worst <= SMALL {
            return Some(states);
        }
        if best.as_ref().is_none_or(|(least, _)| worst < *least) {
            best = Some((worst, states));
        }
    }
    // rounding can leave a corner case without an exact answer; the least violation is taken if it is small
    best.filter(|(worst, _)| *worst < 1e-6).map(|(_, states)| states)
}

/// By how much a contact violates the condition of its state at the beginning of a flight, relative to its terms.
fn violation(machine: &Machine, normal: &Normal, flight: &MachineFlight, at: usize, state: ContactState) -> f64 {
    let structure = &flight.structure;
    let joint = at.wrapping_sub(machine.stops().len());
    let reaction = || {
        let held = structure.held.iter().position(|held| *held == at);
        held.map_or((0.0, 0.0), |held| {
            (flight.first(&structure.reactions[held]).0, flight.size(&structure.reactions[held]))
        })
    };
    let acceleration = |of: &Observable, sign: f64| (sign * flight.first(of).1, flight.size_of_rate(of));
    let (violation, size) = match state {
        ContactState::Resting => {
            let (force, size) = reaction();
            match compliant(&machine.stops()[at].law) {
                Some((_, _, preload)) => ((-force).max(force - preload), size + preload),
                None => (-force, size),
            }
        }
        ContactState::Holding => {
            let (force, size) = reaction();
            let limit = machine.joints()[joint].limit;
            (force.abs() - limit, size + limit)
        }
        ContactState::Open => acceleration(&structure.gap(normal, at).1, -1.0),
        ContactState::Closed => acceleration(&structure.gap(normal, at).1, 1.0),
        ContactState::Forward => acceleration(&structure.sliding(machine, normal, joint), -1.0),
        ContactState::Backward => acceleration(&structure.sliding(machine, normal, joint), 1.0),
    };
    violation / size.max(f64::MIN_POSITIVE)
}

/// The states that a contact can have that is closed without velocity; those that constrain first.
fn states_of(machine: &Machine, place: usize) -> Vec<ContactState> {
    if place >= machine.stops().len() {
        return vec![ContactState::Holding, ContactState::Forward, ContactState::Backward];
    }
    match compliant(&machine.stops()[place].law) {
        None => vec![ContactState::Resting, ContactState::Open],
        Some((_, _, preload)) if preload > 0.0 => vec![ContactState::Resting, ContactState::Open, ContactState::Closed],
        Some(_) => vec![ContactState::Open, ContactState::Closed],
    }
}
