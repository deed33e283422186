//! The result of following one motion: its kind, the points to show and its last state.

use crate::{PlanError, SystemPlan};
use vibroimpact::Start;
use vibroimpact::verdict::{Count, SettleOptions, System, Verdict};

/// The kind of the motion at one value after the transient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// The motion has impacts.
    Impacts,
    /// There are no more impacts: for ever, for at least a thousand periods, or, in a stroboscopic diagram, within the
    /// periods shown.
    NoImpact,
    /// The mass rests on a stop for ever.
    Stuck,
    /// Undecided: the budget of search steps was used up.
    Undecided,
}

impl MotionKind {
    /// All of them, in the order of the numbers that stand for them in stores.
    const ALL: [Self; 4] = [Self::NoImpact, Self::Impacts, Self::Stuck, Self::Undecided];

    /// The kind of a settled motion.
    pub(super) fn of<S: System>(motion: &Verdict<S>) -> Self {
        match motion {
            Verdict::Periodic(cycle) if S::label(cycle).impacts == Count::Finite(0) => Self::NoImpact,
            Verdict::Periodic(_) | Verdict::Chaotic(_) => Self::Impacts,
            Verdict::NoImpact(_) => Self::NoImpact,
            Verdict::Stuck(_) => Self::Stuck,
            Verdict::Undecided(_) => Self::Undecided,
        }
    }

    /// The number that stands for it in stores.
    pub(crate) fn code(self) -> usize {
        Self::ALL.iter().position(|kind| *kind == self).unwrap_or(0)
    }

    /// The kind for which a number stands; `None` for a motion that was not computed.
    pub(crate) fn of_code(code: i8) -> Option<Self> {
        Self::ALL.get(usize::try_from(code).ok()?).copied()
    }
}

/// A point of the diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DiagramPoint {
    /// A closing of a stop: an impact.
    Impact {
        /// The number of the stop; of an oscillator [`Side::place`](vibroimpact::Side::place).
        stop: usize,
        /// Phase of the forcing.
        phase: f64,
        /// Speed of closing.
        speed: f64,
    },
    /// The end of a complete chatter of an oscillator: infinitely many impacts of decreasing speed lie between the last impact
    /// and this point.
    Chatter {
        /// The number of the stop.
        stop: usize,
        /// Phase of the forcing.
        phase: f64,
    },
    /// The state at phase 0 of the forcing.
    State {
        /// The position; of a machine the coordinate or velocity that is shown.
        x: f64,
        /// The velocity of an oscillator.
        v: Option<f64>,
    },
    /// The value of a quantity of the settled motion, finite.
    Value(f64),
}

/// A motion after its transient.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AfterTransient<State = Start> {
    pub(crate) kind: MotionKind,
    pub(crate) points: Vec<DiagramPoint>,
    /// The last state.
    pub(crate) last: State,
}

/// Two points closer than this (phases in radians, speeds relative to their size, states relative to their size) are
/// the same point, and the motion repeats itself. The value is far above the rounding errors of a cycle and far below
/// the resolution of a figure.
pub(crate) const SAME: f64 = 1e-9;

/// Maximum number of search steps and events of a motion: the budget of a verdict plus 1000 for each requested impact
/// or period.
pub(super) fn budget(transient: u64, keep: u64) -> u64 {
    SettleOptions::default().max_steps + 1000 * (transient + keep)
}

/// The state `from` of the system `before` as a start of the system `there`. A mass on a stop stays on it. If a moved
/// stop has passed the mass, the mass is placed on that stop. A body keeps its position and velocity in SI units.
pub(crate) fn carried_state(from: Start, before: &SystemPlan, there: &SystemPlan) -> Result<Start, PlanError> {
    let (was_lowest, was_highest) = Start::room(&before.oscillator()?);
    let (lowest, highest) = Start::room(&there.oscillator()?);
    let (x, v) = before.state_in(there, (from.x, from.v));
    let x = if from.x >= was_highest {
        highest
    } else if from.x <= was_lowest {
        lowest
    } else {
        x.clamp(lowest, highest)
    };
    Ok(Start { x, v, ..from })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SecondStop;

    #[test]
    fn a_carried_state_is_within_the_stops() {
        let system = |gap, second| SystemPlan {
            beta: Some(0.9),
            gap,
            restitution: 0.5,
            second_stop: Some(SecondStop { gap: second, restitution: 0.5 }),
            ..SystemPlan::default()
        };
        let at = |x| Start { x, v: 1.0, phase: 2.0 };
        let (wide, narrow) = (system(2.0, 2.0), system(1.0, 0.5));
        for (x, expected) in [(2.0, 1.0), (1.5, 1.0), (0.25, 0.25), (-1.0, -0.5), (-2.0, -0.5)] {
            assert_eq!(carried_state(at(x), &wide, &narrow), Ok(at(expected)));
        }
        for (x, expected) in [(1.0, 2.0), (0.25, 0.25), (-0.5, -2.0)] {
            assert_eq!(carried_state(at(x), &narrow, &wide), Ok(at(expected)));
        }
    }
}
