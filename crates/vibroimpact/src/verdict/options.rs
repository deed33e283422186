//! How far a motion is followed for a verdict.

use crate::flight::SearchLimits;

/// The least number of search steps of a flight in a small budget.
const FEWEST: u32 = 64;

/// The budget of a verdict, and its tolerances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettleOptions {
    /// The largest number of impacts that are followed.
    pub max_impacts: u32,
    /// The number of impacts after which a motion without a cycle is measured for chaos.
    pub chaos_after: u32,
    /// The number of impacts of the first measurement of the Lyapunov exponents. If it does not decide, the second one
    /// covers the next three times as many, and every later one eight times as many. With 0 nothing is measured, and no
    /// motion is called chaotic.
    pub chaos_over: u32,
    /// Whether the third measurement is completed beyond `max_impacts` if the second one diverges too little for a
    /// decision.
    pub extend: bool,
    /// The longest period that is searched for, in impacts.
    pub longest: u32,
    /// The largest distance of the last impacts from earlier ones, in phase and relative velocity, for which Newton's
    /// method is tried.
    pub recurrence: f64,
    /// The limits of the search for the first contact of each flight.
    pub limits: SearchLimits,
    /// The largest number of search steps of all flights together; it limits the time if every flight is long. Each event of a machine
    /// counts as one.
    pub max_steps: u64,
}

impl Default for SettleOptions {
    /// 20 000 impacts or two million search steps (a tenth of a second for ordinary flights); chaos measured over 4000
    /// impacts after the first 1000; periods up to 128 impacts.
    fn default() -> Self {
        Self {
            max_impacts: 20_000,
            chaos_after: 1_000,
            chaos_over: 4_000,
            extend: true,
            longest: 128,
            recurrence: 1e-2,
            limits: SearchLimits::default(),
            max_steps: 2_000_000,
        }
    }
}

impl SettleOptions {
    /// A budget of this number of impacts. A budget below the default has search steps for that number of ordinary
    /// flights. Chaos is decided at the same numbers of impacts as with the default, the first of which is 5000. So a
    /// smaller budget leaves more starts undecided and changes no other verdict of an oscillator. A machine is called chaotic at
    /// the end of its budget, if this is 5000 events or more; with a larger one its chaos may have ended.
    #[must_use]
    pub fn at_most(impacts: u32) -> Self {
        let usual = Self::default();
        if impacts >= usual.max_impacts {
            return Self { max_impacts: impacts, max_steps: 100 * u64::from(impacts), ..usual };
        }
        let steps = (impacts / 2).max(FEWEST).min(usual.limits.steps);
        Self {
            max_impacts: impacts,
            max_steps: 20 * u64::from(impacts),
            extend: false,
            limits: SearchLimits { steps, ..usual.limits },
            ..usual
        }
    }
}
