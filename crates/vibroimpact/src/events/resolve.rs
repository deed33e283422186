//! Which stops rest and which joints hold: the contacts that are closed without closing velocity, decided by reactions
//! and accelerations.
//!
//! A stop rests if its reaction pushes, a compliant one under preload if the reaction is below the preload, a joint holds
//! if its force is within its limit; and each contact that does not must open or slide with its own acceleration. All
//! conditions hold together. The combinations are tried in a fixed order, those with most constraints first.

use super::place::{Place, Structures};
use crate::machine::Machine;
use crate::regime::{ContactState, NoStructure, Normal, compliant};

/// Rounding errors of reactions and accelerations, relative to their terms.
const SMALL: f64 = 1e-11;

/// A contact that is closed without velocity, and the states that it can have.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// A stop, or a joint, which are counted after the stops.
    pub(super) place: usize,
}

/// Chooses the states of the candidates. The others keep theirs. `false` if no combination is consistent.
pub(super) fn resolve(
    machine: &Machine,
    normal: &Normal,
    structures: &mut Structures,
    place: &mut Place,
    candidates: &[Candidate],
) -> Result<bool, NoStructure> {
    let options: Vec<Vec<ContactState>> =
        candidates.iter().map(|candidate| states_of(machine, candidate.place)).collect();
    let mut combinations: Vec<Vec<ContactState>> = vec![Vec::new()];
    for option in &options {
        combinations = combinations
            .iter()
            .flat_map(|known| option.iter().map(|state| known.iter().copied().chain([*state]).collect()))
            .collect();
    }
    combinations.sort_by_key(|states| states.iter().filter(|state| !state.constrains()).count());
    let mut best: Option<(f64, Vec<ContactState>)> = None;
    for combination in combinations {
        let mut there = place.clone();
        for (candidate, state) in candidates.iter().zip(&combination) {
            there.states[candidate.place] = *state;
        }
        there.known.clear();
        let structure = match structures.get(machine, normal, &there.states) {
            Ok(structure) => structure,
            Err(NoStructure::Redundant) => continue,
        };
        let flight = there.flight(normal, structure.clone());
        let mut worst = 0.0_f64;
        for (candidate, state) in candidates.iter().zip(&combination) {
            let at = candidate.place;
            let reaction = || {
                let held = structure.held.iter().position(|held| *held == at);
                held.map_or((0.0, 0.0), |held| {
                    (flight.first(&structure.reactions[held]).0, flight.size(&structure.reactions[held]))
                })
            };
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
                    let limit = machine.joints()[at - machine.stops().len()].limit;
                    (force.abs() - limit, size + limit)
                }
                ContactState::Open | ContactState::Closed => {
                    let rate = structure.gap(normal, at).1;
                    let (acceleration, size) = (flight.first(&rate).1, flight.size_of_rate(&rate));
                    (if *state == ContactState::Open { -acceleration } else { acceleration }, size)
                }
                ContactState::Forward | ContactState::Backward => {
                    let speed = structure.sliding(machine, normal, at - machine.stops().len());
                    let (acceleration, size) = (flight.first(&speed).1, flight.size_of_rate(&speed));
                    (if *state == ContactState::Forward { -acceleration } else { acceleration }, size)
                }
            };
            worst = worst.max(violation / size.max(f64::MIN_POSITIVE));
        }
        if worst <= SMALL {
            *place = there;
            return Ok(true);
        }
        if best.as_ref().is_none_or(|(least, _)| worst < *least) {
            best = Some((worst, combination));
        }
    }
    // rounding can leave a corner case without an exact answer; the least violation is taken if it is small
    let Some((worst, combination)) = best else { return Ok(false) };
    for (candidate, state) in candidates.iter().zip(&combination) {
        place.states[candidate.place] = *state;
    }
    Ok(worst < 1e-6)
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
