//! The plan of a response.

use crate::map::check_impacts;
use crate::quantity::Quantity;
use crate::{Cut, Parameter, PlanError, Span, SystemPlan};
use serde::{Deserialize, Serialize};

/// A quantity of all motions over the values of one parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponsePlan {
    /// The parameter that varies; its value in the system counts for nothing.
    #[serde(with = "crate::parameter")]
    #[schemars(with = "crate::parameter::Name")]
    pub vary: Parameter,
    /// Its values.
    pub over: Span,
    /// The quantity that is reported.
    #[serde(default = "amplitude", with = "crate::quantity::one")]
    #[schemars(with = "crate::quantity::Name")]
    pub quantity: Quantity,
    /// Impacts to follow each motion of a sweep for, at most, as for a map; the default of `SettleOptions` when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
}

const fn amplitude() -> Quantity {
    Quantity::DisplacementAmplitude
}

/// Maximum number of values.
const MOST_VALUES: u32 = 100_000;

impl ResponsePlan {
    /// The displacement amplitude over a parameter.
    #[must_use]
    pub const fn new(vary: Parameter, over: Span) -> Self {
        Self { vary, over, quantity: amplitude(), impacts: None }
    }

    /// The line over which the parameter varies, from the smaller to the larger end.
    #[must_use]
    pub fn cut(&self) -> Cut {
        let (a, b) = self.over.ends();
        Cut { vary: self.vary, ends: (a.min(b), a.max(b)), also: None }
    }

    /// The number of motions of both sweeps.
    #[must_use]
    pub fn motions(&self) -> u64 {
        2 * u64::from(self.over.count())
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        let cut = self.cut();
        if cut.ends.0 == cut.ends.1 {
            return Err(PlanError::Nowhere { name: self.vary.name(), value: cut.ends.0 });
        }
        if self.over.count() > MOST_VALUES {
            return Err(PlanError::Values { given: self.over.count(), most: MOST_VALUES });
        }
        check_impacts(self.impacts)?;
        cut.check(system)
    }
}
