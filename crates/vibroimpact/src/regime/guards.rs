//! The guards of a regime: what is positive as long as the regime holds.

use super::contact_state::ContactState;
use super::normal::Normal;
use super::signal::{Observable, Signal};
use super::structure::Structure;
use crate::machine::{Machine, Opening, StopLaw};
use crate::math::dot;

/// A gap that changes by less than this part of the motion along its direction does not change.
const STILL: f64 = 1e-12;

/// What a guard is; the number is the place of the stop, or of the joint among the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GuardKind {
    /// The gap of an open stop.
    Gap(usize),
    /// The depth $`-g`$ of a closed compliant stop.
    Depth(usize),
    /// The force of a closed compliant stop that cannot pull.
    Force(usize),
    /// The reaction of a stop at rest.
    Reaction(usize),
    /// What is missing to the preload of a compliant stop at rest.
    Preload(usize),
    /// The relative velocity of a joint, in the direction in which it slides.
    Sliding(usize),
    /// What is missing to the limit of a joint that holds, against sliding forward and backward.
    LimitForward(usize),
    LimitBackward(usize),
}

impl GuardKind {
    /// The stop of a guard, or the joint, counted after the stops.
    pub(crate) const fn place(self, stops: usize) -> usize {
        match self {
            Self::Gap(j) | Self::Depth(j) | Self::Force(j) | Self::Reaction(j) | Self::Preload(j) => j,
            Self::Sliding(joint) | Self::LimitForward(joint) | Self::LimitBackward(joint) => stops + joint,
        }
    }

    /// Whether it is a force, and not a way or a velocity.
    pub(crate) const fn of_force(self) -> bool {
        !matches!(self, Self::Gap(_) | Self::Depth(_) | Self::Sliding(_))
    }
}

/// A guard: a linear function of the state that is positive as long as the regime holds.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    pub(crate) kind: GuardKind,
    pub(crate) function: Observable,
    /// Whether it is the gap of a rigid stop: its zero is an impact.
    pub(crate) strikes: bool,
}

impl Structure {
    /// Whether a gap, or the velocity of a joint, can change beyond rounding errors: not where constraints hold it already. `along`
    /// are those of the coordinates, and `wall` what else moves.
    fn changes(&self, of: &Observable, w: &[f64], (along, wall): (&[Observable], Option<&Signal>)) -> bool {
        let still = |of: &[f64]| of.iter().all(|factor| factor.abs() <= STILL * dot(w, w).sqrt());
        let size = |signal: &Signal| signal.harmonics.iter().map(|(a, b)| a.abs() + b.abs()).sum::<f64>();
        let swing = wall.map_or(0.0, size) + dot(w, w).sqrt() * along.iter().map(|of| size(&of.signal)).sum::<f64>();
        !(still(&of.position) && still(&of.velocity) && of.signal.ramp == 0.0 && size(&of.signal) <= STILL * swing)
    }

    pub(super) fn all_guards(&self, machine: &Machine, normal: &Normal) -> Vec<Guard> {
        let mut guards = Vec::new();
        let rigid = |j: usize| matches!(machine.stops()[j].law, StopLaw::Rigid { .. });
        let mut add = |kind, function| {
            let strikes = matches!(kind, GuardKind::Gap(j) if rigid(j));
            guards.push(Guard { kind, function, strikes });
        };
        let moves = |j: usize| {
            let (gap, _) = self.gap(normal, j);
            self.changes(&gap, &normal.directions[j], (&self.x, Some(&normal.walls[j])))
        };
        let missing = |limit: f64, of: Observable| {
            let mut sum = of;
            sum.signal.constant += limit;
            sum
        };
        for (j, stop) in machine.stops().iter().enumerate() {
            match (self.states[j], &stop.law) {
                (ContactState::Closed, StopLaw::Compliant { opening, damping, preload, .. }) => {
                    // without damper and preload both are zero together
                    let depth = *opening == Opening::Position || *preload > 0.0 || *damping == 0.0;
                    if depth && moves(j) {
                        add(GuardKind::Depth(j), self.gap(normal, j).0.scaled(-1.0));
                    }
                    if *opening == Opening::Force
                        && *damping > 0.0
                        && let Some(force) = self.force(machine, normal, j)
                    {
                        add(GuardKind::Force(j), force);
                    }
                }
                (ContactState::Resting, law) => {
                    if let Some((reaction, shared)) = self.reaction(j) {
                        add(GuardKind::Reaction(j), missing(shared, reaction.clone()));
                        if let StopLaw::Compliant { preload, .. } = law {
                            add(GuardKind::Preload(j), missing(*preload + shared, reaction.scaled(-1.0)));
                        }
                    }
                }
                (ContactState::Touching, _) => {}
                _ if !moves(j) => {}
                _ => add(GuardKind::Gap(j), self.gap(normal, j).0),
            }
        }
        for (j, joint) in machine.joints().iter().enumerate() {
            let place = machine.stops().len() + j;
            match self.states[place] {
                ContactState::Forward | ContactState::Backward => {
                    let sliding = self.sliding(machine, normal, j);
                    // a joint that other constraints hold has the force of sliding as long as they do
                    if self.changes(&sliding, &normal.directions[place], (&self.v, None)) {
                        let sign = if self.states[place] == ContactState::Forward { 1.0 } else { -1.0 };
                        add(GuardKind::Sliding(j), sliding.scaled(sign));
                    }
                }
                _ => {
                    if let Some((reaction, shared)) = self.reaction(place) {
                        // a positive force holds it against sliding forward
                        add(GuardKind::LimitForward(j), missing(joint.limit + shared, reaction.scaled(-1.0)));
                        add(GuardKind::LimitBackward(j), missing(joint.limit + shared, reaction.clone()));
                    }
                }
            }
        }
        guards
    }
}
