//! The last impacts of a run.

use crate::motion::ImpactState;

/// The number of impacts over which the quantities of a chaotic motion are measured.
pub const MEASURED_IMPACTS: u64 = 1000;

/// The impacts of a tail in order, each with the time since the one before. Empty where they were not kept.
pub type Arrivals = Vec<(ImpactState, f64)>;

/// The last part of a run, over which the quantities of a chaotic motion are measured: at most [`MEASURED_IMPACTS`] impacts of
/// an oscillator, or events of a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tail<F = ImpactState> {
    /// The impact, or the state of a machine, before them.
    pub from: F,
    /// The last impact, or the state after them.
    pub last: F,
    /// Their number.
    pub impacts: u64,
}

impl<F: Clone> Tail<F> {
    /// The tail of a run that begins at an impact.
    pub(crate) fn new(from: F) -> Self {
        Self { last: from.clone(), from, impacts: 0 }
    }

    /// Adds an impact to a run, after which `left` more are planned. A run that ends early has a shorter tail.
    pub(crate) fn impact(&mut self, state: &F, left: u64) {
        self.impacts += 1;
        self.last = state.clone();
        if left == MEASURED_IMPACTS {
            *self = Self::new(state.clone());
        }
    }

    /// The tail of the impacts so far.
    pub(crate) fn so_far(&self) -> Self {
        Self { impacts: self.impacts.min(MEASURED_IMPACTS), ..self.clone() }
    }
}
