//! The plan of a response.

use crate::map::check_impacts;
use crate::quantity::Quantity;
use crate::{Cut, Parameter, PlanError, SystemPlan, Values};
use serde::{Deserialize, Serialize};

/// A quantity of all motions over the values of one parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponsePlan {
    /// The parameter that varies; its value in the system counts for nothing.
    #[serde(with = "crate::parameter")]
    #[schemars(with = "crate::parameter::Name")]
    pub vary: Parameter,
    /// Its values, in any order.
    pub over: Values,
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
    pub fn new(vary: Parameter, over: impl Into<Values>) -> Self {
        Self { vary, over: over.into(), quantity: amplitude(), impacts: None }
    }

    /// The line over which the parameter varies, from the smaller to the larger end.
    #[must_use]
    pub fn cut(&self) -> Cut {
        Cut { vary: self.vary, ends: self.over.extent(), also: None }
    }

    /// The number of motions of both sweeps.
    #[must_use]
    pub fn motions(&self) -> u64 {
        2 * self.over.count() as u64
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        check_values(&self.over, self.vary.name())?;
        check_impacts(self.impacts)?;
        self.cut().check(system)
    }
}

/// Checks that the values of a response differ, and their number.
pub(crate) fn check_values(over: &Values, name: &'static str) -> Result<(), PlanError> {
    over.check()?;
    let (from, to) = over.extent();
    if from == to {
        return Err(PlanError::Nowhere { name, value: from });
    }
    let count = u32::try_from(over.count()).unwrap_or(u32::MAX);
    if count > MOST_VALUES {
        return Err(PlanError::Values { given: count, most: MOST_VALUES });
    }
    Ok(())
}
