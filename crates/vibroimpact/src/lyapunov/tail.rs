//! The last impacts of a run.

use crate::motion::ImpactState;

/// The number of impacts over which the quantities of a chaotic motion are measured.
pub const MEASURED_IMPACTS: u64 = 1000;

/// The impacts of a tail in order, each with the time since the one before. Empty where they were not kept.
pub type Arrivals = Vec<(ImpactState, f64)>;

/// The last impacts of a run, over which the quantities of a chaotic motion are measured: at most
/// [`MEASURED_IMPACTS`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tail {
    /// The impact before them.
    pub from: ImpactState,
    /// Their number.
    pub impacts: u64,
}

impl Tail {
    /// The tail of a run that begins at an impact.
    pub(crate) const fn new(from: ImpactState) -> Self {
        Self { from, impacts: 0 }
    }

    /// Adds an impact to a run, after which `left` more are planned. A run that ends early has a shorter tail.
    pub(crate) const fn impact(&mut self, state: ImpactState, left: u64) {
        self.impacts += 1;
        if left == MEASURED_IMPACTS {
            *self = Self::new(state);
        }
    }

    /// The tail of the impacts so far.
    pub(crate) fn so_far(self) -> Self {
        Self { impacts: self.impacts.min(MEASURED_IMPACTS), ..self }
    }
}
