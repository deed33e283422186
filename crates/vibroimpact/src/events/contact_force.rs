//! The forces of stops and joints at a time of a flight.

use crate::arc::{MachineFlight, Modes};
use crate::machine::Machine;
use crate::regime::{ContactState, GuardKind, compliant};

/// The force of each stop against its direction, that of a compliant one or the reaction of one at rest, and after them
/// that of each joint, positive against positive relative velocity; for the modes of a flight with these states of stops
/// and joints. Guards are counted from where they are zero exactly, so no digits of a stiff stop are lost.
pub(crate) fn contact_forces(
    machine: &Machine,
    states: &[ContactState],
    (flight, modes): (&MachineFlight, &Modes),
    forces: &mut Vec<f64>,
) {
    let stops = machine.stops().len();
    forces.clear();
    forces.resize(stops, 0.0);
    forces.extend(machine.joints().iter().zip(&states[stops..]).map(|(joint, state)| match state {
        ContactState::Forward => joint.sliding,
        ContactState::Backward => -joint.sliding,
        _ => 0.0,
    }));
    // a closed stop whose gap constraints hold has no guard
    for (j, gap) in flight.closed_gaps(modes) {
        if let Some((k, _, p)) = compliant(&machine.stops()[j].law) {
            forces[j] = p - k * gap;
        }
    }
    let shared = |place: usize| flight.structure.reaction(place).map_or(0.0, |(_, shared)| shared);
    for (g, guard) in flight.structure.guards.iter().enumerate() {
        let value = || flight.guard(g, modes);
        match guard.kind {
            GuardKind::Depth(j) => {
                if let Some((k, c, p)) = compliant(&machine.stops()[j].law) {
                    let (depth, rate, _) = value();
                    forces[j] = k * depth + c * rate + p;
                }
            }
            GuardKind::Force(j) => forces[j] = value().0,
            // the guard counts what joints that hold along with the stop can bear
            GuardKind::Reaction(j) => forces[j] = value().0 - shared(j),
            GuardKind::LimitForward(j) => {
                forces[stops + j] = machine.joints()[j].limit + shared(stops + j) - value().0;
            }
            _ => {}
        }
    }
    let structure = &flight.structure;
    for sharing in &structure.sharing {
        // a stop bears what it can, and the joints along with it the rest in proportion to their limits; joints share all
        let (place, limits) = (structure.held[sharing.held], structure.shared[sharing.held]);
        let whole = structure.sharing.iter().filter(|other| other.held == sharing.held);
        if whole.clone().next().is_some_and(|first| first.place == sharing.place) {
            let load = forces[place];
            // a stop with stiffness bears at most its preload, a rigid one any load, but neither pulls
            let (own, rest) = match machine.stops().get(place).map(|stop| compliant(&stop.law)) {
                Some(law) => {
                    let own = load.clamp(0.0, law.map_or(f64::INFINITY, |(_, _, preload)| preload));
                    (own, if limits > 0.0 { (load - own) / limits } else { 0.0 })
                }
                None => {
                    // all joints at the same part of their limits
                    let limit = machine.joints()[place - stops].limit;
                    let part = if limit + limits > 0.0 { load / (limit + limits) } else { 0.0 };
                    (part * limit, part)
                }
            };
            forces[place] = own;
            for other in whole {
                forces[other.place] = other.side * rest * machine.joints()[other.place - stops].limit;
            }
        }
    }
}
