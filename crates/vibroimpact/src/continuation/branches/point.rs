//! A point of a branch of an oscillator.

use crate::continuation::event::BranchEvent;
use crate::orbit::{Cycle, Stability};

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct SolutionPoint {
    /// Value of the parameter.
    pub value: f64,
    /// The cycle there, even if it is inadmissible. At a grazing event it is the cycle of the branch before the event.
    pub cycle: Cycle,
    /// Whether the cycle is admissible, according to the certified first contact of each flight. An event at which this
    /// changes counts as admissible.
    pub physical: bool,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<BranchEvent>,
}

impl SolutionPoint {
    /// Whether neighbours approach the cycle, even if it is inadmissible.
    #[must_use]
    pub fn stability(&self) -> Stability {
        self.cycle.stability()
    }

    /// Whether the cycle is admissible and attracts its neighbourhood.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.physical && self.cycle.stable()
    }
}
