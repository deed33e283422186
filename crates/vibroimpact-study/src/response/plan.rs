//! The plan of a response.

use crate::dynamics::{Dynamics, Setup};
use crate::map::check_impacts;
use crate::name::{Name, Written};
use crate::quantity::Quantity;
use crate::{Cut, Parameter, PlanError, Values, limits};
use serde::{Deserialize, Serialize};

/// A quantity of all motions over the values of one parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound(serialize = "V: Name, Q: Serialize", deserialize = "V: Name, Q: Deserialize<'de>"))]
#[schemars(rename = "ResponsePlan", bound = "V: Name, Q: schemars::JsonSchema")]
pub struct ResponsePlan<V = Parameter, Q = Quantity> {
    /// The number that varies; its value in the system counts for nothing.
    #[serde(with = "crate::name")]
    #[schemars(with = "Written")]
    pub vary: V,
    /// Its values, in any order.
    pub over: Values,
    /// The quantity that is reported; the displacement amplitude, of a machine that of the first coordinate, when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quantity: Option<Q>,
    /// Budget of impacts for the motion at each value, of a machine of events, 1 to 1000000; 20000 when absent. Motions that have
    /// not settled by then are undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impacts: Option<u32>,
}

/// Maximum number of values.
const MOST_VALUES: u32 = 100_000;

impl<V, Q> ResponsePlan<V, Q> {
    /// The displacement amplitude over a number.
    #[must_use]
    pub fn new(vary: V, over: impl Into<Values>) -> Self {
        Self { vary, over: over.into(), quantity: None, impacts: None }
    }

    /// The number of motions of both sweeps.
    #[must_use]
    pub fn motions(&self) -> u64 {
        2 * self.over.count() as u64
    }

    /// The same with another name of the number that varies and of the quantity.
    pub(crate) fn named<W, R, E>(
        &self,
        name: &impl Fn(&V) -> Result<W, E>,
        quantity: &impl Fn(&Q) -> Result<R, E>,
    ) -> Result<ResponsePlan<W, R>, E> {
        let quantity = self.quantity.as_ref().map(quantity).transpose()?;
        Ok(ResponsePlan { vary: name(&self.vary)?, over: self.over.clone(), quantity, impacts: self.impacts })
    }
}

impl ResponsePlan {
    /// The quantity of an oscillator that is reported.
    #[must_use]
    pub fn quantity(&self) -> Quantity {
        self.quantity.unwrap_or(Quantity::DisplacementAmplitude)
    }
}

impl<V: Name, Q: Name> ResponsePlan<V, Q> {
    /// The line over which the number varies, from the smaller to the larger end.
    pub(crate) fn cut(&self) -> Cut<V> {
        Cut { vary: self.vary.clone(), ends: self.over.extent(), also: None }
    }

    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check<D>(&self, of: &Setup<'_, D>) -> Result<(), PlanError>
    where
        D: Dynamics<Name = V, Quantity = Q>,
    {
        self.over.check()?;
        let (from, to) = self.over.extent();
        if from == to {
            return Err(PlanError::Nowhere { name: self.vary.text().to_owned().into(), value: from });
        }
        limits::check("values", u32::try_from(self.over.count()).unwrap_or(u32::MAX), 2..=MOST_VALUES)?;
        check_impacts(self.impacts)?;
        D::quantity(&of.system, self.quantity.as_ref())?;
        of.written.check_ends(&self.cut())
    }
}
