//! What is particular to verdicts on a machine.

use super::super::outcome::{System, Verdict};
use crate::events::{Place, Start};
use crate::lyapunov::Measured;
use crate::machine::Machine;
use crate::math::general_eigenvalues;
use crate::orbit::machine;
use crate::orbit::{Label, MachineFrame, Stability};
use crate::regime::{ContactState, Normal};
use core::f64::consts::TAU;

/// A state of a machine that a motion has reached, with those of its stops and joints.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    pub(crate) place: Place,
    pub(crate) fades: bool,
}

impl State {
    pub(crate) fn of(place: &Place) -> Self {
        Self { place: place.clone(), fades: false }
    }

    /// Whether impacts go on from here that become ever gentler and end in the limit only, or that are so gentle already that
    /// rounding errors decide how many follow.
    #[must_use]
    pub const fn fades(&self) -> bool {
        self.fades
    }

    /// The state as a start.
    #[must_use]
    pub fn start(&self, machine: &Machine) -> Start {
        self.place.start(machine, &Normal::new(machine))
    }

    /// The stops that are closed: those on which the structure rests, and compliant ones that push.
    #[must_use]
    pub fn closed(&self) -> Vec<usize> {
        // stops come before joints, whose states are others
        let states = &self.place.states;
        (0..states.len())
            .filter(|k| matches!(states[*k], ContactState::Closed | ContactState::Resting | ContactState::Touching))
            .collect()
    }

    /// Whether stops and joints do the same here and there. A stop that is closed without force tells no motions apart: where bodies
    /// come together without end it is open in the same motion, and where another stop lies at its place that one can be told to bear
    /// the force.
    fn is_like(&self, other: &Self) -> bool {
        let idle = |a: ContactState, b: ContactState| {
            a == ContactState::Touching && matches!(b, ContactState::Open | ContactState::Resting)
        };
        self.place.states.iter().zip(&other.place.states).all(|(a, b)| a == b || idle(*a, *b) || idle(*b, *a))
    }

    /// The stability of a motion without a further event from here; `None` if its regime has no structure.
    fn stability(&self, machine: &Machine) -> Option<Stability> {
        let frame = MachineFrame::new(machine);
        let structure = frame.structure(&self.place.states)?;
        // the derivative over a time in which the slowest decay shows
        let time = TAU / structure.fastest().max(f64::MIN_POSITIVE);
        let derivative = frame.shape.transition(&structure, &frame.normal, &self.place, time);
        let rounding = frame.rounding(&derivative, 1, (1.0, structure.fastest()));
        let multipliers = general_eigenvalues(&frame.without_translations(derivative))?;
        Some(Stability::of(&multipliers, rounding))
    }
}

impl Verdict<Machine> {
    /// The stops that stay [closed](State::closed) for ever, if no further event follows.
    #[must_use]
    pub fn closed(&self) -> Vec<usize> {
        let (Self::NoImpact(last) | Self::Stuck(last)) = self else { return Vec::new() };
        last.closed()
    }

    /// A state of the motion that is reached: on the cycle, at the beginning of the last part of chaos that is measured, or
    /// after the last event; `None` for an undecided motion.
    #[must_use]
    pub fn reached(&self, machine: &Machine) -> Option<Start> {
        match self {
            Self::Periodic(cycle) => Some(cycle.state.clone()),
            Self::NoImpact(last) | Self::Stuck(last) => Some(last.start(machine)),
            Self::Chaotic(chaos) => Some(chaos.tail.from.start(machine)),
            Self::Undecided(_) => None,
        }
    }
}

impl System for Machine {
    type Cycle = machine::Cycle;
    type NoImpact = State;
    type Place = State;
    type State = State;
    type Exponents = Vec<Measured>;

    fn label(cycle: &machine::Cycle) -> Label {
        cycle.label
    }

    fn same_cycle(a: &machine::Cycle, b: &machine::Cycle, tolerance: f64) -> bool {
        a.same_as(b, tolerance)
    }

    /// They differ if other stops stay closed or other joints hold; the places in which joints hold are a continuum. Where impacts
    /// fade away, rounding errors decide on which stops a body rests in between.
    fn same_without_impact(a: &State, b: &State) -> bool {
        a.fades || b.fades || a.is_like(b)
    }

    fn same_place(a: &State, b: &State) -> bool {
        a.is_like(b)
    }

    fn stability(&self, verdict: &Verdict<Self>) -> Option<Stability> {
        match verdict {
            Verdict::Periodic(cycle) => Some(cycle.stability()),
            Verdict::NoImpact(last) | Verdict::Stuck(last) => last.stability(self),
            Verdict::Chaotic(_) | Verdict::Undecided(_) => None,
        }
    }
}
