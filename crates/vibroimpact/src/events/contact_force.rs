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
            // joints that hold along with a constraint bear what a stop does not, and of a joint their share
            GuardKind::Reaction(j) => forces[j] = (value().0 - shared(j)).max(0.0),
            GuardKind::LimitForward(j) => {
                let limit = machine.joints()[j].limit;
                let whole = limit + shared(stops + j);
                forces[stops + j] = (whole - value().0) * if whole > limit { limit / whole } else { 1.0 };
            }
            _ => {}
        }
    }
}
