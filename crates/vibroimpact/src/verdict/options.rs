//! How far a motion is followed to settle it.

use crate::flight::SearchLimits;

/// Search steps of a flight, at least, of a small budget.
const FEWEST: u32 = 64;

/// How far to follow a motion and how close is close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettleOptions {
    /// Impacts to follow before giving up.
    pub max_impacts: u32,
    /// Impacts after which a motion without a cycle is measured for chaos.
    pub chaos_after: u32,
    /// Impacts over which the Lyapunov exponents are measured first; where that does not decide, over the next three times as many, and
    /// then over eight times as many, again and again. 0 for never, and no motion is called chaotic.
    pub chaos_over: u32,
    /// Whether the third measurement is completed beyond `max_impacts` where the second diverges too little to tell.
    pub extend: bool,
    /// The longest period looked for, in impacts.
    pub longest: u32,
    /// How close the last impacts must come to earlier ones, in phase and relative velocity, to try Newton's method.
    pub recurrence: f64,
    /// How far each flight is searched.
    pub limits: SearchLimits,
    /// Search steps over all flights followed before giving up: what bounds the time where every flight is long.
    pub max_steps: u64,
}

impl Default for SettleOptions {
    /// 20 000 impacts or two million search steps (a tenth of a second, where flights are plain), chaos measured over 4000 impacts after 1000,
    /// periods up to 128 impacts.
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
    /// A budget of this number of impacts. A budget below that of the default has search steps for that many ordinary flights, and chaos is decided
    /// at the same numbers of impacts as by the default, the first of which is 5000; what it decides, the default decides alike, and the
    /// rest is undecided.
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
