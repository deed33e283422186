//! How long a motion is followed event by event.

use crate::{PlanError, StartPlan, limits};
use serde::{Deserialize, Serialize};

/// Number of impacts if nothing else limits the motion.
const DEFAULT_IMPACTS: u64 = 100;
/// Number of impacts if only the time is limited.
const MOST_IMPACTS: u64 = 1_000_000;
/// The longest time, and the largest number of forcing periods.
const LONGEST: f64 = 1e10;
const MOST_PERIODS: f64 = 1e9;

/// The events of a motion up to a number of impacts, a number of forcing periods and a time, whichever comes first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SimulatePlan {
    /// Where an oscillator starts; at rest when absent. A machine has a start of its own, as in the other tasks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartPlan>,
    /// The largest number of impacts, of a machine of events: 1 to 10000000. 100 when absent, or 1000000 with `periods` or `time`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u64>,
    /// The largest number of forcing periods, up to 1e9; no limit when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub periods: Option<f64>,
    /// The longest time, up to 1e10, of an oscillator in units of `1/omega_n`; no limit when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
}

impl SimulatePlan {
    /// The number of impacts, of a machine of events, to follow, with defaults applied.
    pub(crate) fn most_impacts(&self) -> u64 {
        self.impacts.unwrap_or(if self.limits_time() { MOST_IMPACTS } else { DEFAULT_IMPACTS })
    }

    /// Whether the time is limited.
    pub(crate) const fn limits_time(&self) -> bool {
        self.periods.is_some() || self.time.is_some()
    }

    /// The time at which the motion ends at the latest, with this period of the forcing, if there is one.
    #[must_use]
    pub fn until(&self, period: Option<f64>) -> f64 {
        let periods = self.periods.zip(period).map_or(f64::INFINITY, |(periods, period)| periods * period);
        periods.min(self.time.unwrap_or(f64::INFINITY))
    }

    /// Checks the lengths.
    ///
    /// # Errors
    /// [`PlanError::OutOfRange`] for the first one outside its range.
    pub fn check(&self) -> Result<(), PlanError> {
        limits::given("impacts", self.impacts, 1..=10_000_000)?;
        for (name, given, most) in [("periods", self.periods, MOST_PERIODS), ("time", self.time, LONGEST)] {
            if let Some(given) = given.filter(|given| !(*given > 0.0 && *given <= most)) {
                let range = format!("0 < {name} <= {most:e}");
                return Err(PlanError::OutOfRange { name, given: given.to_string(), range, hint: "" });
            }
        }
        Ok(())
    }
}
