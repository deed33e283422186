//! The oscillator and the start of a plan.

use crate::PlanError;
use serde::{Deserialize, Serialize};
use vibroimpact::{Oscillator, Start};

/// The oscillator: exactly one of `beta` and `inverse_beta`, one or two stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SystemPlan {
    /// Frequency ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beta: Option<f64>,
    /// Its inverse, the paper's abscissa.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inverse_beta: Option<f64>,
    /// Gap.
    pub gap: f64,
    /// Restitution.
    pub restitution: f64,
    /// Damping ratio; 0 when absent.
    #[serde(default)]
    pub damping: f64,
    /// A stop on the other side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_stop: Option<SecondStop>,
}

/// A stop at `x = -gap`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SecondStop {
    /// Its distance from the rest position.
    pub gap: f64,
    /// Its restitution.
    pub restitution: f64,
}

impl SystemPlan {
    /// The checked oscillator.
    ///
    /// # Errors
    /// [`PlanError`] names the invalid parameter.
    pub fn oscillator(&self) -> Result<Oscillator, PlanError> {
        let osc = match (self.beta, self.inverse_beta) {
            (Some(beta), None) => Oscillator::new(beta, self.gap, self.restitution)?,
            (None, Some(x)) => Oscillator::from_inverse_beta(x, self.gap, self.restitution)?,
            (Some(_), Some(_)) => return Err(PlanError::Frequency("twice")),
            (None, None) => return Err(PlanError::Frequency("nowhere")),
        };
        let osc = osc.with_damping(self.damping)?;
        Ok(match self.second_stop {
            Some(stop) => osc.with_second_stop(stop.gap, stop.restitution)?,
            None => osc,
        })
    }
}

/// Where to start; absent coordinates are 0, except `x` where the stops exclude 0: then it is on the nearest stop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartPlan {
    /// Position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// Velocity.
    #[serde(default)]
    pub v: f64,
    /// Phase of the force.
    #[serde(default)]
    pub phase: f64,
}

impl StartPlan {
    /// The checked start.
    ///
    /// # Errors
    /// [`PlanError`] for a start that lies beyond a stop or is not finite.
    pub fn start(&self, osc: &Oscillator) -> Result<Start, PlanError> {
        let x = self.x.unwrap_or_else(|| Start::at_rest(osc).x);
        Ok(Start::new(osc, x, self.v, self.phase)?)
    }
}
