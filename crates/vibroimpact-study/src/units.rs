//! The physical units of a plan.

use crate::PlanError;
use core::f64::consts::TAU;
use serde::{Deserialize, Serialize};
use vibroimpact::Scales;

/// The physical units of a plan. The numbers of a plan are nondimensional; with these units its results are reported in
/// SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsPlan {
    /// One unit of length, F/k, in m.
    pub length_m: f64,
    /// One unit of time, 1/omega_n, in s.
    pub time_s: f64,
    /// The moving mass in kg.
    pub mass_kg: f64,
    /// Whether the frequency ratio is reported as the frequency of the force in Hz.
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub hertz: bool,
}

impl UnitsPlan {
    /// The units with these scales.
    #[must_use]
    pub const fn new(scales: &Scales, hertz: bool) -> Self {
        let Scales { length_m, time_s, mass_kg } = *scales;
        Self { length_m, time_s, mass_kg, hertz }
    }

    /// The units as scales.
    #[must_use]
    pub const fn scales(&self) -> Scales {
        Scales { length_m: self.length_m, time_s: self.time_s, mass_kg: self.mass_kg }
    }

    /// Checks that all units are positive and finite.
    ///
    /// # Errors
    /// [`PlanError::Unit`] for the first that is not.
    pub(crate) fn check(&self) -> Result<(), PlanError> {
        let all = [("length_m", self.length_m), ("time_s", self.time_s), ("mass_kg", self.mass_kg)];
        match all.into_iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
            Some((name, value)) => Err(PlanError::Unit { name, value }),
            None => Ok(()),
        }
    }
}

/// The frequency of the force in Hz where the frequency ratio is 1, for one unit of time `time_s` in s.
#[must_use]
pub fn natural_hertz(scales: &Scales) -> f64 {
    1.0 / (TAU * scales.time_s)
}
