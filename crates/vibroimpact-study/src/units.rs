//! The physical units of a plan.

use crate::{PlanError, SystemPlan};
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
    /// The frame of positions and phases, if the body is driven by more than a force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<FramePlan>,
}

/// The frame of positions and phases of a body that is driven by more than a force: its positions are those relative
/// to the motion of the stop, from the equilibrium under constant force and gravity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FramePlan {
    /// Phase of the equivalent force relative to sin(omega t): the phase of an event is omega t plus this.
    pub phase: f64,
    /// The position of the equilibrium in m, to be added to positions.
    pub offset_m: f64,
    /// Whether the stop moves otherwise than the base. Then the loss in the damper and the work of the equivalent force
    /// are not those of the body, and are not reported.
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub apart: bool,
}

impl UnitsPlan {
    /// The units with these scales.
    #[must_use]
    pub const fn new(scales: &Scales, hertz: bool, frame: Option<FramePlan>) -> Self {
        let Scales { length, time, mass } = *scales;
        Self { length_m: length, time_s: time, mass_kg: mass, hertz, frame }
    }

    /// The units of a body; `None` for a system that is none.
    #[must_use]
    pub fn of_system(system: &SystemPlan) -> Option<Self> {
        let body = system.body?;
        let of = body.reduction().ok()?;
        let frame = FramePlan { phase: of.phase(), offset_m: of.offset(), apart: body.stop_apart() };
        Some(Self::new(&of.scales(), true, (!body.is_plain()).then_some(frame)))
    }

    /// The units as scales.
    #[must_use]
    pub const fn scales(&self) -> Scales {
        Scales { length: self.length_m, time: self.time_s, mass: self.mass_kg }
    }

    /// Checks that all units are positive and finite, and those of the body if the system is one.
    pub(crate) fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        if let Some(own) = Self::of_system(system) {
            for (name, given, own) in [
                ("length_m", self.length_m, own.length_m),
                ("time_s", self.time_s, own.time_s),
                ("mass_kg", self.mass_kg, own.mass_kg),
            ] {
                if given != own {
                    return Err(PlanError::not_of_body(name, given, own));
                }
            }
        }
        let all = [("length_m", self.length_m), ("time_s", self.time_s), ("mass_kg", self.mass_kg)];
        match all.into_iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
            Some((name, value)) => Err(PlanError::OutOfRange {
                name,
                given: value.to_string(),
                range: format!("0 < {name} < infinity"),
                hint: "",
            }),
            None => match self.frame.filter(|frame| !(frame.phase.is_finite() && frame.offset_m.is_finite())) {
                Some(FramePlan { phase, offset_m, .. }) => Err(PlanError::refused(format!(
                    "the frame of positions and phases is not finite: phase = {phase}, offset_m = {offset_m}"
                ))),
                None => Ok(()),
            },
        }
    }
}

/// The frequency of the force in Hz where the frequency ratio is 1, for one unit of time `time_s` in s.
#[must_use]
pub fn natural_hertz(scales: &Scales) -> f64 {
    1.0 / (TAU * scales.time)
}
