//! EXCITATION: what drives a machine besides a force.

use super::number;
use super::parameter_flag::ParameterFlag;
use crate::failure::Failure;
use clap::Args;
use vibroimpact::{EquivalentMachine, Excitation, Machine, Parameter, Shaking, SystemError};

/// A moving base, a rotating unbalance, a moving stop, a constant force.
#[derive(Clone, Copy, Debug, Default, Args)]
#[command(next_help_heading = "Excitation of a system in physical units, besides --force-n or instead of it")]
pub(crate) struct ExcitationArgs {
    /// Amplitude of the displacement of the base, in m; the stop is on the base
    #[arg(long, value_parser = number, value_name = "Y", group = "base")]
    base_displacement_m: Option<f64>,

    /// Amplitude of the velocity of the base instead, in m/s
    #[arg(long, value_parser = number, value_name = "V", group = "base")]
    base_velocity_m_per_s: Option<f64>,

    /// Amplitude of the acceleration of the base instead, in m/s^2
    #[arg(long, value_parser = number, value_name = "A", group = "base")]
    base_acceleration_m_per_s2: Option<f64>,

    /// Phase of the base relative to the force, in radians
    #[arg(long, value_parser = number, value_name = "P", default_value_t = 0.0, allow_hyphen_values = true)]
    base_phase: f64,

    /// The stop is fixed in space and does not move with the base
    #[arg(long, requires = "base")]
    stop_in_space: bool,

    /// Amplitude of the displacement of the stop, in m, of a base at rest
    #[arg(long, value_parser = number, value_name = "R", conflicts_with = "base")]
    stop_displacement_m: Option<f64>,

    /// Phase of the stop relative to the force, in radians
    #[arg(long, value_parser = number, value_name = "P", default_value_t = 0.0, allow_hyphen_values = true, requires = "stop_displacement_m")]
    stop_phase: f64,

    /// Rotating unbalance in kg m, whose force grows as the square of the frequency
    #[arg(long, value_parser = number, value_name = "ME")]
    unbalance_kg_m: Option<f64>,

    /// Constant force in N towards the stop, such as a part of the weight; negative away from it
    #[arg(long, value_parser = number, value_name = "F0", allow_hyphen_values = true)]
    constant_force_n: Option<f64>,
}

impl ExcitationArgs {
    /// Whether a force of amplitude 0 is enough, because something else drives the machine.
    pub(super) const fn drives(&self) -> bool {
        self.base_displacement_m.is_some()
            || self.base_velocity_m_per_s.is_some()
            || self.base_acceleration_m_per_s2.is_some()
            || self.stop_displacement_m.is_some()
            || self.unbalance_kg_m.is_some()
    }

    /// Refuses a parameter on which the equivalent force or the equilibrium depends, because it is computed once.
    pub(super) fn allows(&self, varied: ParameterFlag) -> Result<(), Failure> {
        use Parameter::{Beta, Damping, Gap, InverseBeta, SecondGap};
        let why = match varied.parameter {
            changed if matches!(changed, Beta | InverseBeta) && self.drives() || changed == Damping && self.apart() => {
                "the force of a moving base or stop and of an unbalance"
            }
            Gap | SecondGap if self.constant_force_n.is_some() => "the gap from the equilibrium under a constant force",
            _ => return Ok(()),
        };
        Err(Failure::bad(format!(
            "{why} changes with {}, and cannot vary here yet\nhint: `vibro settle` and `vibro attractors` answer value by value",
            varied.flag()
        )))
    }

    /// Whether the stop moves otherwise than the base.
    pub(super) const fn apart(&self) -> bool {
        self.stop_in_space || self.stop_displacement_m.is_some()
    }

    /// Whether anything is given.
    pub(super) const fn given(&self) -> bool {
        self.drives() || self.constant_force_n.is_some() || self.stop_in_space
    }

    /// The machine with a force alone that has the same motions.
    pub(super) fn equivalent(&self, machine: &Machine) -> Result<EquivalentMachine, SystemError> {
        let omega = machine.frequency.rad_per_s();
        let displacement = self
            .base_displacement_m
            .or(self.base_velocity_m_per_s.map(|velocity| velocity / omega))
            .or(self.base_acceleration_m_per_s2.map(|acceleration| acceleration / (omega * omega)));
        let base = Shaking { displacement_m: displacement.unwrap_or(0.0), phase: self.base_phase };
        let stop = match self.stop_displacement_m {
            Some(displacement_m) => Shaking { displacement_m, phase: self.stop_phase },
            None if self.stop_in_space => Shaking::default(),
            None => base,
        };
        let (unbalance, constant) = (self.unbalance_kg_m, self.constant_force_n);
        Excitation { base, stop, unbalance_kg_m: unbalance.unwrap_or(0.0), constant_force_n: constant.unwrap_or(0.0) }
            .equivalent(machine)
    }
}
