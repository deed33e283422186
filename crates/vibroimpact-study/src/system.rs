//! The oscillator and the start of a plan.

use crate::PlanError;
use crate::machine::{Body, MachineSource};
use serde::{Deserialize, Serialize};
use vibroimpact::{Oscillator, Scales, Side, Start};

/// The system of a plan. Its numbers have names in both: those of an oscillator as `gap`, those of a machine as
/// `stop.wall.gap`.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "an oscillator is copied where it is needed")]
pub enum System {
    /// An oscillator, nondimensional or a body in SI units.
    Oscillator(SystemPlan),
    /// A machine as it is written. Its table `[start]` is where the motion starts; at rest at 0 when absent.
    Machine(Box<MachineSource>),
}

impl From<SystemPlan> for System {
    fn from(system: SystemPlan) -> Self {
        Self::Oscillator(system)
    }
}

impl From<MachineSource> for System {
    fn from(machine: MachineSource) -> Self {
        Self::Machine(Box::new(machine))
    }
}

impl System {
    /// The oscillator; `None` for a machine.
    pub(crate) const fn oscillator(&self) -> Option<&SystemPlan> {
        if let Self::Oscillator(system) = self { Some(system) } else { None }
    }

    /// The machine; `None` for an oscillator.
    pub(crate) fn machine(&self) -> Option<&MachineSource> {
        if let Self::Machine(machine) = self { Some(machine) } else { None }
    }
}

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
    /// The body in SI units, complete, if the system is one. The numbers above are those of its oscillator.
    #[serde(default, rename = "machine", skip_serializing_if = "Option::is_none")]
    #[serde(deserialize_with = "crate::machine::body::deserialize")]
    pub body: Option<Body>,
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
    /// An undamped oscillator with one stop.
    #[must_use]
    pub const fn from_inverse_beta(inverse_beta: f64, gap: f64, restitution: f64) -> Self {
        let (beta, inverse_beta) = (None, Some(inverse_beta));
        Self { beta, inverse_beta, gap, restitution, damping: 0.0, second_stop: None, body: None }
    }

    /// The system of a body.
    ///
    /// # Errors
    /// [`PlanError`] names what is absent or given twice, or the invalid number.
    pub fn of_body(body: &Body) -> Result<Self, PlanError> {
        body.complete().and_then(Self::of_stored)
    }

    /// The system of a body in the form in which it is stored.
    pub(crate) fn of_stored(body: Body) -> Result<Self, PlanError> {
        let oscillator = body.reduction()?.oscillator;
        Ok(Self {
            beta: Some(oscillator.beta()),
            inverse_beta: None,
            gap: oscillator.gap(),
            restitution: oscillator.restitution(),
            damping: oscillator.damping(),
            second_stop: (oscillator.stop(Side::Lower))
                .map(|stop| SecondStop { gap: stop.gap, restitution: stop.restitution }),
            body: Some(body),
        })
    }

    /// The units of the body, if the system is one.
    #[must_use]
    pub fn scales(&self) -> Option<Scales> {
        Some(self.body?.reduction().ok()?.scales())
    }

    /// A position and a velocity of this system in the units of the system `there`, in which the body may have another
    /// force, mass or stiffness.
    pub(crate) fn state_in(&self, there: &Self, (x, v): (f64, f64)) -> (f64, f64) {
        if self.body == there.body {
            return (x, v);
        }
        match (self.scales(), there.scales()) {
            (Some(own), Some(other)) => (x * (own.length / other.length), v * (own.velocity() / other.velocity())),
            _ => (x, v),
        }
    }

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
