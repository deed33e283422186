//! The possible verdicts on the motion of a machine.

use super::super::attractors::SteadyMotion;
use super::tail::MachineTail;
use crate::events::{MachineEnd, MachineStart};
use crate::lyapunov::MachineSpectrum;
use crate::machine::Machine;
use crate::orbit::{MachineCycle, Stability};
use crate::regime::ContactState;

/// What a machine settles into.
#[derive(Clone, Debug)]
pub enum MachineVerdict {
    /// A cycle, confirmed by Newton's method, that captures the motion: a stable one, or a neutral one on which it is to
    /// rounding, or an unstable one that it does not leave, as an exactly symmetric motion.
    Periodic(MachineCycle),
    /// No further event, for ever.
    NoImpact(MachineTail),
    /// At rest on a stop, for ever.
    Stuck(MachineTail),
    /// Chaotic by its largest Lyapunov exponent, to the end of the budget.
    Chaotic {
        /// The exponents of the last measurement.
        spectrum: MachineSpectrum,
        /// Events followed. Chaos can be a transient, which no finite observation excludes; this number is a lower bound of
        /// its length.
        events: u64,
        /// The last of them.
        tail: MachineTail,
    },
    /// None of these within the budget.
    Undecided {
        /// Why.
        why: MachineUndecided,
        /// Exponents of the last measurement.
        spectrum: Option<MachineSpectrum>,
        /// Events followed.
        events: u64,
    },
}

/// Why a motion of a machine is undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MachineUndecided {
    /// The number of events is used up.
    Events,
    /// The number of events is used up, and the motion has returned to a release from rest. So it is periodic, but the
    /// rounding errors between two releases grow so much that they decide its period.
    Unconfirmed,
    /// The motion ended for this reason.
    Ended(MachineEnd),
}

/// A verdict and how far the motion was followed.
#[derive(Clone, Debug)]
pub struct MachineSettled {
    /// The verdict.
    pub verdict: MachineVerdict,
    /// The number of events that were followed; of impacts, if the machine was followed as an oscillator.
    pub events: u64,
    /// The time that was followed.
    pub time: f64,
    /// Chaos that was measured and has ended.
    pub transient: Option<MachineSpectrum>,
}

impl MachineVerdict {
    /// The label of the motion as text: `4/1`, `inf/1`, `0`, `chaotic`, `stuck`, `undecided`.
    #[must_use]
    pub fn label(&self) -> String {
        match self {
            Self::Periodic(cycle) => cycle.label.to_string(),
            Self::NoImpact(_) => "0".to_owned(),
            Self::Stuck(_) => "stuck".to_owned(),
            Self::Chaotic { .. } => "chaotic".to_owned(),
            Self::Undecided { .. } => "undecided".to_owned(),
        }
    }

    /// Whether neighbours approach the motion; `None` if it is undecided. Of a motion that comes to no further event it is that
    /// of the structure in its last regime, in which a joint that holds keeps its place: there are rests on both sides of it.
    #[must_use]
    pub fn stability(&self, machine: &Machine) -> Option<Stability> {
        match self {
            Self::Periodic(cycle) => Some(cycle.stability()),
            Self::NoImpact(tail) | Self::Stuck(tail) => tail.stability(machine),
            Self::Chaotic { .. } => Some(Stability::Unstable),
            Self::Undecided { .. } => None,
        }
    }

    /// The stops that stay closed for ever, if no further event follows: those on which the structure rests, and compliant ones
    /// that push.
    #[must_use]
    pub fn closed(&self) -> Vec<usize> {
        let (Self::NoImpact(tail) | Self::Stuck(tail)) = self else { return Vec::new() };
        // stops come before joints, whose states are others
        let states = &tail.from.states;
        (0..states.len())
            .filter(|k| matches!(states[*k], ContactState::Closed | ContactState::Resting | ContactState::Touching))
            .collect()
    }

    /// The exponents that were measured for the verdict; `None` of a motion that was decided without.
    #[must_use]
    pub const fn spectrum(&self) -> Option<&MachineSpectrum> {
        match self {
            Self::Chaotic { spectrum, .. } => Some(spectrum),
            Self::Undecided { spectrum, .. } => spectrum.as_ref(),
            Self::Periodic(_) | Self::NoImpact(_) | Self::Stuck(_) => None,
        }
    }

    /// The number of events over which chaos was seen; `None` unless the motion is chaotic.
    #[must_use]
    pub const fn seen_events(&self) -> Option<u64> {
        if let Self::Chaotic { events, .. } = self { Some(*events) } else { None }
    }

    /// A state of the motion that is reached: on the cycle, at the beginning of the last part of chaos that is measured, or
    /// after the last event; `None` for an undecided motion.
    #[must_use]
    pub fn reached(&self, machine: &Machine) -> Option<MachineStart> {
        match self {
            Self::Periodic(cycle) => Some(cycle.state.clone()),
            Self::NoImpact(tail) | Self::Stuck(tail) | Self::Chaotic { tail, .. } => Some(tail.start(machine)),
            Self::Undecided { .. } => None,
        }
    }
}

impl SteadyMotion for MachineVerdict {
    fn same_as(&self, other: &Self, tolerance: f64) -> bool {
        match (self, other) {
            (Self::Periodic(a), Self::Periodic(b)) => a.same_as(b, tolerance),
            // they differ if other stops stay closed or other joints hold; the places in which joints hold are a continuum
            (Self::NoImpact(a), Self::NoImpact(b)) | (Self::Stuck(a), Self::Stuck(b)) => a.from.states == b.from.states,
            _ => core::mem::discriminant(self) == core::mem::discriminant(other),
        }
    }
}
